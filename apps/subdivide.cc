// anisomesh-subdivide: the smooth surface that a result stands for.
#include "anisomesh/subdivide.hh"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "anisomesh/io.hh"
#include "support/command.hh"
#include "support/reports.hh"

int main(int argc, char* argv[]) {
  apps::Command command(
      "anisomesh-subdivide",
      "Divides every face in four and smooths, some times over: near the limit surface of "
      "quad/triangle subdivision. Features and corners are kept where the input is an .om.");
  std::string input, output;
  int levels = 3;
  command.input(input, "input", "Polygons: .obj, .off, .ply, .stl or .om");
  command.output(output, "Where to write the finer mesh: .obj, .off, .ply or .om");
  command.arguments()
      .add_option("--levels", levels, "How many times, 0 to 8; each has four times the faces")
      ->type_name("N")
      ->group("Subdivision");

  return command.run(argc, argv, [&] {
    anisomesh::ReadReport read;
    const auto mesh = anisomesh::read_polygons(input, &read);
    command.report()["read"] = apps::to_json(read);
    const auto fine = anisomesh::subdivide(mesh, levels);
    command.stop_if_cancelled();
    anisomesh::write_mesh(fine, output);
    command.report()["result"] = apps::mesh_json(fine);
    command.report()["output"] = output;
    command.say(output + ": " + apps::mesh_summary(fine));
  });
}
