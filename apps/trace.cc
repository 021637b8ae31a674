// anisomesh-trace: lines of curvature and isotropic samples.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "anisomesh/fit.hh"
#include "anisomesh/io.hh"
#include "support/command.hh"
#include "support/options.hh"
#include "support/reports.hh"

int main(int argc, char* argv[]) {
  apps::Command command(
      "anisomesh-trace",
      "Third stage: traces lines of curvature and places isotropic samples. With a target it builds "
      "the polygons too, to count them: give the polygon options of anisomesh-mesh then.");
  std::string input, output;
  apps::EpsilonFlags epsilon;
  anisomesh::TraceOptions trace;
  anisomesh::TargetOptions target;
  anisomesh::MeshOptions polygons;
  polygons.for_fit = anisomesh::FitOptions().enabled;
  command.input(input, "input", "What anisomesh-flatten wrote, .om");
  command.output(output, "Where to write the surface; only .om keeps what was found");
  apps::add_density_options(command, epsilon, trace);
  apps::add_target_options(command, target);
  apps::add_mesh_options(command, polygons, "Polygons, for a target");
  command.arguments()
      .add_flag("--fit,!--no-fit", polygons.for_fit,
                "anisomesh-mesh will fit the polygons; --no-fit: it will not")
      ->group("Polygons, for a target");

  return command.run(argc, argv, [&] {
    polygons.validate();
    apps::warn_of_epsilon(command, target);
    auto mesh = apps::read_surface(command, input);
    const anisomesh::SurfaceRef surface = mesh;
    trace.density.epsilon_fraction = apps::resolve(epsilon, surface);
    anisomesh::TraceAndMeshReport report;
    if (target.target_faces > 0 || target.target_vertices > 0) {
      anisomesh::trace_and_mesh(surface, trace, polygons, target, &report, command.progress("tracing"));
      apps::add_json(command.report(), report);
    } else {
      report.trace = anisomesh::trace_lines(surface, trace, command.progress("tracing"));
      report.isotropic =
          anisomesh::place_isotropic_samples(surface, trace, command.progress("isotropic samples"));
      report.epsilon_fraction =
          trace.density.epsilon(surface.diagonal(), surface.extent()) / surface.diagonal();
      command.report()["epsilon_fraction"] = report.epsilon_fraction;
      command.report()["trace"] = apps::to_json(report.trace);
      command.report()["isotropic"] = apps::to_json(report.isotropic);
    }
    command.stop_if_cancelled();
    anisomesh::write_mesh(mesh, output);
    command.warn_unless_om(output);
    command.report()["output"] = output;
    command.say(output + ": " + std::to_string(report.trace.min_lines) + " min lines, " +
                std::to_string(report.trace.max_lines) + " max lines, " +
                std::to_string(report.isotropic.from_umbilics + report.isotropic.random) +
                " isotropic samples, " + apps::seconds(report.trace.seconds + report.isotropic.seconds));
    if (!report.target_met) command.warn("the count nearest to the target is off by more than 10 %");
  });
}
