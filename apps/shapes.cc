// anisomesh-shapes: synthetic surfaces with known geometry.
#include "anisomesh/shapes.hh"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "anisomesh/io.hh"
#include "support/command.hh"

int main(int argc, char* argv[]) {
  apps::Command command("anisomesh-shapes",
                        "Writes a surface made by code, a disc or a closed one. The creases of octa-flower "
                        "and cube are feature "
                        "edges; only .om keeps them.");
  std::string names;
  for (const auto& name : anisomesh::shape_names()) names += (names.empty() ? "" : ", ") + name;
  std::string name, output;
  anisomesh::ShapeOptions options;
  CLI::App& app = command.arguments();
  app.add_option("name", name, "One of " + names)->required()->type_name("NAME");
  command.output(output, "Where to write the mesh: .obj, .off, .ply or .om");
  app.add_option("--vertices", options.vertices, "About so many vertices, >= 9")
      ->type_name("N")
      ->group("Sampling");
  app.add_flag("--irregular", options.irregular, "Irregular sampling instead of a regular grid")
      ->group("Sampling");
  app.add_option("--noise", options.noise,
                 "Standard deviation of noise along the normal, fraction of the bounding box diagonal")
      ->type_name("S")
      ->group("Sampling");
  app.add_option("--seed", options.seed, "Of sampling and noise")->type_name("N")->group("Sampling");

  return command.run(argc, argv, [&] {
    const auto mesh = anisomesh::make_shape(name, options);
    command.stop_if_cancelled();
    anisomesh::write_mesh(mesh, output);
    command.report()["output"] = output;
    command.report()["vertices"] = mesh.n_vertices();
    command.report()["faces"] = mesh.n_faces();
    command.say(output + ": " + std::to_string(mesh.n_vertices()) + " vertices, " +
                std::to_string(mesh.n_faces()) + " triangles");
  });
}
