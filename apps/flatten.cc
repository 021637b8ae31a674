// anisomesh-flatten: the surface and its curvature tensors in the plane.

#include <nlohmann/json.hpp>

#include "anisomesh/io.hh"
#include "support/command.hh"
#include "support/options.hh"
#include "support/reports.hh"

int main(int argc, char* argv[]) {
  apps::Command command("anisomesh-flatten",
                        "Second stage: maps the surface to the plane or to charts, or leaves it as it is; "
                        "smooths the tensors, finds "
                        "umbilics.");
  std::string input, output;
  anisomesh::Domain domain = anisomesh::Domain::automatic;
  anisomesh::ChartOptions charts;
  anisomesh::SmoothingOptions smoothing;
  command.input(input, "input", "What anisomesh-estimate wrote, .om");
  command.output(output, "Where to write the surface; only .om keeps what was found");
  apps::add_domain_options(command, domain, charts);
  apps::add_smoothing_options(command, smoothing);

  return command.run(argc, argv, [&] {
    charts.validate();
    smoothing.validate();
    apps::warn_of_charts(command, domain);
    auto mesh = apps::read_surface(command, input);
    const anisomesh::SurfaceRef surface = mesh;
    const auto chosen = anisomesh::choose_domain(surface, domain, charts, command.progress("flattening"));
    const auto smooth = anisomesh::smooth_tensors(surface, smoothing, command.progress("smoothing"));
    const auto umbilics = anisomesh::find_umbilics(surface);
    command.stop_if_cancelled();
    anisomesh::write_mesh(mesh, output);
    command.warn_unless_om(output);
    apps::add_json(command.report(), chosen);
    command.report()["smoothing"] = apps::to_json(smooth);
    command.report()["umbilics"] = apps::to_json(umbilics);
    command.report()["output"] = output;
    command.say(output +
                (chosen.used == anisomesh::Domain::plane ? ": in the plane, "
                 : chosen.used == anisomesh::Domain::charts
                     ? ": in " + std::to_string(chosen.charts.charts) + " charts, "
                     : ": on the surface, ") +
                std::to_string(umbilics.wedges) + " wedges, " + std::to_string(umbilics.trisectors) +
                " trisectors, " + apps::seconds(chosen.seconds + smooth.seconds + umbilics.seconds));
  });
}
