// anisomesh-mesh: polygons from lines of curvature.
#include <nlohmann/json.hpp>

#include "anisomesh/balance.hh"
#include "anisomesh/io.hh"
#include "support/command.hh"
#include "support/options.hh"
#include "support/reports.hh"

int main(int argc, char* argv[]) {
  apps::Command command("anisomesh-mesh",
                        "Fourth stage: builds the polygonal mesh from the lines of curvature.");
  std::string input, output;
  anisomesh::MeshOptions polygons;
  anisomesh::FitOptions fit;
  anisomesh::BalanceOptions balance;
  command.input(input, "input", "What anisomesh-trace wrote, .om");
  command.output(output,
                 "Where to write the result: .obj, .off, .ply or .om (with the origin of each element)");
  apps::add_mesh_options(command, polygons);
  apps::add_fit_options(command, fit, balance);

  return command.run(argc, argv, [&] {
    polygons.validate();
    fit.validate();
    polygons.for_fit = fit.enabled;
    balance.validate();
    if (!fit.enabled) command.warn_of_unused({"--fit-passes", "--balance"}, "with --no-fit");
    auto mesh = apps::read_surface(command, input);
    anisomesh::MeshReport report;
    double fitting = 0;
    auto result = anisomesh::build_polygons(mesh, polygons, &report, command.progress("polygons"));
    if (fit.enabled) {
      balance.max_degree = polygons.max_degree;
      const auto fitted = anisomesh::balance_vertices(mesh, result, balance, fit, command.progress("fit"));
      command.report()["fit"] = apps::to_json(fitted);
      fitting = fitted.seconds;
    }
    command.stop_if_cancelled();
    anisomesh::write_mesh(result, output);
    command.report()["mesh"] = apps::to_json(report);
    command.report()["result"] = apps::mesh_json(result);
    command.report()["output"] = output;
    command.say(output + ": " + apps::mesh_summary(result) + ", " + apps::seconds(report.seconds + fitting));
  });
}
