// anisomesh-remesh: all stages in one process.
#include "anisomesh/remesh.hh"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "anisomesh/features.hh"
#include "anisomesh/io.hh"
#include "support/command.hh"
#include "support/options.hh"
#include "support/reports.hh"
#include "view/report.hh"

namespace {

/// The page of anisomesh-view for this run: input, result, the ruler's figures, what the stages report, the
/// options.
void write_page(apps::Command& command, const std::string& page, view::Meshes& meshes) {
  auto tables = view::compare_all(meshes, {}, command.progress("comparing"));
  tables.push_back({"Stages", command.report()});
  tables.push_back({"Options", command.options()});
  command.stop_if_cancelled();
  anisomesh::write_text(view::make_report(meshes.surfaces.front().name + ", remeshed", meshes, tables), page);
  command.report()["page"] = page;
  command.say(page + ": open it in a browser");
}

std::string percent(double fraction) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g %%", 100 * fraction);
  return text;
}

std::string missed_bound(const anisomesh::RemeshOptions& options, const anisomesh::RemeshReport& report,
                         bool kept) {
  const auto& found = report.max_error;
  const double bound = options.max_error.max_error_fraction;
  const auto beyond = [&](const char* what, double at_least, double at_most) {
    if (at_most <= bound) return std::string();
    if (!std::isfinite(at_least))
      return std::string("there is no ") + what + " of one beside that of the other, ";
    return std::string("some point of the ") + what + " is " + percent(at_least) + " of the diagonal away, ";
  };
  return "the result misses --max-error: " + beyond("surface", found.at_least, found.at_most) +
         beyond("border", found.border.at_least, found.border.at_most) +
         beyond("features", found.features.at_least, found.features.at_most) + "and " +
         percent(options.max_error.max_error_fraction) + " was asked for; " +
         (kept ? "it was written all the same" : "nothing was written, --keep writes it");
}

std::string file_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

}  // namespace

int main(int argc, char* argv[]) {
  apps::Command command("anisomesh-remesh",
                        "Remeshes a triangle mesh with quads that follow its lines of curvature. Writes the "
                        "same bytes as anisomesh-estimate, -flatten, -trace and -mesh in a row.");
  std::string input, output, page;
  anisomesh::ReadOptions reading;
  anisomesh::FillOptions fill;
  apps::RefineFlags refine;
  apps::FeatureFlags features;
  apps::EpsilonFlags epsilon;
  anisomesh::RemeshOptions options;
  bool keep = false;
  command.input(input, "input", "The surface: .obj, .off, .ply, .stl or .om");
  command.output(output,
                 "Where to write the result: .obj, .off, .ply or .om (with the origin of each element)");
  command.arguments()
      .add_option("--report", page,
                  "Write a page that shows input, lines and result, with figures, .html (as anisomesh-view)")
      ->type_name("FILE")
      ->group("Output");
  apps::add_density_options(command, epsilon, options.trace);
  apps::add_target_options(command, options);
  apps::add_weld_option(command, reading);
  apps::add_fill_option(command, fill);
  apps::add_feature_options(command, features);
  apps::add_refine_option(command, refine);
  apps::add_curvature_options(command, options.curvature);
  apps::add_domain_options(command, options.domain, options.charts);
  apps::add_smoothing_options(command, options.smoothing);
  apps::add_mesh_options(command, options.mesh);
  apps::add_fit_options(command, options.fit, options.balance);
  apps::add_max_error_option(command, options.max_error);
  command.arguments()
      .add_flag("--keep", keep,
                "Write the result also where it misses --max-error; the exit code is 4 all the same")
      ->group("Fit");

  return command.run(argc, argv, [&] {
    options.trace.density.epsilon_fraction = epsilon.epsilon;
    reading.validate();
    fill.validate();
    refine.options.validate();
    options.validate();  // before a long file is read
    view::require_ending(page, {".html", ".htm"});
    if (!page.empty()) view::require_page(page);
    apps::warn_of_charts(command, options.domain);
    apps::warn_of_epsilon(command, options);
    if (options.max_error.max_error_fraction > 0)
      command.warn_of_unused({"--epsilon"}, "beside --max-error, which finds its own");
    else if (!options.fit.enabled)
      command.warn_of_unused({"--fit-passes", "--balance"}, "with --no-fit");
    anisomesh::ReadReport read;
    auto mesh = apps::read_surface(command, input, &read, reading);
    apps::fill_holes(command, mesh, read, fill);
    const auto tagged = anisomesh::tag_features(mesh, apps::resolve(features, read));
    apps::refine(command, mesh, refine, tagged);
    options.features.automatic = false;  // what is tagged now is what there is
    const anisomesh::SurfaceRef surface = mesh;
    options.trace.density.epsilon_fraction = apps::resolve(epsilon, surface);
    anisomesh::RemeshReport report;
    auto result = anisomesh::remesh(surface, options, &report, command.progress("remeshing"));
    report.features = tagged;
    command.stop_if_cancelled();
    const bool bounded = options.max_error.max_error_fraction > 0;
    const bool missed = bounded && !report.max_error.met;
    if (missed) command.fail_at_end(missed_bound(options, report, keep));
    if (!missed || keep) anisomesh::write_mesh(result, output);

    command.report()["features"] = apps::to_json(report.features);
    command.report()["curvature"] = apps::to_json(report.curvature);
    apps::add_json(command.report(), report.domain);
    command.report()["smoothing"] = apps::to_json(report.smoothing);
    command.report()["umbilics"] = apps::to_json(report.umbilics);
    apps::add_json(command.report(), report);
    if (bounded) command.report()["max_error"] = apps::to_json(report.max_error);
    if (bounded || options.fit.enabled) command.report()["fit"] = apps::to_json(report.balance);
    command.report()["result"] = apps::mesh_json(result);
    command.report()["output"] = output;
    if (missed && !keep) return;
    if (bounded && !missed)
      command.say(
          "no point of either surface, its border or its features is farther from that of the other than " +
          percent(options.max_error.max_error_fraction) + " of the diagonal; some are as far as " +
          percent(std::max({report.max_error.at_least, report.max_error.border.at_least,
                            report.max_error.features.at_least})));
    command.say(output + ": " + apps::mesh_summary(result));
    command.say("  features " + apps::seconds(report.features.seconds) + ", curvature " +
                apps::seconds(report.curvature.seconds) +
                (report.domain.used == anisomesh::Domain::plane ? ", flattening " : ", domain ") +
                apps::seconds(report.domain.seconds) + ", smoothing " +
                apps::seconds(report.smoothing.seconds) + ", umbilics " +
                apps::seconds(report.umbilics.seconds) + ", lines " + apps::seconds(report.trace.seconds) +
                ", isotropic " + apps::seconds(report.isotropic.seconds) + ", polygons " +
                apps::seconds(report.mesh.seconds) +
                (options.fit.enabled ? ", fit " + apps::seconds(report.fit.seconds) : "") + "; all " +
                apps::seconds(report.seconds) +
                (report.attempts > 1 ? " with " + std::to_string(report.attempts) + " attempts" : ""));
    apps::tell_of_features(command, report.features);
    if (!report.target_met) command.warn("the count nearest to the target is off by more than 10 %");
    if (page.empty()) return;
    view::Meshes meshes;
    meshes.surfaces.push_back({file_name(input), std::move(mesh)});
    meshes.results.push_back({file_name(output), std::move(result)});
    write_page(command, page, meshes);
  });
}
