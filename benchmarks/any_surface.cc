// Every mesh of libcgal-demo, of any topology: remeshed, compared, judged, or refused with a reason.
//
//   ANISOMESH_DATA=FOLDER any_surface [--target FACES] [--feature-angle DEGREES] [--domain
//   auto|surface|charts]
//                                     [--largest TRIANGLES] [--no-fit] [NAME...]
//
// Prints a markdown table, a row for each mesh, smallest first; the target is at most half the triangles of
// the input. "Features" is the share of the length of the tagged edges that lies within 0.05 % of the
// diagonal of an edge of the result. Then one line for each promise that a result breaks: the components,
// Euler characteristic and border loops of the input, no folded, concave or degenerate face, nothing
// non-manifold and no T-junctions that the input does not have, all features covered that were asked for,
// faces within 10 % of the target. Exits 1 if there is one, 77 if the meshes are not there. A refusal is
// none, and is listed with its reason.
#include <algorithm>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "anisomesh/curvature.hh"
#include "anisomesh/errors.hh"
#include "anisomesh/features.hh"
#include "anisomesh/properties.hh"
#include "anisomesh/refine.hh"
#include "anisomesh/remesh.hh"
#include "arguments.hh"
#include "bench.hh"

using namespace anisomesh;

namespace {

constexpr size_t least_triangles = 500;  // of an input that can be asked for a number of faces

struct Settings {
  size_t target = 2000, largest = 200000;
  FeatureOptions features;
  Domain domain = Domain::automatic;
  bool unfitted = false;
};

Domain domain_named(const std::string& name) {
  return name == "surface" ? Domain::surface : name == "charts" ? Domain::charts : Domain::automatic;
}

double distance_to_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d along = b - a;
  const double t = std::clamp(((p - a) | along) / std::max(along.sqrnorm(), 1e-300), 0.0, 1.0);
  return (p - a - t * along).norm();
}

// The share of the length of the tagged edges that edges of the result cover.
double covered_features(const SurfaceRef& surface, const OpenMesh::PolyMesh& result) {
  const auto& mesh = surface.connectivity();
  std::vector<std::array<Vec3d, 2>> edges;
  const auto kind = require_property(result, property::edge_kind);
  for (const auto e : result.edges())
    if (result.property(kind, e) == static_cast<int>(EdgeKind::feature))
      edges.push_back({result.point(e.v0()), result.point(e.v1())});
  const double near = 5e-4 * surface.diagonal();
  double total = 0, covered = 0;
  constexpr int samples = 4;
  for (const auto e : mesh.edges()) {
    if (!mesh.status(e).feature() || mesh.is_boundary(e)) continue;
    const auto h = mesh.halfedge_handle(e, 0);
    const Vec3d &a = surface.point(mesh.from_vertex_handle(h)), &b = surface.point(mesh.to_vertex_handle(h));
    for (int i = 0; i < samples; ++i) {
      const Vec3d p = a + (i + 0.5) / samples * (b - a);
      total += (b - a).norm();
      if (std::any_of(edges.begin(), edges.end(),
                      [&](const auto& edge) { return distance_to_segment(p, edge[0], edge[1]) <= near; }))
        covered += (b - a).norm();
    }
  }
  return total > 0 ? covered / total : 1;
}

Comparison against_itself(OpenMesh::TriMesh& mesh) {
  OpenMesh::PolyMesh same;
  for (const auto v : mesh.vertices()) same.add_vertex(mesh.point(v));
  for (const auto f : mesh.faces()) {
    std::vector<OpenMesh::VertexHandle> corners;
    for (const auto v : mesh.fv_range(f)) corners.push_back(v);
    same.add_face(corners);
  }
  CompareOptions options;
  options.samples = 1000;
  return compare(mesh, same, options);
}

