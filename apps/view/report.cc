#include "view/report.hh"

#include <nlohmann/json.hpp>

#include "anisomesh/curvature.hh"
#include "anisomesh/properties.hh"
#include "support/reports.hh"

namespace view {

using namespace anisomesh;

Shown Meshes::shown() const {
  Shown shown;
  if (!surfaces.empty()) {
    shown.surface = &surfaces.back().mesh;  // the page shows the last one, which has most on it
    shown.surface_name = surfaces.back().name;
  }
  if (!results.empty()) {
    shown.result = &results.front().mesh;
    shown.result_name = results.front().name;
  }
  return shown;
}

std::vector<Table> compare_all(Meshes& meshes, const CompareOptions& options, const Progress& progress) {
  std::vector<Table> tables;
  if (meshes.surfaces.empty() || meshes.results.empty()) return tables;
  // The ruler needs directions for alignment; what is shown of the surface stays what is on it.
  OpenMesh::TriMesh measured = meshes.surfaces.front().mesh;
  const SurfaceRef reference = measured;
  if (!has_property(measured, property::gamma_max))
    estimate_curvature(reference, {}, sub_progress(progress, 0, 0.5));
  for (auto& result : meshes.results) {
    const auto comparison = compare(reference, result.mesh, options, sub_progress(progress, 0.5, 1));
    apps::Json rows = apps::Json::object();
    for (const auto& [what, value] : apps::comparison_lines(comparison)) rows[what] = value;
    tables.push_back({"Figures of " + result.name, std::move(rows)});
  }
  return tables;
}

std::string make_report(const std::string& title, const Meshes& meshes, const std::vector<Table>& tables,
                        const Scene& scene) {
  std::vector<Model> models;
  // The surfaces are only read; a view of one asks for a mesh that can be written to.
  std::list<SurfaceRef> surfaces;
  for (const auto& s : meshes.surfaces) surfaces.emplace_back(const_cast<OpenMesh::TriMesh&>(s.mesh));
  const Frame frame = surfaces.empty() ? frame_of(meshes.results.front().mesh) : frame_of(surfaces.front());
  auto name = meshes.surfaces.begin();
  for (const auto& surface : surfaces) models.push_back(surface_model((name++)->name, surface, frame));
  for (const auto& result : meshes.results) models.push_back(result_model(result.name, result.mesh, frame));
  return make_page(title, frame, models, tables, scene);
}

}  // namespace view
