// How far from the surface a given epsilon keeps the result: 99 % of the samples are to lie within 2 epsilon.
//
//   epsilon_bound [--cell-tolerance T] [--seed-fraction F] [--relax-passes N]
//
// Seven shapes with known geometry, some 20,000 vertices each, regular and irregular, four values of epsilon
// (fractions of the diagonal), no target. One row for each; the exit code is 1 if one of them misses the bar.
#include <cstdlib>
#include <cstring>
#include <string>

#include "anisomesh/remesh.hh"
#include "anisomesh/shapes.hh"
#include "bench.hh"

using namespace anisomesh;

namespace {

void row(const std::string& name, double epsilon, OpenMesh::PolyMesh result, bench::Ruler& ruler,
         bench::Bars& bars) {
  const Comparison c = ruler(result);
  const double within = c.p99_fraction / epsilon;
  std::printf("| %s | %g | %zu | %zu | %.0f %% | %.2f | %.4f | %.2f | %.1f |\n", name.c_str(), epsilon,
              c.vertices, c.faces, 100 * c.quad_fraction, within, 100 * c.two_sided.rms,
              100 * c.two_sided.rms * static_cast<double>(c.vertices), c.mean_alignment_degrees);
  std::fflush(stdout);
  bars.check(within <= 2,
             name + " at " + bench::format("%g", epsilon) + bench::format(": %.2f epsilon (2)", within),
             false);
}

}  // namespace

int main(int argc, char** argv) {
  RemeshOptions options;
  options.fit.enabled = false;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--cell-tolerance") == 0) options.mesh.cell_tolerance = std::atof(argv[i + 1]);
    if (std::strcmp(argv[i], "--relax-passes") == 0)
      options.trace.relax_passes = static_cast<size_t>(std::atoi(argv[i + 1]));
    if (std::strcmp(argv[i], "--seed-fraction") == 0) options.trace.seed_fraction = std::atof(argv[i + 1]);
  }
  bench::Bars bars;
  std::printf(
      "| shape | epsilon | vertices | faces | quads | 99 %% of samples within, epsilons | RMS %% | RMS x "
      "vertices | alignment |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const bool irregular : {false, true})
    for (const std::string name :
         {"half-torus", "ellipsoid-cap", "wave", "saddle", "dome", "hemisphere", "cylinder"}) {
      auto surface = make_shape(name, {20000, irregular});
      bench::Ruler ruler(surface);
      for (const double epsilon : {0.0005, 0.001, 0.002, 0.004}) {
        options.trace.density.epsilon_fraction = epsilon;
        row(name + (irregular ? ", irregular" : ""), epsilon, remesh(surface, options), ruler, bars);
      }
    }
  std::printf("\n%d of %d bars missed\n", bars.missed(), bars.checked());
  return bars.missed() > 0 ? 1 : 0;
}