void judge(OpenMesh::TriMesh& mesh, const std::string& name, const Comparison& c, size_t target,
           double features, const RemeshReport& report, bench::Bars& bars) {
  const Comparison input = against_itself(mesh);
  bars.check(c.same_topology, name + ": topology", false);
  bars.check(c.folded_faces == 0, name + ": " + std::to_string(c.folded_faces) + " folded faces", false);
  bars.check(c.concave_faces == 0, name + ": " + std::to_string(c.concave_faces) + " concave faces", false);
  bars.check(c.degenerate_faces == 0, name + ": " + std::to_string(c.degenerate_faces) + " degenerate faces",
             false);
  // Copies of a vertex that reading made, or that the file has, stay in one place.
  bars.check(c.non_manifold_edges + c.non_manifold_vertices <=
                 input.non_manifold_edges + input.non_manifold_vertices,
             name + ": " + std::to_string(c.non_manifold_edges) + " edges and " +
                 std::to_string(c.non_manifold_vertices) + " vertices that are not manifold",
             false);
  bars.check(c.t_junctions == 0 || input.t_junctions > 0 || input.non_manifold_vertices > 0,
             name + ": " + std::to_string(c.t_junctions) + " T-junctions", false);
  bars.check(report.features.automatic || features > 0.999,
             name + ": features covered by " + bench::format("%.1f", 100 * features) + " %", false);
  bars.check(report.target_met,
             name + ": " + std::to_string(c.faces) + " faces for " + std::to_string(target), false);
}

void run(const std::filesystem::path& path, const Settings& settings, bench::Bars& bars,
         std::vector<std::string>& refusals) {
  const std::string name = path.filename().string();
  try {
    auto mesh = read_surface(path.string());
    if (mesh.n_faces() > settings.largest) return;
    RemeshOptions options;
    options.domain = settings.domain;
    options.fit.enabled = !settings.unfitted;
    options.target_faces = std::max<size_t>(4, std::min(settings.target, mesh.n_faces() / 2));
    // As the apps do.
    const FeatureReport tagged = tag_features(mesh, settings.features);
    auto input = tagged.is_mechanical() ? refine(mesh) : mesh;
    options.features.automatic = false;  // what is tagged now is what there is
    RemeshReport report;
    auto result = remesh(input, options, &report);
    report.features = tagged;
    CompareOptions compare_options;
    compare_options.samples = 50000;
    estimate_curvature(mesh, options.curvature);  // what the alignment is measured against
    const Comparison c = compare(mesh, result, compare_options);
    const double features = covered_features(mesh, result);
    std::printf("| %s | %zu | %d | %zu | %zu | %.0f | %.4f | %.3f | %.1f | %zu | %.1f | %zu | %zu | %.2f |\n",
                name.c_str(), mesh.n_faces(), c.euler_characteristic, c.faces, c.vertices,
                100 * c.quad_fraction, 100 * c.two_sided.rms, 100 * c.two_sided.hausdorff,
                c.mean_alignment_degrees, report.features.feature_edges, 100 * features,
                c.self_intersecting_faces, report.mesh.retries, report.seconds);
    std::fflush(stdout);
    judge(mesh, name, c, options.target_faces, features, report, bars);
  } catch (const std::exception& e) {
    refusals.push_back(name + ": " + e.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  bench::Arguments arguments;
  arguments.number("--target", settings.target);
  arguments.features("--feature-angle", settings.features);
  arguments.number("--largest", settings.largest);
  arguments.flag("--no-fit", settings.unfitted);
  arguments.value("--domain", [&](const std::string& name) { settings.domain = domain_named(name); });
  const auto names = arguments.read(argc, argv);
  const char* folder = std::getenv("ANISOMESH_DATA");
  if (!folder || !std::filesystem::is_directory(folder)) {
    std::fprintf(stderr, "any_surface: set ANISOMESH_DATA to the unpacked data of libcgal-demo\n");
    return 77;
  }
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const auto ending = entry.path().extension();
    if (ending != ".off" && ending != ".obj" && ending != ".stl" && ending != ".ply") continue;
    const bool known = std::any_of(paths.begin(), paths.end(), [&](const auto& path) {
      return path.filename() == entry.path().filename();  // the package has some twice
    });
    if (known) continue;
    if (names.empty() || std::find(names.begin(), names.end(), entry.path().filename()) != names.end())
      paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end(), [](const auto& x, const auto& y) {
    const auto a = std::filesystem::file_size(x), b = std::filesystem::file_size(y);
    return a != b ? a < b : x < y;
  });
  std::printf(
      "| mesh | triangles | Euler | faces | vertices | quads %% | RMS %% | Hausdorff %% | alignment | "
      "feature "
      "edges | covered %% | crossing faces | retries | seconds "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  bench::Bars bars;
  std::vector<std::string> refusals;
  for (const auto& path : paths) run(path, settings, bars, refusals);
  std::printf("\n");
  for (const std::string& reason : refusals) std::printf("refused: %s\n", reason.c_str());
  return bars.missed() > 0 ? 1 : 0;
}
