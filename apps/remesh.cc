// anisomesh-remesh: all stages in one process.
#include "anisomesh/remesh.hh"

#include <nlohmann/json.hpp>

#include "anisomesh/io.hh"
#include "support/command.hh"
#include "support/options.hh"
#include "support/reports.hh"

int main(int argc, char* argv[]) {
  apps::Command command("anisomesh-remesh",
                        "Remeshes a triangle mesh with quads that follow its lines of curvature. Writes the "
                        "same bytes as anisomesh-estimate, -flatten, -trace and -mesh in a row.");
  std::string input, output;
  apps::FeatureFlags features;
  apps::EpsilonFlags epsilon;
  anisomesh::RemeshOptions options;
  command.input(input, "input", "The surface: .obj, .off, .ply, .stl or .om");
  command.output(output,
                 "Where to write the result: .obj, .off, .ply or .om (with the origin of each element)");
  apps::add_density_options(command, epsilon, options.trace);
  apps::add_target_options(command, options);
  apps::add_feature_options(command, features);
  apps::add_curvature_options(command, options.curvature);
  apps::add_domain_option(command, options.domain);
  apps::add_smoothing_options(command, options.smoothing);
  apps::add_mesh_options(command, options.mesh);

  return command.run(argc, argv, [&] {
    options.trace.density.epsilon_fraction = epsilon.epsilon;
    options.validate();  // before a long file is read
    anisomesh::ReadReport read;
    auto mesh = apps::read_surface(command, input, &read);
    const anisomesh::SurfaceRef surface = mesh;
    options.features = apps::resolve(features, read);
    options.trace.density.epsilon_fraction = apps::resolve(epsilon, surface);
    anisomesh::RemeshReport report;
    const auto result = anisomesh::remesh(surface, options, &report, command.progress("remeshing"));
    command.stop_if_cancelled();
    anisomesh::write_mesh(result, output);

    command.report()["features"] = apps::to_json(report.features);
    command.report()["curvature"] = apps::to_json(report.curvature);
    apps::add_json(command.report(), report.domain);
    command.report()["smoothing"] = apps::to_json(report.smoothing);
    command.report()["umbilics"] = apps::to_json(report.umbilics);
    apps::add_json(command.report(), report);
    command.report()["result"] = apps::mesh_json(result);
    command.report()["output"] = output;
    command.say(output + ": " + apps::mesh_summary(result));
    command.say("  features " + apps::seconds(report.features.seconds) + ", curvature " +
                apps::seconds(report.curvature.seconds) +
                (report.domain.used == anisomesh::Domain::plane ? ", flattening " : ", domain ") +
                apps::seconds(report.domain.seconds) + ", smoothing " +
                apps::seconds(report.smoothing.seconds) + ", umbilics " +
                apps::seconds(report.umbilics.seconds) + ", lines " + apps::seconds(report.trace.seconds) +
                ", isotropic " + apps::seconds(report.isotropic.seconds) + ", polygons " +
                apps::seconds(report.mesh.seconds) + "; all " + apps::seconds(report.seconds) +
                (report.attempts > 1 ? " with " + std::to_string(report.attempts) + " attempts" : ""));
    if (!report.target_met) command.warn("the count nearest to the target is off by more than 10 %");
  });
}
