// anisomesh-flatten: the surface and its curvature tensors in the plane.
#include "anisomesh/flatten.hh"

#include <nlohmann/json.hpp>

#include "anisomesh/io.hh"
#include "support/command.hh"
#include "support/options.hh"
#include "support/reports.hh"

int main(int argc, char* argv[]) {
  apps::Command command(
      "anisomesh-flatten",
      "Second stage: maps the surface to the plane, smooths the tensors there, finds umbilics.");
  std::string input, output;
  anisomesh::SmoothingOptions smoothing;
  command.input(input, "input", "What anisomesh-estimate wrote, .om");
  command.output(output, "Where to write the surface; only .om keeps what was found");
  apps::add_smoothing_options(command, smoothing);

  return command.run(argc, argv, [&] {
    smoothing.validate();
    auto mesh = apps::read_surface(command, input);
    const anisomesh::SurfaceRef surface = mesh;
    const auto flat = anisomesh::flatten(surface, command.progress("flattening"));
    const auto smooth = anisomesh::smooth_tensors(surface, smoothing, command.progress("smoothing"));
    const auto umbilics = anisomesh::find_umbilics(surface);
    command.stop_if_cancelled();
    anisomesh::write_mesh(mesh, output);
    command.report()["flatten"] = apps::to_json(flat);
    command.report()["smoothing"] = apps::to_json(smooth);
    command.report()["umbilics"] = apps::to_json(umbilics);
    command.report()["output"] = output;
    command.say(output + ": " + std::to_string(umbilics.wedges) + " wedges, " +
                std::to_string(umbilics.trisectors) + " trisectors, " +
                apps::seconds(flat.seconds + smooth.seconds + umbilics.seconds));
  });
}
