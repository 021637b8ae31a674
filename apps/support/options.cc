#include "support/options.hh"

#include <CLI/CLI.hpp>
#include <map>

namespace apps {

using namespace anisomesh;

namespace {

/// The values of an enumeration by name, shown by name in --help too.
template <class Enum>
void add_choice(CLI::App& app, const std::string& name, Enum& value,
                const std::map<std::string, Enum>& choices, const std::string& help,
                const std::string& group) {
  std::string shown, list;
  for (const auto& [text, choice] : choices) {
    if (choice == value) shown = text;
    list += (list.empty() ? "" : ", ") + text;
  }
  app.add_option_function<std::string>(
         name, [&value, choices](const std::string& text) { value = choices.at(text); }, help + ": " + list)
      ->check([choices, list](const std::string& text) {
        return choices.count(text) ? std::string() : "'" + text + "' is none of " + list;
      })
      ->type_name("NAME")
      ->default_str(shown)
      ->group(group);
}

}  // namespace

void add_weld_option(Command& command, ReadOptions& options) {
  command.arguments()
      .add_option("--weld", options.weld_fraction,
                  "Make border edges one that lie this near to one another, fraction of the extent, at most "
                  "0.1; 0: none")
      ->type_name("F")
      ->group("Reading");
}

void add_fill_option(Command& command, FillOptions& options) {
  command.arguments()
      .add_option("--fill-holes", options.max_edges,
                  "Close border loops of up to so many edges, 3 to 1000, with triangles; 0: none")
      ->type_name("N")
      ->group("Holes");
}

void add_refine_option(Command& command, RefineFlags& flags) {
  command.arguments()
      .add_option_function<std::string>(
          "--refine",
          [&flags](const std::string& text) {
            flags.automatic = text == "auto";
            if (!flags.automatic && !CLI::detail::lexical_cast(text, flags.options.max_edge_fraction))
              throw CLI::ValidationError("--refine", "'" + text + "' is neither a number nor auto");
          },
          "Divide triangles first that are longer than this, a fraction of the extent, and over four times "
          "as "
          "long as high; 0: none; auto: 0.06 where the input is a part (as for --feature-angle), else 0")
      ->type_name("F")
      ->default_str("auto")
      ->group("Features");
}

void add_feature_options(Command& command, FeatureFlags& flags) {
  CLI::App& app = command.arguments();
  app.add_option_function<std::string>(
         "--feature-angle",
         [&flags](const std::string& text) {
           flags.automatic = text == "auto";
           if (!flags.automatic && !CLI::detail::lexical_cast(text, flags.angle_degrees))
             throw CLI::ValidationError("--feature-angle", "'" + text + "' is neither a number nor auto");
         },
         "Tag edges whose faces' normals differ by more than this, in degrees; 0: none; auto: where nothing "
         "else names features, 40 on parts that have sharp edges and little in between, none elsewhere")
      ->default_str("auto")
      ->type_name("DEG")
      ->group("Features");
  app.add_option("--feature-file", flags.file,
                 "Tag the edges of this file: `l` elements of an OBJ, or lines of two vertex numbers, from 0")
      ->type_name("FILE")
      ->group("Features");
  app.add_flag("--drop-features", flags.only_new, "Forget the tags that the input brings along")
      ->group("Features");
}

void warn_of_charts(const Command& command, Domain domain) {
  if (domain != Domain::charts)
    command.warn_of_unused({"--keep-charts", "--max-area-stretch", "--crease-weight"},
                           "without --domain charts");
}

void warn_of_epsilon(const Command& command, const TargetOptions& target) {
  if (target.target_faces > 0 || target.target_vertices > 0)
    command.warn_of_unused({"--epsilon"}, "beside a target, which finds its own");
}

void tell_of_features(Command& command, const FeatureReport& report) {
  if (report.automatic)
    command.say("  " + std::to_string(report.feature_edges) +
                " sharp edges are taken for features; --feature-angle 0 takes none");
}

void add_curvature_options(Command& command, CurvatureOptions& options) {
  CLI::App& app = command.arguments();
  add_choice<CurvatureEstimator>(app, "--estimator", options.estimator,
                                 {{"normal-cycle", CurvatureEstimator::normal_cycle},
                                  {"corrected-normal-current", CurvatureEstimator::corrected_normal_current}},
                                 "How curvature is measured", "Curvature");
  CLI::Transformer automatic(std::map<std::string, double>{{"auto", 0.0}});
  automatic.description("");  // the option's own says it
  app.add_option(
         "--radius", options.radius_fraction,
         "Radius of the ball that curvature is measured in, fraction of the extent (the diameter of the "
         "smallest sphere around the surface); auto: 0.0125, and larger with smoother normals where the "
         "surface is noisy")
      ->transform(automatic)
      ->type_name("R")
      ->group("Curvature");
}

void add_domain_options(Command& command, Domain& domain, ChartOptions& charts) {
  CLI::App& app = command.arguments();
  add_choice<Domain>(
      app, "--domain", domain,
      {{"auto", Domain::automatic},
       {"plane", Domain::plane},
       {"charts", Domain::charts},
       {"surface", Domain::surface}},
      "Where lines are traced; auto takes the plane for a disc that flattens well, else the surface",
      "Domain");
  app.add_flag("--keep-charts", charts.keep_charts,
               "With charts: start from those that the .om input brings along, and cut only what does not "
               "flatten")
      ->group("Domain");
  app.add_option(
         "--max-area-stretch", charts.max_area_stretch,
         "With charts: areas in the plane grow or shrink by at most this, over their chart's mean, > 1")
      ->type_name("S")
      ->group("Domain");
  app.add_option(
         "--crease-weight", charts.crease_weight,
         "With charts: how much farther it is over a crease than around it, >= 0; seams lie where it is "
         "far")
      ->type_name("W")
      ->group("Domain");
}

void add_smoothing_options(Command& command, SmoothingOptions& options) {
  CLI::App& app = command.arguments();
  app.add_option("--smoothing", options.iterations, "Passes of the filter over the curvature tensors")
      ->type_name("N")
      ->group("Smoothing");
  app.add_option("--smoothing-radius", options.radius_fraction,
                 "Support of the filter, fraction of the extent")
      ->type_name("R")
      ->group("Smoothing");
  app.add_flag("--anisotropic-smoothing", options.anisotropic,
               "Weigh neighbours also by likeness of their tensors: keeps more detail")
      ->group("Smoothing");
}

void add_density_options(Command& command, EpsilonFlags& epsilon, TraceOptions& options) {
  CLI::App& app = command.arguments();
  auto* given = app.add_option("--epsilon", epsilon.epsilon,
                               "Tolerated distance of an edge from the surface, fraction of the bounding box "
                               "diagonal; 0: 0.00125 of the extent")
                    ->type_name("E")
                    ->group("Density");
  app.add_flag("--absolute", epsilon.absolute, "Take --epsilon in model units")
      ->needs(given)
      ->group("Density");
  add_choice<Follow>(
      app, "--follow", options.follow, {{"curvature", Follow::curvature}, {"min-abs", Follow::min_abs}},
      "What lines follow where the surface is saddle-shaped; min-abs: one family runs where it "
      "does not bend",
      "Density");
  app.add_option("--rho", options.density.rho, "0: anisotropic, 1: isotropic, in [0, 1]")
      ->type_name("R")
      ->group("Density");
  app.add_option("--adaptation", options.density.adaptation,
                 "0: uniform density, 1: density by curvature, in [0, 1]")
      ->type_name("A")
      ->group("Density");
  app.add_option("--max-spacing", options.density.max_spacing_fraction,
                 "No spacing above this, fraction of the extent")
      ->type_name("S")
      ->group("Density");
  app.add_option("--max-slope", options.density.max_slope,
                 "Spacings change by at most this much of a length over that length, above 0")
      ->type_name("S")
      ->group("Density");
  app.add_option("--stop-fraction", options.stop_fraction,
                 "A line ends when nearer to another than this fraction of the spacing, in (0, 1)")
      ->type_name("F")
      ->group("Density");
  app.add_option("--seed-fraction", options.seed_fraction,
                 "No line starts nearer to another than this fraction of the spacing, in [stop fraction, 1]; "
                 "0: 0.7 by --epsilon, 0.8 for a target")
      ->type_name("F")
      ->group("Density");
  app.add_option("--min-crossings", options.min_crossings,
                 "Lines shorter than so many spacings of the other kind are dropped")
      ->type_name("N")
      ->group("Density");
  app.add_option(
         "--relax-passes", options.relax_passes,
         "Passes that move, shorten and lengthen lines after they are placed, for even gaps; by default "
         "5 where --epsilon is given and the surface has no umbilics, else 0")
      ->type_name("N")
      ->group("Density");
  app.add_option("--seed", options.seed, "Of the random samples that look for gaps")
      ->type_name("N")
      ->group("Density");
}

void add_target_options(Command& command, TargetOptions& options) {
  CLI::App& app = command.arguments();
  auto* faces = app.add_option("--target-faces", options.target_faces,
                               "Find the epsilon that gives about so many faces; 0: --epsilon rules")
                    ->type_name("N")
                    ->group("Density");
  app.add_option("--target-vertices", options.target_vertices, "The same for vertices")
      ->type_name("N")
      ->excludes(faces)
      ->group("Density");
  app.add_flag(
         "--coarsen,!--no-coarsen", options.coarsen,
         "Where so few lines would not tell the shape: lines for more, of which the balance takes out what "
         "is too much; on by default")
      ->group("Density");
}

void add_mesh_options(Command& command, MeshOptions& options, const std::string& heading) {
  CLI::App& app = command.arguments();
  auto* degree = app.add_option("--max-degree", options.max_degree,
                                "Split polygons until none has more corners, >= 3; 0: leave them")
                     ->type_name("D")
                     ->group(heading);
  app.add_flag_callback(
         "--polygons", [&options] { options.max_degree = 0; },
         "Leave polygons as extracted, as --max-degree 0")
      ->excludes(degree)
      ->group(heading);
  app.add_flag("--convex,!--no-convex", options.convex, "Split polygons until each is convex; on by default")
      ->group(heading);
  app.add_flag("--flip-edges,!--no-flip-edges", options.flip_edges,
               "Flip edges at isotropic samples where it lowers the error; on by default")
      ->group(heading);
  app.add_option(
         "--alignment-weight", options.alignment_weight,
         "What an edge that is no line costs for leaving the principal directions, >= 0; a square costs 1")
      ->type_name("W")
      ->group(heading);
  app.add_flag("--join-lines,!--no-join-lines", options.join_lines,
               "Join two triangles to a quad across an edge of a line; on by default")
      ->group(heading);
  app.add_option(
         "--chain-tolerance", options.chain_tolerance,
         "Lines are straightened as long as their samples stay this near, in epsilons; inf: wherever planar")
      ->type_name("T")
      ->group(heading);
  app.add_option(
         "--cell-tolerance", options.cell_tolerance,
         "Cells farther than this from the surface get samples, in epsilons; inf: none; 0: 2 by --epsilon, "
         "4 for a target")
      ->type_name("T")
      ->group(heading);
  app.add_option(
         "--feature-tolerance", options.feature_tolerance,
         "Features are followed this nearly whatever epsilon is, as a fraction of the diagonal; 0: 0.00048 "
         "of the extent where they were asked for, no bound where they were found")
      ->type_name("F")
      ->group(heading);
  app.add_option("--merge-fraction", options.merge_fraction,
                 "Edges shorter than this fraction of those they continue are contracted, in [0, 1)")
      ->type_name("F")
      ->group(heading);
  app.add_option("--max-bend", options.max_bend_degrees,
                 "Quads that are bent more than this along a diagonal are split, in degrees")
      ->type_name("DEG")
      ->group(heading);
  app.add_option("--corner-angle", options.corner_angle_degrees,
                 "A feature or border that turns by more than this has a corner there, in degrees")
      ->type_name("DEG")
      ->group(heading);
}

void add_fit_options(Command& command, FitOptions& fit, BalanceOptions& balance) {
  CLI::App& app = command.arguments();
  app.add_flag("--fit,!--no-fit", fit.enabled,
               "Move the vertices off the surface to where the error is least; on by default; --no-fit: they "
               "stay on it")
      ->group("Fit");
  app.add_option("--fit-passes", fit.passes, "Matched and solved at most so often, >= 1")
      ->type_name("N")
      ->group("Fit");
  app.add_option(
         "--balance", balance.rounds,
         "With --fit: rounds of moving vertices to where they buy more and parting polygons anew; 0: none")
      ->type_name("N")
      ->group("Fit");
}

void add_max_error_option(Command& command, MaxErrorOptions& options) {
  command.arguments()
      .add_option(
          "--max-error", options.max_error_fraction,
          "With as few vertices as it takes, no point of either surface is farther from the other than "
          "this fraction of the bounding box diagonal; 0: no bound")
      ->type_name("E")
      ->group("Fit");
}

FeatureOptions resolve(const FeatureFlags& flags, const ReadReport& read) {
  FeatureOptions options;
  options.angle_degrees = flags.angle_degrees;
  options.automatic = flags.automatic;
  options.keep_existing = !flags.only_new;
  if (flags.file.empty()) return options;
  options.edges = read_feature_edges(flags.file);
  if (read.vertex_of.empty()) return options;
  for (auto& [from, to] : options.edges) {
    const int pair[2] = {from, to};
    for (int k = 0; k < 2; ++k) {
      const size_t v = static_cast<size_t>(pair[k]);
      const int found = v < read.vertex_of.size() ? read.vertex_of[v] : -1;
      if (found < 0)
        throw InvalidInput(flags.file + ": it names vertex " + std::to_string(pair[k]) +
                           " (counted from 0), which belongs to no face of the mesh");
      (k == 0 ? from : to) = found;
    }
  }
  return options;
}

double resolve(const EpsilonFlags& flags, const SurfaceRef& surface) {
  return flags.absolute ? flags.epsilon / surface.diagonal() : flags.epsilon;
}

}  // namespace apps
