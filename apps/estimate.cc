// anisomesh-estimate: feature edges and curvature tensors.
#include <nlohmann/json.hpp>

#include "anisomesh/io.hh"
#include "support/command.hh"
#include "support/options.hh"
#include "support/reports.hh"

int main(int argc, char* argv[]) {
  apps::Command command("anisomesh-estimate",
                        "First stage: tags feature edges and estimates curvature tensors at the vertices.");
  std::string input, output;
  anisomesh::ReadOptions reading;
  anisomesh::FillOptions fill;
  apps::RefineFlags refine;
  apps::FeatureFlags features;
  anisomesh::CurvatureOptions curvature;
  command.input(input, "input", "The surface: .obj, .off, .ply, .stl or .om");
  command.output(output, "Where to write the surface; only .om keeps what was found");
  apps::add_weld_option(command, reading);
  apps::add_fill_option(command, fill);
  apps::add_feature_options(command, features);
  apps::add_refine_option(command, refine);
  apps::add_curvature_options(command, curvature);

  return command.run(argc, argv, [&] {
    reading.validate();
    fill.validate();
    refine.options.validate();
    curvature.validate();
    anisomesh::ReadReport read;
    auto mesh = apps::read_surface(command, input, &read, reading);
    apps::fill_holes(command, mesh, read, fill);
    const auto tagged = anisomesh::tag_features(mesh, apps::resolve(features, read));
    apps::refine(command, mesh, refine, tagged);
    const auto estimated = anisomesh::estimate_curvature(mesh, curvature, command.progress("curvature"));
    command.stop_if_cancelled();
    anisomesh::write_mesh(mesh, output);
    command.warn_unless_om(output);
    command.report()["features"] = apps::to_json(tagged);
    command.report()["curvature"] = apps::to_json(estimated);
    command.report()["output"] = output;
    command.say(output + ": curvature at " + std::to_string(mesh.n_vertices()) + " vertices, " +
                std::to_string(tagged.feature_edges) + " feature edges, " + apps::seconds(estimated.seconds));
    apps::tell_of_features(command, tagged);
  });
}
