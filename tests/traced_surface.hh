// Surfaces to trace on: a flat square with an analytic tensor field, and the stages before tracing in one
// call.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <functional>
#include <string>

#include "anisomesh/curvature.hh"
#include "anisomesh/flatten.hh"
#include "anisomesh/lines.hh"
#include "anisomesh/properties.hh"
#include "anisomesh/shapes.hh"
#include "anisomesh/smoothing.hh"
#include "anisomesh/umbilics.hh"
#include "numerics/tensor2d.hh"

namespace traced {

using namespace anisomesh;
using Field = std::function<Vec3d(double, double)>;

/// A square of n x n cells over [-1, 1]^2 times `scale`, its own parameterization, with the field at its
/// vertices: curvatures per unit of the unscaled square. Its umbilics are found.
inline OpenMesh::TriMesh square(int n, const Field& field, double scale = 1) {
  OpenMesh::TriMesh mesh;
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  std::vector<OpenMesh::VertexHandle> v;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      v.push_back(mesh.add_vertex(scale * Vec3d(2.0 * i / n - 1, 2.0 * j / n - 1, 0)));
  const auto at = [&](int i, int j) { return v[static_cast<size_t>(j * (n + 1) + i)]; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.add_face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  const auto uv = provide_property(mesh, property::uv);
  const auto stretch = provide_property(mesh, property::area_stretch);
  const auto tensor = provide_property(mesh, property::tensor2d);
  for (const auto vertex : mesh.vertices()) {
    const auto p = mesh.point(vertex);
    mesh.property(uv, vertex) = Vec2d(p[0], p[1]);
    mesh.property(stretch, vertex) = 1;
    mesh.property(tensor, vertex) = field(p[0] / scale, p[1] / scale) / scale;
  }
  find_umbilics(mesh);
  return mesh;
}

/// A shape with everything that trace_lines() reads, its curvature averaged over 1 % of the diagonal, so that
/// what is said of lines on it does not hang on how large these balls are by default.
inline OpenMesh::TriMesh shape(const std::string& name, int vertices, bool irregular = true) {
  ShapeOptions options;
  options.vertices = vertices;
  options.irregular = irregular;
  auto mesh = make_shape(name, options);
  const SurfaceRef surface = mesh;
  CurvatureOptions curvature;
  SmoothingOptions smoothing;
  curvature.radius_fraction = smoothing.radius_fraction = 0.01 * surface.diagonal() / surface.extent();
  estimate_curvature(mesh, curvature);
  flatten(mesh);
  smooth_tensors(mesh, smoothing);
  find_umbilics(mesh);
  return mesh;
}

inline Field constant(double k_min, double k_max, double angle_of_max) {
  return [=](double, double) {
    return detail::tensor_from(k_min, k_max, {std::cos(angle_of_max), std::sin(angle_of_max)});
  };
}

}  // namespace traced
