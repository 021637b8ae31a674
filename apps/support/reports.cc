#include "support/reports.hh"

#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

namespace apps {

using namespace anisomesh;

Json to_json(const ReadReport& r) {
  return {{"merged_vertices", r.merged_vertices},
          {"joined_vertices", r.joined_vertices},
          {"degenerate_faces", r.degenerate_faces},
          {"triangulated_polygons", r.triangulated_polygons},
          {"flat_faces", r.flat_faces},
          {"duplicate_faces", r.duplicate_faces},
          {"reoriented_faces", r.reoriented_faces},
          {"duplicated_vertices", r.duplicated_vertices},
          {"isolated_vertices", r.isolated_vertices},
          {"welded_vertices", r.welded_vertices},
          {"coincident_edges", r.coincident_edges}};
}

Json to_json(const FillReport& r) {
  return {{"closed", r.closed},
          {"triangles", r.triangles},
          {"joined_vertices", r.joined_vertices},
          {"left_long", r.left_long},
          {"left_folding", r.left_folding},
          {"left_non_manifold", r.left_non_manifold},
          {"seconds", r.seconds}};
}

Json to_json(const FeatureReport& r) {
  return {{"feature_edges", r.feature_edges},
          {"by_angle", r.by_angle},
          {"angle_degrees", r.angle_degrees},
          {"by_list", r.by_list},
          {"sharp", r.sharp},
          {"rounded", r.rounded},
          {"automatic", r.automatic},
          {"corners", r.corners},
          {"mechanical", r.is_mechanical()},
          {"seconds", r.seconds}};
}

Json to_json(const CurvatureReport& r) {
  return {{"radius", r.radius},
          {"normal_fraction", r.normal_fraction},
          {"noise", r.noise},
          {"enlarged_balls", r.enlarged_balls},
          {"degenerate_faces", r.degenerate_faces},
          {"seconds", r.seconds}};
}

Json to_json(const FlattenReport& r) {
  return {{"mean_conformal_distortion", r.mean_conformal_distortion},
          {"max_conformal_distortion", r.max_conformal_distortion},
          {"min_area_stretch", r.min_area_stretch},
          {"max_area_stretch", r.max_area_stretch},
          {"free_boundary", r.free_boundary},
          {"border_roundness", r.border_roundness},
          {"repaired_triangles", r.repaired_triangles},
          {"seconds", r.seconds}};
}

Json to_json(const ChartReport& r) {
  return {{"charts", r.charts},
          {"seam_edges", r.seam_edges},
          {"seam_length", r.seam_length},
          {"max_area_stretch", r.max_area_stretch},
          {"mean_conformal_distortion", r.mean_conformal_distortion},
          {"repaired_triangles", r.repaired_triangles},
          {"single_triangles", r.single_triangles},
          {"seconds", r.seconds}};
}

std::string name_of(Domain domain) {
  return domain == Domain::plane ? "plane" : domain == Domain::charts ? "charts" : "surface";
}

void add_json(Json& json, const DomainReport& r) {
  json["domain"] = {{"used", name_of(r.used)}, {"reason", r.reason}, {"seconds", r.seconds}};
  if (r.used == Domain::plane) json["flatten"] = to_json(r.flatten);
  if (r.used == Domain::charts) json["charts"] = to_json(r.charts);
}

Json to_json(const SmoothingReport& r) { return {{"mean_change", r.mean_change}, {"seconds", r.seconds}}; }

Json to_json(const UmbilicReport& r) {
  return {{"wedges", r.wedges},
          {"trisectors", r.trisectors},
          {"index_sum", r.index_sum},
          {"border_turning", r.border_turning},
          {"seconds", r.seconds}};
}

Json to_json(const TraceReport& r) {
  return {{"min_lines", r.min_lines},
          {"max_lines", r.max_lines},
          {"closed_lines", r.closed_lines},
          {"points", r.points},
          {"coverage_seeds", r.coverage_seeds},
          {"ends",
           {{"umbilic", r.ends[0]},
            {"feature", r.ends[1]},
            {"border", r.ends[2]},
            {"loop", r.ends[3]},
            {"too_close", r.ends[4]},
            {"step_limit", r.ends[5]}}},
          {"seconds", r.seconds}};
}

Json to_json(const IsotropicReport& r) {
  return {{"from_umbilics", r.from_umbilics}, {"random", r.random}, {"seconds", r.seconds}};
}

Json to_json(const MeshReport& r) {
  return {{"vertices", r.vertices},
          {"faces", r.faces},
          {"quads", r.quads},
          {"triangles", r.triangles},
          {"crossings", r.crossings},
          {"trimmed", r.trimmed},
          {"straightened", r.straightened},
          {"merged", r.merged},
          {"added_samples", r.added_samples},
          {"dropped_samples", r.dropped_samples},
          {"retries", r.retries},
          {"convexity_splits", r.convexity_splits},
          {"conforming_edges", r.conforming_edges},
          {"arrangement_seconds", r.arrangement_seconds},
          {"decimation_seconds", r.decimation_seconds},
          {"polygon_seconds", r.polygon_seconds},
          {"seconds", r.seconds}};
}

Json to_json(const BalanceReport& r) {
  return {{"rms_before", r.fit.rms_before},
          {"rms_after", r.fit.rms_after},
          {"passes", r.fit.passes},
          {"parted", r.parted},
          {"split", r.split},
          {"removed", r.removed},
          {"added", r.added},
          {"seconds", r.seconds}};
}

Json to_json(const MaxErrorReport& r) {
  return {
      {"met", r.met},
      {"how",
       "all points of both surfaces, and of their borders and feature edges, by dividing triangles and edges "
       "until the bound holds"},
      {"hausdorff_at_least", r.at_least},
      {"hausdorff_at_most", r.at_most},
      {"border_at_least", r.border.at_least},
      {"border_at_most", r.border.at_most},
      {"features_at_least", r.features.at_least},
      {"features_at_most", r.features.at_most},
      {"attempts", r.attempts},
      {"seconds", r.seconds}};
}

void add_json(Json& json, const TraceAndMeshReport& r) {
  json["epsilon_fraction"] = r.epsilon_fraction;
  json["attempts"] = r.attempts;
  for (const auto& attempt : r.tried)
    json["tried"].push_back({{"epsilon_fraction", attempt.epsilon_fraction}, {"count", attempt.count}});
  json["target_met"] = r.target_met;
  json["attempts_seconds"] = r.attempts_seconds;
  json["trace"] = to_json(r.trace);
  json["isotropic"] = to_json(r.isotropic);
  json["mesh"] = to_json(r.mesh);
}

namespace {

Json to_json(const Distances& d) { return {{"mean", d.mean}, {"rms", d.rms}, {"hausdorff", d.hausdorff}}; }

Json to_json(const std::map<int, size_t>& histogram) {
  Json json = Json::object();
  for (const auto& [key, count] : histogram) json[std::to_string(key)] = count;
  return json;
}

std::map<int, size_t> faces_by_degree(const OpenMesh::PolyMesh& mesh) {
  std::map<int, size_t> count;
  for (const auto f : mesh.faces()) ++count[static_cast<int>(mesh.valence(f))];
  return count;
}

}  // namespace

Json to_json(const Comparison& c) {
  return {{"unit_of_distances", "fraction of the bounding box diagonal of the reference"},
          {"to_reference", to_json(c.to_reference)},
          {"from_reference", to_json(c.from_reference)},
          {"two_sided", to_json(c.two_sided)},
          {"p99", c.p99_fraction},
          {"mean_normal_deviation_degrees", c.mean_normal_deviation_degrees},
          {"mean_surface_normal_deviation_degrees", c.mean_surface_normal_deviation_degrees},
          {"vertices", c.vertices},
          {"faces", c.faces},
          {"edges", c.edges},
          {"isolated_vertices", c.isolated_vertices},
          {"faces_by_degree", to_json(c.faces_by_degree)},
          {"vertices_by_valence", to_json(c.vertices_by_valence)},
          {"quad_fraction", c.quad_fraction},
          {"mean_planarity", c.mean_planarity},
          {"max_planarity", c.max_planarity},
          {"concave_faces", c.concave_faces},
          {"folded_faces", c.folded_faces},
          {"self_intersecting_faces", c.self_intersecting_faces},
          {"degenerate_faces", c.degenerate_faces},
          {"non_manifold_edges", c.non_manifold_edges},
          {"non_manifold_vertices", c.non_manifold_vertices},
          {"t_junctions", c.t_junctions},
          {"components", c.components},
          {"euler_characteristic", c.euler_characteristic},
          {"border_loops", c.border_loops},
          {"same_topology", c.same_topology},
          {"mean_alignment_degrees", c.mean_alignment_degrees},
          {"aspect_ratio_error", c.aspect_ratio_error},
          {"comparison_seconds", c.seconds}};
}

OpenMesh::TriMesh read_surface(Command& command, const std::string& path, ReadReport* report,
                               const ReadOptions& options) {
  ReadReport found;
  auto mesh = anisomesh::read_surface(path, &found, options);
  Json json = to_json(found);
  json["vertices"] = mesh.n_vertices();
  json["faces"] = mesh.n_faces();
  command.report()["read"] = std::move(json);
  const auto warn = [&](size_t count, const std::string& what) {
    if (count > 0) command.warn(path + ": " + std::to_string(count) + " " + what);
  };
  warn(found.joined_vertices, "vertices were made one with others in the same place but for rounding");
  warn(found.degenerate_faces, "faces with a corner twice were dropped");
  warn(found.flat_faces, "faces of pieces that have no area anywhere were dropped");
  warn(found.duplicate_faces, "duplicate faces were dropped");
  warn(found.reoriented_faces, "faces were turned over to agree with the rest");
  warn(found.duplicated_vertices,
       "vertices were added where the surface is not manifold; it is cut open there");
  warn(found.isolated_vertices, "vertices without a face were dropped");
  warn(found.coincident_edges,
       "pairs of border edges lie on one another, as where a file has vertices twice; the surface stays open "
       "there, and --weld 1e-6 closes it");
  if (found.welded_vertices > 0)
    command.say(path + ": " + std::to_string(found.welded_vertices) + " vertices made one with another");
  if (report) *report = std::move(found);
  return mesh;
}

void fill_holes(Command& command, OpenMesh::TriMesh& mesh, ReadReport& read, const FillOptions& options) {
  if (options.max_edges == 0) return;
  FillReport filled;
  mesh = anisomesh::fill_holes(mesh, options, &filled);
  if (read.vertex_of.empty())
    read.vertex_of = filled.vertex_of;
  else
    for (int& v : read.vertex_of)
      if (v >= 0) v = filled.vertex_of[static_cast<size_t>(v)];
  command.report()["fill_holes"] = to_json(filled);
  command.say(std::to_string(filled.closed) + " holes closed with " + std::to_string(filled.triangles) +
              " triangles");
  const auto warn = [&](size_t count, const std::string& why) {
    if (count > 0) command.warn(std::to_string(count) + " border loops are left open: " + why);
  };
  warn(filled.left_long, "they have more than " + std::to_string(options.max_edges) + " edges");
  warn(filled.left_folding, "what closes them would be folded");
  warn(filled.left_non_manifold, "an edge would get more than two faces, or they cross themselves");
}

void refine(Command& command, OpenMesh::TriMesh& mesh, const RefineFlags& flags,
            const FeatureReport& features) {
  if (flags.automatic && !features.is_mechanical()) return;
  RefineReport refined;
  OpenMesh::TriMesh finer = anisomesh::refine(mesh, flags.options, &refined);
  command.report()["refine"] = {
      {"divided", refined.divided}, {"faces", finer.n_faces()}, {"seconds", refined.seconds}};
  if (refined.divided == 0) return;
  command.say("long triangles divided: " + std::to_string(mesh.n_faces()) + " faces are now " +
              std::to_string(finer.n_faces()) + "; --refine 0 leaves them");
  mesh = std::move(finer);
}

std::string mesh_summary(const OpenMesh::PolyMesh& mesh) {
  const auto degrees = faces_by_degree(mesh);
  std::string text =
      std::to_string(mesh.n_vertices()) + " vertices, " + std::to_string(mesh.n_faces()) + " faces";
  const char* separator = ": ";
  for (const auto& [degree, count] : degrees) {
    const std::string name = degree == 3   ? "triangles"
                             : degree == 4 ? "quads"
                                           : "of " + std::to_string(degree) + " corners";
    char share[32];
    std::snprintf(share, sizeof share, " (%.0f %%)",
                  100.0 * static_cast<double>(count) / static_cast<double>(mesh.n_faces()));
    text += separator + std::to_string(count) + " " + name + share;
    separator = ", ";
  }
  return text;
}

Json mesh_json(const OpenMesh::PolyMesh& mesh) {
  return {{"vertices", mesh.n_vertices()},
          {"edges", mesh.n_edges()},
          {"faces", mesh.n_faces()},
          {"faces_by_degree", to_json(faces_by_degree(mesh))}};
}

std::string seconds(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f s", value);
  return text;
}

}  // namespace apps
