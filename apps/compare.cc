// anisomesh-compare: how far a result lies from its reference, and how good its polygons are.
#include "anisomesh/compare.hh"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "anisomesh/curvature.hh"
#include "anisomesh/io.hh"
#include "anisomesh/properties.hh"
#include "support/command.hh"
#include "support/options.hh"
#include "support/reports.hh"

namespace {

using namespace anisomesh;

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[200];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

void say_all(const apps::Command& command, const Comparison& c) {
  const auto distances = [&](const char* what, const Distances& d) {
    command.say(format("%-26s mean %.5f  rms %.5f  hausdorff %.4f", what, 100 * d.mean, 100 * d.rms,
                       100 * d.hausdorff));
  };
  command.say("distances, % of the bounding box diagonal of the reference");
  distances("  result to reference", c.to_reference);
  distances("  reference to result", c.from_reference);
  distances("  both", c.two_sided);
  command.say(format("  99 %% of samples nearer     %.5f", 100 * c.p99_fraction));
  command.say(format("mean normal deviation      %.2f degrees", c.mean_normal_deviation_degrees));
  command.say(
      format("elements                   %zu vertices, %zu edges, %zu faces", c.vertices, c.edges, c.faces));
  std::string degrees, valences;
  for (const auto& [degree, count] : c.faces_by_degree)
    degrees += format("%s%d: %zu", degrees.empty() ? "" : ", ", degree, count);
  for (const auto& [valence, count] : c.vertices_by_valence)
    valences += format("%s%d: %zu", valences.empty() ? "" : ", ", valence, count);
  command.say("faces by degree            " + degrees);
  command.say(format("quads                      %.1f %%", 100 * c.quad_fraction));
  command.say("vertices by valence        " + valences);
  command.say(format("planarity                  mean %.4f, worst %.4f of a face's diameter",
                     c.mean_planarity, c.max_planarity));
  command.say(format("faces                      %zu concave, %zu folded, %zu without area", c.concave_faces,
                     c.folded_faces, c.degenerate_faces));
  command.say(format("not manifold               %zu edges, %zu vertices; %zu T-junctions",
                     c.non_manifold_edges, c.non_manifold_vertices, c.t_junctions));
  command.say(format(
      "topology                   %d components, Euler characteristic %d, %d border loops: %s the reference",
      c.components, c.euler_characteristic, c.border_loops, c.same_topology ? "as" : "NOT as"));
  command.say(format("edges to directions        %.2f degrees (22.5 by chance)", c.mean_alignment_degrees));
  command.say(
      format("aspect ratio of quads      off by a factor of 2^%.2f from equation 7", c.aspect_ratio_error));
}

}  // namespace

int main(int argc, char* argv[]) {
  apps::Command command(
      "anisomesh-compare",
      "The honest ruler: measures a polygonal result against the triangle mesh it stands for.");
  std::string reference_path, result_path, map_path;
  CompareOptions options;
  CurvatureOptions curvature;
  command.input(reference_path, "reference", "The surface: .obj, .off, .ply, .stl or .om");
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
  apps::add_curvature_options(command, curvature);

  return command.run(argc, argv, [&] {
    options.validate();
    curvature.validate();
    auto reference = apps::read_surface(command, reference_path);
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
    if (!map_path.empty()) write_mesh(result, map_path);
    command.report().update(apps::to_json(comparison));
    say_all(command, comparison);
  });
}
