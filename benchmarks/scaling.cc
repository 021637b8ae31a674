// Stage by stage times for 10k, 40k, 160k and 640k triangles and their growth exponents.
//
//   scaling [--shape NAME] [--up-to TRIANGLES] [--repetitions N]
//
// Two series on the same irregularly sampled shape. "Larger scan": the ball of the curvature and of the
// smoothing holds as many triangles throughout, and there are as many polygons a triangle, as when one scans
// more surface with the same scanner. "Same result": all options at their defaults, so that the finer input
// goes into the same polygons; balls of fixed radius then hold more triangles each. Each time is the least of
// N. Times below 10 ms count as 10 ms; the exponent is from the first to the last row.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "anisomesh/remesh.hh"
#include "anisomesh/shapes.hh"
#include "bench.hh"

using namespace anisomesh;

namespace {

struct Row {
  size_t triangles = 0, faces = 0;
  std::vector<double> seconds;
};

const std::vector<std::string> stages{"features", "curvature", "flatten", "smoothing", "umbilics",
                                      "lines",    "isotropic", "mesh",    "all"};

std::vector<double> seconds_of(const RemeshReport& r) {
  return {r.features.seconds,  r.curvature.seconds, r.domain.seconds,
          r.smoothing.seconds, r.umbilics.seconds,  r.trace.seconds,
          r.isotropic.seconds, r.mesh.seconds,      r.seconds};
}

Row measure(const std::string& shape, int triangles, bool same_result, int repetitions) {
  ShapeOptions sampling;
  sampling.vertices = triangles / 2;
  sampling.irregular = true;
  auto input = make_shape(shape, sampling);
  RemeshOptions options;
  options.fit.enabled = false;
  if (!same_result) {
    const double finer = 10000.0 / triangles;  // in area
    options.curvature.radius_fraction = 0.03 * std::sqrt(finer);
    options.smoothing.radius_fraction = 0.03 * std::sqrt(finer);
    options.trace.density.epsilon_fraction = 0.001 * finer;
  }
  // The least of some runs: on a shared machine the others measure what else it was doing.
  Row row;
  for (int i = 0; i < repetitions; ++i) {
    RemeshReport report;
    const auto result = remesh(input, options, &report);
    row.triangles = input.n_faces();
    row.faces = result.n_faces();
    const auto seconds = seconds_of(report);
    if (i == 0) row.seconds = seconds;
    for (size_t s = 0; s < seconds.size(); ++s) row.seconds[s] = std::min(row.seconds[s], seconds[s]);
  }
  return row;
}

double exponent(const Row& first, const Row& last, size_t stage) {
  const auto floored = [stage](const Row& row) { return std::max(0.01, row.seconds[stage]); };
  return std::log(floored(last) / floored(first)) /
         std::log(static_cast<double>(last.triangles) / static_cast<double>(first.triangles));
}

void print(const std::vector<Row>& rows, const char* title, bench::Bars& bars) {
  std::printf("\n%s\n\n| triangles | polygons |", title);
  for (const auto& stage : stages) std::printf(" %s |", stage.c_str());
  std::printf("\n|---|---|");
  for (size_t i = 0; i < stages.size(); ++i) std::printf("---|");
  for (const Row& row : rows) {
    std::printf("\n| %zu | %zu |", row.triangles, row.faces);
    for (const double s : row.seconds) std::printf(" %.3f |", s);
  }
  std::printf("\n| exponent | |");
  for (size_t i = 0; i < stages.size(); ++i) std::printf(" %.2f |", exponent(rows.front(), rows.back(), i));
  std::printf("\n\n");
  for (size_t i = 0; i < stages.size(); ++i) {
    const double e = exponent(rows.front(), rows.back(), i);
    bars.check(e <= 1.2, stages[i] + " grows with exponent " + bench::format("%.2f", e) + " (1.2)");
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::string shape = "wave";
  int up_to = 640000, repetitions = 3;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--shape") == 0) shape = argv[i + 1];
    if (std::strcmp(argv[i], "--up-to") == 0) up_to = std::stoi(argv[i + 1]);
    if (std::strcmp(argv[i], "--repetitions") == 0) repetitions = std::max(1, std::stoi(argv[i + 1]));
  }
  bench::Bars bars;
  for (const bool same_result : {false, true}) {
    std::vector<Row> rows;
    for (int triangles = 10000; triangles <= up_to; triangles *= 4) {
      rows.push_back(measure(shape, triangles, same_result, repetitions));
      std::fprintf(stderr, "%d triangles: %.2f s\n", triangles, rows.back().seconds.back());
    }
    print(rows, same_result ? "Same result, finer input" : "Larger scan", bars);
  }
  return bars.missed() > 0 ? 1 : 0;
}
