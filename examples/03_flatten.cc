// Map a surface to the plane, carry its curvature tensors there and smooth them.
#include <cstdio>

#include "anisomesh/curvature.hh"
#include "anisomesh/flatten.hh"
#include "anisomesh/properties.hh"
#include "anisomesh/shapes.hh"
#include "anisomesh/smoothing.hh"

int main() {
  auto mesh = anisomesh::make_shape("half-torus");
  anisomesh::estimate_curvature(mesh);

  const auto flat = anisomesh::flatten(mesh);  // throws CannotProcess if the mesh is no disc
  std::printf("conformal distortion: mean %.3f, max %.3f (1 is conformal)\n", flat.mean_conformal_distortion,
              flat.max_conformal_distortion);
  std::printf("area in the plane over area on the surface: %.3f to %.3f\n", flat.min_area_stretch,
              flat.max_area_stretch);

  anisomesh::SmoothingOptions options;
  options.radius_fraction = 0.03;  // the support should reach over a few edges
  const auto smooth = anisomesh::smooth_tensors(mesh, options);
  std::printf("smoothing changed the tensors by %.1f %%\n", 100 * smooth.mean_change);

  const auto uv = anisomesh::require_property(mesh, anisomesh::property::uv);
  const auto tensor = anisomesh::require_property(mesh, anisomesh::property::tensor2d);
  const OpenMesh::VertexHandle v(0);
  std::printf("vertex 0: (u, v) = (%.3f, %.3f), tensor = (%.3f, %.3f, %.3f)\n", mesh.property(uv, v)[0],
              mesh.property(uv, v)[1], mesh.property(tensor, v)[0], mesh.property(tensor, v)[1],
              mesh.property(tensor, v)[2]);
  return flat.mean_conformal_distortion < 1.1 ? 0 : 1;
}
