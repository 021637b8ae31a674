// Errors of both curvature estimators on closed forms over four refinements, and the time over four sizes.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "anisomesh/curvature.hh"
#include "curvature_error.hh"

using namespace anisomesh;

namespace {

void print_errors(double noise, double radius, const std::vector<int>& sizes) {
  std::printf("\nnoise %.2f %%, radius %.0f %% of the diagonal%s\n", 100 * noise, 100 * radius,
              radius == 0 ? ": chosen by the noise" : "");
  std::printf("%-12s %-6s %-10s %8s | %10s %10s %10s | %10s %10s | %8s\n", "surface", "est", "sampling",
              "vertices", "direction", "curvature", "worst", "dir border", "k border", "order k");
  for (const auto estimator :
       {CurvatureEstimator::normal_cycle, CurvatureEstimator::corrected_normal_current})
    for (const auto& form : shapes::curved())
      for (const bool irregular : {false, true}) {
        double previous = 0, previous_vertices = 0;
        for (const int vertices : sizes) {
          auto sampled = shapes::sample(form, vertices, irregular, noise);
          CurvatureOptions options;
          options.estimator = estimator;
          const SurfaceRef surface = sampled.mesh;
          options.radius_fraction = radius * surface.diagonal() / surface.extent();
          estimate_curvature(sampled.mesh, options);
          const auto e = shapes::curvature_error(sampled);
          const auto count = static_cast<double>(sampled.mesh.n_vertices());
          std::printf("%-12s %-6s %-10s %8.0f | %9.3f° %9.3f%% %9.2f%% | %9.3f° %9.2f%% |", form.name.c_str(),
                      estimator == CurvatureEstimator::normal_cycle ? "cycle" : "cnc",
                      irregular ? "irregular" : "regular", count, e.direction_degrees, 100 * e.curvature,
                      100 * e.worst_curvature, e.border_direction_degrees, 100 * e.border_curvature);
          if (previous > 0)
            std::printf(" %8.2f",
                        std::log(previous / e.curvature) / (0.5 * std::log(count / previous_vertices)));
          std::printf("\n");
          previous = e.curvature;
          previous_vertices = count;
        }
      }
}

void print_times() {
  std::printf("\nseconds on a half torus, growth exponent against the row above\n");
  for (const auto estimator :
       {CurvatureEstimator::normal_cycle, CurvatureEstimator::corrected_normal_current}) {
    double previous = 0, previous_faces = 0;
    for (const int vertices : {5000, 20000, 80000, 320000}) {
      auto sampled = shapes::sample(shapes::torus(), vertices, true);
      CurvatureOptions options;
      options.estimator = estimator;
      double seconds = 1e9;
      for (int i = 0; i < 3; ++i)
        seconds = std::min(seconds, estimate_curvature(sampled.mesh, options).seconds);
      const auto faces = static_cast<double>(sampled.mesh.n_faces());
      std::printf("%-6s %8.0f triangles %8.4f s",
                  estimator == CurvatureEstimator::normal_cycle ? "cycle" : "cnc", faces, seconds);
      if (previous > 0)
        std::printf("  %5.2f", std::log(seconds / previous) / std::log(faces / previous_faces));
      std::printf("\n");
      previous = seconds;
      previous_faces = faces;
    }
  }
}

}  // namespace

/// --errors or --times for one half of it; --quick for two sizes a surface.
int main(int argc, char** argv) {
  const auto asked = [&](const char* option) {
    return std::any_of(argv + 1, argv + argc,
                       [&](const char* argument) { return !std::strcmp(argument, option); });
  };
  const std::vector<int> sizes =
      asked("--quick") ? std::vector<int>{5000, 20000} : std::vector<int>{1250, 5000, 20000, 80000};
  if (!asked("--times")) {
    print_errors(0, 0.01, sizes);
    print_errors(0.001, 0.01, sizes);
    print_errors(0.001, 0.05, sizes);  // what a noisy scan asks for
    print_errors(0.001, 0, sizes);     // chosen by the noise
  }
  if (!asked("--errors")) print_times();
}
