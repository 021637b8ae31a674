// A tensor field that is linear in a triangle: how it turns, and how lines leave its umbilic.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "anisomesh/lines.hh"
#include "lines/domain.hh"

namespace anisomesh::detail {

/// What lines follow where the curvature tensor is this one.
Vec3d followed(const Vec3d& tensor, Follow follow);

/// Which way a tensor lies, and how surely.
struct Orientation {
  double angle = 0;       ///< of the eigenvector of the larger eigenvalue, radians
  double anisotropy = 0;  ///< (|k_large| - |k_small|) / (|k_large| + |k_small|), by magnitude
  /// How far the angle means anything, 0 to 1: none of it below an anisotropy of 0.1, all above 0.4.
  double certainty() const { return std::clamp((anisotropy - 0.1) / (0.4 - 0.1), 0.0, 1.0); }
};
Orientation orientation(const Vec3d& tensor);

/// One triangle of a tensor field that is linear in it.
struct LinearField {
  std::array<Vec2d, 3> corner;
  std::array<Vec3d, 3> tensor;
};

/// |deviator| / |its gradient|, in the unit of the corners; infinite where the field is constant.
double turning_length(const LinearField& field, const Vec3d& tensor_here);

/// Unit directions in which the lines of a kind leave the umbilic in the triangle.
/// \param reach how far from the umbilic they are to fit, in the unit of the corners: what min_abs follows is
/// not linear
std::vector<Vec2d> separatrix_directions(const LinearField& field, const UmbilicPoint& umbilic, LineKind kind,
                                         Follow follow, double reach);

}  // namespace anisomesh::detail
