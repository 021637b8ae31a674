// What the mesher's own options do to error, quads and alignment, with the same lines.
//
//   mesher_options MESH [EPSILON_FRACTION]
//
// Prints a markdown table, one row for each set of options; everything else is as for a target. "rms x
// vertices" compares rows of different size: the error of a mesh falls about as the inverse of its number of
// vertices.
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "anisomesh/compare.hh"
#include "anisomesh/curvature.hh"
#include "anisomesh/flatten.hh"
#include "anisomesh/io.hh"
#include "anisomesh/lines.hh"
#include "anisomesh/mesher.hh"
#include "anisomesh/smoothing.hh"
#include "anisomesh/umbilics.hh"

using namespace anisomesh;

namespace {

std::vector<std::pair<std::string, MeshOptions>> variants() {
  const double infinite = std::numeric_limits<double>::infinity();
  MeshOptions base;
  base.cell_tolerance = 4;  // what a target gives
  std::vector<std::pair<std::string, MeshOptions>> result{{"as for a target", base}};
  const auto add = [&](const char* name) -> MeshOptions& {
    result.emplace_back(name, base);
    return result.back().second;
  };
  {
    auto& options = add("the paper's decimation (both tolerances infinite)");
    options.chain_tolerance = options.cell_tolerance = infinite;
  }
  add("cell_tolerance infinite").cell_tolerance = infinite;
  add("cell_tolerance 2, as for an epsilon").cell_tolerance = 2;
  add("chain_tolerance 1").chain_tolerance = 1;
  add("chain_tolerance 2").chain_tolerance = 2;
  add("join_lines off").join_lines = false;
  add("flip_edges off").flip_edges = false;
  add("merge_fraction 0").merge_fraction = 0;
  add("max_bend_degrees 20").max_bend_degrees = 20;
  add("max_bend_degrees 180").max_bend_degrees = 180;
  add("max_degree 3").max_degree = 3;
  add("max_degree 0").max_degree = 0;
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: mesher_options MESH [EPSILON_FRACTION]\n");
    return 2;
  }
  OpenMesh::TriMesh mesh = read_surface(argv[1]);
  const SurfaceRef surface = mesh;
  estimate_curvature(surface);
  flatten(surface);
  smooth_tensors(surface);
  find_umbilics(surface);
  TraceOptions trace;
  trace.seed_fraction = 0.8;  // as for a target, too
  trace.relax_passes = 0;
  trace.density.epsilon_fraction = argc > 2 ? std::atof(argv[2]) : 0.00045;
  trace_lines(surface, trace);
  place_isotropic_samples(surface, trace);

  std::printf(
      "| options | vertices | faces | quads | rms, %% of the diagonal | rms x vertices | alignment, degrees "
      "| "
      "folded, concave | seconds: arrangement + decimation + polygons "
      "|\n|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& [name, options] : variants()) {
    MeshReport report;
    OpenMesh::PolyMesh result = build_polygons(surface, options, &report);
    for (int again = 0; again < 2; ++again) {  // the least of three runs
      MeshReport other;
      build_polygons(surface, options, &other);
      if (other.seconds < report.seconds) report = other;
    }
    const Comparison c = compare(surface, result);
    std::printf("| %s | %zu | %zu | %.1f %% | %.4f | %.0f | %.1f | %zu, %zu | %.2f + %.2f + %.2f |\n",
                name.c_str(), report.vertices, report.faces,
                100.0 * static_cast<double>(report.quads) / static_cast<double>(report.faces),
                100 * c.two_sided.rms, 100 * c.two_sided.rms * static_cast<double>(report.vertices),
                c.mean_alignment_degrees, c.folded_faces, c.concave_faces, report.arrangement_seconds,
                report.decimation_seconds, report.polygon_seconds);
    std::fflush(stdout);
  }
}
