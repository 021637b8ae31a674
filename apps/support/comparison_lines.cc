// The ruler's figures as lines for people.
#include <cstdio>

#include "support/reports.hh"

namespace apps {

using namespace anisomesh;

namespace {

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[200];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

std::string distances(const Distances& d) {
  return format("mean %.5f  rms %.5f  hausdorff %.4f", 100 * d.mean, 100 * d.rms, 100 * d.hausdorff);
}

std::string histogram(const std::map<int, size_t>& counts) {
  std::string text;
  for (const auto& [key, count] : counts) text += format("%s%d: %zu", text.empty() ? "" : ", ", key, count);
  return text;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> comparison_lines(const Comparison& c) {
  return {
      {"distances, % of the bounding box diagonal of the reference", ""},
      {"  result to reference", distances(c.to_reference)},
      {"  reference to result", distances(c.from_reference)},
      {"  both", distances(c.two_sided)},
      {"  99 % of samples nearer", format("%.5f", 100 * c.p99_fraction)},
      {"mean normal deviation", format("%.2f degrees", c.mean_normal_deviation_degrees) + " of polygons, " +
                                    format("%.2f", c.mean_surface_normal_deviation_degrees) +
                                    " of the triangles they are split into"},
      {"elements", format("%zu vertices, %zu edges, %zu faces", c.vertices, c.edges, c.faces)},
      {"faces by degree", histogram(c.faces_by_degree)},
      {"quads", format("%.1f %%", 100 * c.quad_fraction)},
      {"vertices by valence", histogram(c.vertices_by_valence)},
      {"planarity", format("mean %.4f, worst %.4f of a face's diameter", c.mean_planarity, c.max_planarity)},
      {"faces", format("%zu concave, %zu folded, %zu self-intersecting, %zu without area", c.concave_faces,
                       c.folded_faces, c.self_intersecting_faces, c.degenerate_faces)},
      {"not manifold", format("%zu edges, %zu vertices; %zu T-junctions", c.non_manifold_edges,
                              c.non_manifold_vertices, c.t_junctions)},
      {"topology",
       format("%d components, Euler characteristic %d, %d border loops: %s the reference", c.components,
              c.euler_characteristic, c.border_loops, c.same_topology ? "as" : "NOT as")},
      {"edges to directions", format("%.2f degrees (22.5 by chance)", c.mean_alignment_degrees)},
      {"aspect ratio of quads", format("off by a factor of 2^%.2f from equation 7", c.aspect_ratio_error)},
  };
}

}  // namespace apps
