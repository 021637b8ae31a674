// Cut a closed surface into charts, and trace lines of curvature that go on over the seams.
#include <cstdio>

#include "anisomesh/charts.hh"
#include "anisomesh/curvature.hh"
#include "anisomesh/lines.hh"
#include "anisomesh/properties.hh"
#include "anisomesh/shapes.hh"
#include "anisomesh/smoothing.hh"
#include "anisomesh/umbilics.hh"

int main() {
  auto mesh = anisomesh::make_shape("torus");
  anisomesh::estimate_curvature(mesh);

  const auto atlas = anisomesh::cut_into_charts(mesh);
  std::printf("%zu charts, %zu edges on seams, areas within a factor of %.2f\n", atlas.charts,
              atlas.seam_edges, atlas.max_area_stretch);

  anisomesh::smooth_tensors(mesh);  // on the surface: seams are no border to it
  const auto umbilics = anisomesh::find_umbilics(mesh);
  std::printf("sum of the indices of the umbilics: %.1f\n", umbilics.index_sum);
  const auto lines = anisomesh::trace_lines(mesh);
  std::printf("%zu min lines and %zu max lines, %zu of them closed\n", lines.min_lines, lines.max_lines,
              lines.closed_lines);

  // The charts are on the mesh: the number of each face, and (u, v) at each corner.
  const auto chart = anisomesh::require_property(mesh, anisomesh::property::chart);
  const auto uv = anisomesh::require_property(mesh, anisomesh::property::chart_uv);
  const OpenMesh::FaceHandle face(0);
  std::printf("face 0 is in chart %d, its corners at", mesh.property(chart, face));
  for (const auto h : mesh.fh_range(face))
    std::printf(" (%.3f, %.3f)", mesh.property(uv, h)[0], mesh.property(uv, h)[1]);
  std::printf("\n");
  return umbilics.index_sum == 0 && lines.closed_lines > 0 ? 0 : 1;
}
