// anisomesh-compare: how far a result lies from its reference, and how good its polygons are.
#include "anisomesh/compare.hh"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "anisomesh/curvature.hh"
#include "anisomesh/io.hh"
#include "anisomesh/properties.hh"
#include "support/command.hh"
#include "support/options.hh"
#include "support/reports.hh"

namespace {

using namespace anisomesh;

void say_all(const apps::Command& command, const Comparison& comparison) {
  constexpr size_t column = 27;
  for (auto [what, value] : apps::comparison_lines(comparison)) {
    if (!value.empty()) what.resize(std::max(what.size() + 1, column), ' ');
    command.say(what + value);
  }
}

}  // namespace

int main(int argc, char* argv[]) {
  apps::Command command(
      "anisomesh-compare",
      "The honest ruler: measures a polygonal result against the triangle mesh it stands for.");
  std::string reference_path, result_path, map_path;
  ReadOptions reading;
  CompareOptions options;
  CurvatureOptions curvature;
  command.input(
      reference_path, "reference",
      "The surface: .obj, .off, .ply, .stl or .om; curvature that an .om brings along is used as it is");
  command.input(result_path, "result", "The result: .obj, .off, .ply, .stl or .om");
  command.optional_output(
      map_path,
      "Write the result with the error map as properties (anisomesh:error, anisomesh:face_error), .om");
  CLI::App& app = command.arguments();
  app.add_option("--samples", options.samples, "Points sampled by area on each of the two, >= 1000")
      ->type_name("N")
      ->group("Measuring");
  app.add_option("--seed", options.seed, "Of the samples")->type_name("N")->group("Measuring");
  app.add_flag(
         "--longer-diagonal{1},--shorter-diagonal{0}",
         [&](std::int64_t longer) {
           options.diagonal = longer > 0 ? FaceDiagonal::longer : FaceDiagonal::shorter;
         },
         "Which diagonal splits a bent polygon; the shorter by default")
      ->group("Measuring");
  app.add_option("--anisotropy", options.anisotropy_threshold,
                 "Alignment counts where anisotropy is above this")
      ->type_name("A")
      ->group("Measuring");
  apps::add_weld_option(command, reading);
  apps::add_curvature_options(command, curvature);

  return command.run(argc, argv, [&] {
    reading.validate();
    options.validate();
    curvature.validate();
    auto reference = apps::read_surface(command, reference_path, nullptr, reading);
    ReadReport read;
    auto result = read_polygons(result_path, &read);
    command.report()["read_result"] = apps::to_json(read);
    if (read.duplicated_vertices > 0)
      command.warn(result_path + ": " + std::to_string(read.duplicated_vertices) +
                   " vertices were added where the result is not manifold");
    const SurfaceRef surface = reference;
    // Directions that an earlier stage left are taken as they are.
    if (!has_property(surface.connectivity(), property::gamma_max))
      estimate_curvature(surface, curvature, command.progress("curvature"));
    const Comparison comparison = compare(surface, result, options, command.progress("comparing"));
    command.stop_if_cancelled();
    if (!map_path.empty()) {
      write_mesh(result, map_path);
      command.warn_unless_om(map_path, "result", "the error map");
    }
    command.report().update(apps::to_json(comparison));
    say_all(command, comparison);
  });
}
