// How far does a coarse mesh lie from the surface it stands for?
#include <cstdio>

#include "anisomesh/compare.hh"
#include "anisomesh/curvature.hh"
#include "anisomesh/shapes.hh"

int main() {
  anisomesh::ShapeOptions fine, coarse;
  fine.vertices = 10000;
  coarse.vertices = 200;
  auto reference = anisomesh::make_shape("dome", fine);
  anisomesh::estimate_curvature(reference);  // alignment needs the principal directions

  const auto triangles = anisomesh::make_shape("dome", coarse);
  OpenMesh::PolyMesh result;  // any polygonal mesh; here the triangles of a coarser dome
  for (const auto v : triangles.vertices()) result.add_vertex(triangles.point(v));
  for (const auto f : triangles.faces()) result.add_face(f.vertices().to_vector());

  const anisomesh::Comparison c = anisomesh::compare(reference, result);
  std::printf("rms %.3f %%, hausdorff %.3f %% of the diagonal, normals off by %.1f degrees\n",
              100 * c.two_sided.rms, 100 * c.two_sided.hausdorff, c.mean_normal_deviation_degrees);
  std::printf("alignment %.1f degrees, folded faces %zu, same topology: %s\n", c.mean_alignment_degrees,
              c.folded_faces, c.same_topology ? "yes" : "no");
  return c.same_topology && c.folded_faces == 0 ? 0 : 1;
}
