// Exact normals and curvature tensors on meshes whose surface is the zero set of a known function.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <array>
#include <cmath>
#include <functional>

#include "anisomesh/properties.hh"

namespace anisomesh::exact {

using Matrix3 = std::array<Vec3d, 3>;

/// A function that is 0 on the surface and grows outward.
struct ImplicitSurface {
  std::function<Vec3d(const Vec3d&)> gradient;
  std::function<Matrix3(const Vec3d&)> hessian;
};

inline Vec3d times(const Matrix3& m, const Vec3d& v) { return {m[0] | v, m[1] | v, m[2] | v}; }

/// The derivative of the unit normal, P H P / |gradient| with P the projection to the tangent plane, as
/// (xx, xy, xz, yy, yz, zz).
inline Vec6d shape_operator(const ImplicitSurface& surface, const Vec3d& point) {
  const Vec3d gradient = surface.gradient(point);
  const double norm = gradient.norm();
  const Vec3d n = gradient / norm;
  const Matrix3 hessian = surface.hessian(point);
  Matrix3 result;
  for (size_t i = 0; i < 3; ++i) {
    Vec3d e(0, 0, 0);
    e[i] = 1;
    const Vec3d tangent = e - n * (n | e);
    const Vec3d h = times(hessian, tangent) / norm;
    result[i] = h - n * (n | h);
  }
  return {result[0][0], result[0][1], result[0][2], result[1][1], result[1][2], result[2][2]};
}

/// Writes normal and tensor, as estimate_curvature() would, but exact.
inline void write_curvature(OpenMesh::TriMesh& mesh, const ImplicitSurface& surface) {
  const auto normal = provide_property(mesh, property::normal);
  const auto tensor = provide_property(mesh, property::tensor);
  for (const auto v : mesh.vertices()) {
    mesh.property(normal, v) = surface.gradient(mesh.point(v)).normalized();
    mesh.property(tensor, v) = shape_operator(surface, mesh.point(v));
  }
}

/// x^2/a^2 + y^2/b^2 + z^2/c^2 = 1
inline ImplicitSurface ellipsoid(double a, double b, double c) {
  const Vec3d w(2 / (a * a), 2 / (b * b), 2 / (c * c));
  return {[=](const Vec3d& p) { return Vec3d(w[0] * p[0], w[1] * p[1], w[2] * p[2]); },
          [=](const Vec3d&) {
            return Matrix3{Vec3d(w[0], 0, 0), Vec3d(0, w[1], 0), Vec3d(0, 0, w[2])};
          }};
}

inline ImplicitSurface cylinder() {
  return {[](const Vec3d& p) { return Vec3d(2 * p[0], 2 * p[1], 0); },
          [](const Vec3d&) {
            return Matrix3{Vec3d(2, 0, 0), Vec3d(0, 2, 0), Vec3d(0, 0, 0)};
          }};
}

/// The ring around the z axis, its tube's centre at distance 1.
inline ImplicitSurface torus() {
  // (distance of the axis - 1)^2 + z^2
  return {[](const Vec3d& p) {
            const double d = std::hypot(p[0], p[1]), s = 2 * (d - 1) / d;
            return Vec3d(s * p[0], s * p[1], 2 * p[2]);
          },
          [](const Vec3d& p) {
            const double d = std::hypot(p[0], p[1]), s = 2 * (d - 1) / d, r = 2 / (d * d * d);
            return Matrix3{Vec3d(s + r * p[0] * p[0], r * p[0] * p[1], 0),
                           Vec3d(r * p[0] * p[1], s + r * p[1] * p[1], 0), Vec3d(0, 0, 2)};
          }};
}

/// z = height(x, y) from the first and second derivatives of the height: (hx, hy) and (hxx, hxy, hyy).
inline ImplicitSurface graph(std::function<OpenMesh::Vec2d(double, double)> first,
                             std::function<Vec3d(double, double)> second) {
  return {[=](const Vec3d& p) {
            const auto h = first(p[0], p[1]);
            return Vec3d(-h[0], -h[1], 1);
          },
          [=](const Vec3d& p) {
            const Vec3d h = second(p[0], p[1]);
            return Matrix3{Vec3d(-h[0], -h[1], 0), Vec3d(-h[1], -h[2], 0), Vec3d(0, 0, 0)};
          }};
}

inline ImplicitSurface plane() {
  return graph([](double, double) { return OpenMesh::Vec2d(0, 0); },
               [](double, double) { return Vec3d(0, 0, 0); });
}

/// z = 0.4 (x^3 - 3 x y^2)
inline ImplicitSurface monkey_saddle() {
  return graph([](double x, double y) { return OpenMesh::Vec2d(1.2 * (x * x - y * y), -2.4 * x * y); },
               [](double x, double y) { return Vec3d(2.4 * x, -2.4 * y, -2.4 * x); });
}

/// z = (x^2 - y^2) / 2
inline ImplicitSurface saddle() {
  return graph([](double x, double y) { return OpenMesh::Vec2d(x, -y); },
               [](double, double) { return Vec3d(1, 0, -1); });
}

/// z = 1.2 (1 - x^2 - y^2)
inline ImplicitSurface dome() {
  return graph([](double x, double y) { return OpenMesh::Vec2d(-2.4 * x, -2.4 * y); },
               [](double, double) { return Vec3d(-2.4, 0, -2.4); });
}

}  // namespace anisomesh::exact
