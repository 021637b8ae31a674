// Where are the umbilics of a surface, and of which kind?
#include <cstdio>

#include "anisomesh/curvature.hh"
#include "anisomesh/flatten.hh"
#include "anisomesh/properties.hh"
#include "anisomesh/shapes.hh"
#include "anisomesh/smoothing.hh"
#include "anisomesh/umbilics.hh"

int main() {
  auto mesh = anisomesh::make_shape("monkey-saddle");
  anisomesh::estimate_curvature(mesh);
  anisomesh::flatten(mesh);
  anisomesh::smooth_tensors(mesh);
  const auto report = anisomesh::find_umbilics(mesh);

  const anisomesh::SurfaceRef surface = mesh;
  const auto kind = anisomesh::require_property(mesh, anisomesh::property::umbilic);
  const auto place = anisomesh::require_property(mesh, anisomesh::property::umbilic_position);
  for (const auto f : mesh.faces()) {
    if (mesh.property(kind, f) == 0) continue;
    const auto p = anisomesh::position(surface, {f, mesh.property(place, f)});
    std::printf("%s in face %d at (%.3f, %.3f, %.3f)\n", mesh.property(kind, f) > 0 ? "wedge" : "trisector",
                f.idx(), p[0], p[1], p[2]);
  }
  std::printf("sum of the indices %.1f, turns of the directions along the border %.3f\n", report.index_sum,
              report.border_turning);
  return report.trisectors == 1 && report.wedges == 0 ? 0 : 1;
}
