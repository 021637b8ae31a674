// Estimates curvature tensors and reads them back from the mesh's properties.
#include <anisomesh/curvature.hh>
#include <anisomesh/properties.hh>
#include <anisomesh/shapes.hh>
#include <cmath>
#include <cstdio>

int main() {
  anisomesh::ShapeOptions shape;
  shape.vertices = 10000;
  shape.irregular = true;
  OpenMesh::TriMesh mesh = anisomesh::make_shape("half-torus", shape);  // R = 1, r = 0.4

  anisomesh::CurvatureOptions options;
  options.radius_fraction = 0.0125;  // of the extent, as by default; larger against noise
  const auto report = anisomesh::estimate_curvature(mesh, options);
  std::printf("radius %g, %zu of %zu balls enlarged, %.3f s\n", report.radius, report.enlarged_balls,
              mesh.n_vertices(), report.seconds);

  const auto k_max = anisomesh::require_property(mesh, anisomesh::property::k_max);
  const auto gamma_min = anisomesh::require_property(mesh, anisomesh::property::gamma_min);
  double mean = 0, tilt = 0;
  for (const auto vertex : mesh.vertices()) {
    mean += mesh.property(k_max, vertex) / static_cast<double>(mesh.n_vertices());
    tilt += std::abs(mesh.property(gamma_min, vertex)[2]) / static_cast<double>(mesh.n_vertices());
  }
  std::printf("mean k_max %.3f (1 / r = 2.5); mean slope of gamma_min %.4f (it runs around the ring: 0)\n",
              mean, tilt);
  return std::abs(mean - 2.5) < 0.05 && tilt < 0.01 ? 0 : 1;
}
