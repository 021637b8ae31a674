// The linear map of one triangle from space to the plane, as complex derivatives.
#pragma once

#include <cmath>
#include <complex>

#include "numerics/patch.hh"

namespace anisomesh::detail {

/// The map of a triangle in its frame x = along its first edge, y = normal x x: conformal part (dz) and
/// anti-conformal part (dz bar). Singular values are |dz| + |dzbar| and |dz| - |dzbar|.
struct TriangleJacobian {
  Vec3d x{0, 0, 0}, y{0, 0, 0};
  double area = 0;  ///< on the surface
  std::complex<double> conformal, anticonformal;
};

/// Of a triangle without area: all zeros.
inline TriangleJacobian triangle_jacobian(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec2d& ua,
                                          const Vec2d& ub, const Vec2d& uc) {
  TriangleJacobian j;
  const Vec3d ab = b - a, ac = c - a, cross = ab % ac;
  const double base = ab.norm(), doubled = cross.norm();
  if (!(doubled > 1e-14 * base * ac.norm())) return j;
  j.x = ab / base;
  j.y = (cross / doubled) % j.x;
  j.area = 0.5 * doubled;
  const double cx = ac | j.x, cy = ac | j.y;
  const Vec2d du = (ub - ua) / base, dv = (uc - ua - du * cx) / cy;  // columns of the Jacobian
  j.conformal = {0.5 * (du[0] + dv[1]), 0.5 * (du[1] - dv[0])};
  j.anticonformal = {0.5 * (du[0] - dv[1]), 0.5 * (du[1] + dv[0])};
  return j;
}

}  // namespace anisomesh::detail
