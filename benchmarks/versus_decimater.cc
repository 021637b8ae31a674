// anisomesh-remesh against OpenMesh-commandlineDecimater (quadrics), both as processes, on mannequin-devil.
//
//   ANISOMESH_DATA=FOLDER versus_decimater [--remesh PROGRAM] [--faces N] [--runs N]
//
// Both read the same file and write one. The runs alternate, so that both see the same load of the machine;
// the median of each is compared. Exits 1 if a bar is missed, 77 if the mesh or the decimater is not there.
#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "bench.hh"
#include "programs.hh"

using namespace anisomesh;
using bench::Cost;
using bench::run;

namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

struct Series {
  std::vector<double> wall, processor;
  void add(const Cost& cost) {
    wall.push_back(cost.wall);
    processor.push_back(cost.processor);
  }
};

void print_row(const char* name, const Comparison& c, const Series& series) {
  std::printf("| %s | %zu | %zu | %.2f | %.4f | %.2f | %.1f | %.1f | %zu | %.3f | %.3f |\n", name, c.vertices,
              c.faces, c.quad_fraction, 100 * c.two_sided.rms, 100 * c.two_sided.hausdorff,
              c.mean_alignment_degrees, c.mean_normal_deviation_degrees, c.folded_faces, median(series.wall),
              median(series.processor));
}

int compare_with_decimater(const std::string& input, const std::string& program, const std::string& faces,
                           int runs) {
  const bench::Folder folder;
  const std::string ours = folder / "remesh.off", theirs = folder / "decimated.off";
  run({program, input, "-o", ours, "--target-faces", faces, "--quiet"});
  auto result = read_polygons(ours);
  const std::string vertices = "-" + std::to_string(result.n_vertices());
  Series remesh, decimater;
  for (int i = 0; i < runs; ++i) {
    decimater.add(
        run({"OpenMesh-commandlineDecimater", "-M", "Q", "-n", vertices, "-i", input, "-o", theirs}));
    remesh.add(run({program, input, "-o", ours, "--target-faces", faces, "--quiet"}));
  }
  auto decimated = read_polygons(theirs);
  bench::Ruler ruler(read_surface(input));
  std::printf(
      "| tool | vertices | faces | quads | rms %% | hausdorff %% | align | normal | folded | wall s | cpu s "
      "|\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n");
  print_row("anisomesh-remesh", ruler(result), remesh);
  print_row("OpenMesh-commandlineDecimater -M Q", ruler(decimated), decimater);
  std::printf("\n");
  bench::Bars bars;
  const double ratio = median(remesh.wall) / median(decimater.wall);
  bars.check(ratio <= 4, "wall time over the decimater's: " + bench::format("%.2f", ratio) + " (4)");
  std::printf("- processor time over the decimater's: %.2f\n",
              median(remesh.processor) / median(decimater.processor));
  return bars.missed() > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::string program = ANISOMESH_REMESH, faces = "4000";
  int runs = 5;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--remesh") == 0) program = argv[i + 1];
    if (std::strcmp(argv[i], "--faces") == 0) faces = argv[i + 1];
    if (std::strcmp(argv[i], "--runs") == 0) runs = std::max(1, std::stoi(argv[i + 1]));
  }
  const auto input = demo_mesh("mannequin-devil.off");
  if (!input) {
    std::printf("SKIPPED: mannequin-devil.off is not in the folder ANISOMESH_DATA names\n");
    return 77;
  }
  if (!bench::is_installed("OpenMesh-commandlineDecimater")) {
    std::printf("SKIPPED: OpenMesh-commandlineDecimater (package libopenmesh-apps) is not installed\n");
    return 77;
  }
  try {
    return compare_with_decimater(*input, program, faces, runs);
  } catch (const std::exception& error) {
    std::printf("%s\n", error.what());
    return 1;
  }
}
