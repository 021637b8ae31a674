// What the stages up to lines and samples make of meshes in the surface domain, and how long they take.
//
//   surface_stages [--epsilon FRACTION] [--feature-angle DEGREES] [--plane] MESH...
//
// Prints a markdown table, a row for each mesh: the sum of the indices of the umbilics (for a closed surface
// without features its Euler characteristic, which stands beside it), lines of both kinds, how many of them
// closed, ends for want of room, lines that the random coverage check started, and the seconds of each stage.
// With --plane the meshes are flattened, for comparison. Exits 1 if a mesh could not be processed.
#include <algorithm>
#include <filesystem>
#include <vector>

#include "anisomesh/features.hh"
#include "anisomesh/flatten.hh"
#include "anisomesh/lines.hh"
#include "anisomesh/smoothing.hh"
#include "anisomesh/umbilics.hh"
#include "arguments.hh"
#include "bench.hh"

using namespace anisomesh;

namespace {

struct Settings {
  double epsilon = 0.001;
  FeatureOptions features;
  bool plane = false;
};

void print_row(const std::string& path, const Settings& settings) {
  auto mesh = read_surface(path);
  const auto tagged = tag_features(mesh, settings.features);
  const auto curvature = estimate_curvature(mesh);
  double flat_seconds = 0;
  if (settings.plane) flat_seconds = flatten(mesh).seconds;
  const auto smooth = smooth_tensors(mesh);
  const auto umbilics = find_umbilics(mesh);
  TraceOptions options;
  options.density.epsilon_fraction = settings.epsilon;
  const auto traced = trace_lines(mesh, options);
  const auto samples = place_isotropic_samples(mesh, options);
  const long euler = static_cast<long>(mesh.n_vertices()) - static_cast<long>(mesh.n_edges()) +
                     static_cast<long>(mesh.n_faces());
  std::printf("| %s | %zu | %zu | %.1f | %.6f | %ld | %zu + %zu | %zu + %zu | %zu | %zu | %zu | %zu | %zu |",
              std::filesystem::path(path).filename().string().c_str(), mesh.n_faces(), tagged.feature_edges,
              umbilics.index_sum, umbilics.border_turning, euler, umbilics.wedges, umbilics.trisectors,
              traced.min_lines, traced.max_lines, traced.closed_lines,
              traced.ends[static_cast<size_t>(LineEnd::too_close)],
              traced.ends[static_cast<size_t>(LineEnd::step_limit)], traced.coverage_seeds,
              samples.from_umbilics + samples.random);
  if (settings.plane) std::printf(" %.2f |", flat_seconds);
  std::printf(" %.2f | %.2f | %.2f | %.2f | %.2f |\n", curvature.seconds, smooth.seconds, umbilics.seconds,
              traced.seconds, samples.seconds);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char* argv[]) {
  Settings settings;
  bench::Arguments arguments;
  arguments.flag("--plane", settings.plane);
  arguments.number("--epsilon", settings.epsilon);
  arguments.features("--feature-angle", settings.features);
  const auto paths = arguments.read(argc, argv);
  std::printf(
      "| mesh | triangles | features | index sum | turning | Euler | wedges + trisectors | min + max lines | "
      "closed | too close | step limit | by coverage | samples |%s curvature s | smoothing s | umbilics s | "
      "lines s | samples s |\n",
      settings.plane ? " flatten s |" : "");
  std::printf("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|%s\n",
              settings.plane ? "---|" : "");
  int failed = 0;
  for (const auto& path : paths) {
    try {
      print_row(path, settings);
    } catch (const std::exception& problem) {
      ++failed;
      std::printf("| %s | %s |\n", std::filesystem::path(path).filename().string().c_str(), problem.what());
    }
  }
  return failed > 0 ? 1 : 0;
}
