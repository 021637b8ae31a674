#include "anisomesh/mesher.hh"

#include <chrono>
#include <cmath>
#include <limits>
#include <string>

#include "anisomesh/errors.hh"
#include "anisomesh/properties.hh"
#include "decimation.hh"
#include "joining.hh"
#include "network_graph.hh"
#include "polygons.hh"

namespace anisomesh {

namespace {

using detail::NetworkGraph;
size_t at(int i) { return static_cast<size_t>(i); }

class Stopwatch {
 public:
  /// Seconds since the last call.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

double epsilon_of(const OpenMesh::TriConnectivity& mesh) {
  if (!has_property(mesh, property::epsilon)) return std::numeric_limits<double>::infinity();
  return mesh.property(require_property(mesh, property::epsilon));
}

// A sample that was kept to hold a chain near the surface, or a place where lines meet.
Origin final_origin(const NetworkGraph& network, int node) {
  const Origin origin = network.origins[at(node)];
  if (origin != Origin::line && origin != Origin::crossing) return origin;
  const auto& graph = network.graph;
  const int first = graph.first_edge(node);
  if (graph.degree(node) != 2) return Origin::crossing;
  const int second = graph.next_edge(first, node);
  return graph.edge(first).kind == graph.edge(second).kind ? Origin::line : Origin::crossing;
}

class Output {
 public:
  Output(const NetworkGraph& network, OpenMesh::PolyMesh& mesh) : network_(network), mesh_(mesh) {
    mesh_.request_vertex_status();
    mesh_.request_edge_status();
    mesh_.request_face_status();
  }
  void add(const std::vector<std::vector<int>>& polygons);

 private:
  OpenMesh::VertexHandle vertex_of(int node);

  const NetworkGraph& network_;
  OpenMesh::PolyMesh& mesh_;
  std::vector<OpenMesh::VertexHandle> vertices_;
  std::vector<int> nodes_;
};

OpenMesh::VertexHandle Output::vertex_of(int node) {
  OpenMesh::VertexHandle& v = vertices_[at(node)];
  if (!v.is_valid()) {
    v = mesh_.add_vertex(OpenMesh::PolyMesh::Point(network_.positions[at(node)]));
    nodes_.push_back(node);
  }
  return v;
}

void Output::add(const std::vector<std::vector<int>>& polygons) {
  vertices_.assign(network_.graph.n_nodes(), OpenMesh::VertexHandle());
  // Vertices in the order of the network, so that neighbours along a line are neighbours in memory.
  std::vector<char> used(vertices_.size(), 0);
  for (const auto& polygon : polygons)
    for (const int n : polygon) used[at(n)] = 1;
  for (size_t n = 0; n < used.size(); ++n)
    if (used[n]) vertex_of(static_cast<int>(n));
  std::vector<OpenMesh::VertexHandle> corners;
  for (const auto& polygon : polygons) {
    corners.clear();
    for (const int n : polygon) corners.push_back(vertices_[at(n)]);
    if (!mesh_.add_face(corners).is_valid())
      throw CannotProcess("a polygon at vertex " + std::to_string(corners.front().idx()) +
                          " of the result would not be manifold; try a smaller epsilon");
  }
  const auto origin = provide_property(mesh_, property::origin);
  const auto source_face = provide_property(mesh_, property::source_face);
  const auto barycentric = provide_property(mesh_, property::source_barycentric);
  const auto edge_kind = provide_property(mesh_, property::edge_kind);
  for (const auto v : mesh_.vertices()) {
    const int node = nodes_[at(v.idx())];
    mesh_.property(origin, v) = static_cast<int>(final_origin(network_, node));
    mesh_.property(source_face, v) = network_.points[at(node)].face.idx();
    mesh_.property(barycentric, v) = network_.points[at(node)].barycentric;
  }
  for (const auto e : mesh_.edges()) {
    const auto h = mesh_.halfedge_handle(e, 0);
    const int edge = network_.graph.find_edge(nodes_[at(mesh_.from_vertex_handle(h).idx())],
                                              nodes_[at(mesh_.to_vertex_handle(h).idx())]);
    const int kind = edge >= 0 ? network_.graph.edge(edge).kind : static_cast<int>(EdgeKind::conforming);
    mesh_.property(edge_kind, e) = kind;
    mesh_.status(e).set_feature(kind == static_cast<int>(EdgeKind::feature));
  }
}

void count_faces(const OpenMesh::PolyMesh& mesh, MeshReport& report) {
  report.vertices = mesh.n_vertices();
  report.faces = mesh.n_faces();
  for (const auto f : mesh.faces()) {
    const auto degree = mesh.valence(f);
    report.triangles += degree == 3;
    report.quads += degree == 4;
  }
}

}  // namespace

void MeshOptions::validate() const {
  if (max_degree != 0 && max_degree < 3)
    throw InvalidOption("max_degree is " + std::to_string(max_degree) +
                        "; it must be 0 (no bound) or at least 3");
  if (!(corner_angle_degrees >= 0 && corner_angle_degrees <= 180))
    throw InvalidOption("corner_angle_degrees must be between 0 and 180");
  if (!(chain_tolerance >= 0)) throw InvalidOption("chain_tolerance must not be negative");
  if (!(cell_tolerance > 0)) throw InvalidOption("cell_tolerance must be above 0");
  if (!(merge_fraction >= 0 && merge_fraction < 1)) throw InvalidOption("merge_fraction must be in [0, 1)");
  if (!(max_bend_degrees > 0 && max_bend_degrees <= 180))
    throw InvalidOption("max_bend_degrees must be above 0 and at most 180");
}

OpenMesh::PolyMesh build_polygons(const SurfaceRef& surface, const MeshOptions& options, MeshReport* report,
                                  const Progress& progress) {
  options.validate();
  MeshReport local;
  Stopwatch total, stopwatch;
  report_progress(progress, 0);
  const LineNetwork lines = read_lines(surface);
  const detail::UvLocator locator(surface);
  const double epsilon = epsilon_of(surface.connectivity());

  const detail::SurfaceNormals normals(surface);
  NetworkGraph network =
      detail::arrange_network(surface, locator, normals, lines, options.corner_angle_degrees);
  local.crossings = network.crossings;
  local.arrangement_seconds = stopwatch.lap();
  report_progress(progress, 0.5);

  const auto decimated =
      detail::decimate(network, {options.chain_tolerance * epsilon, options.merge_fraction});
  local.trimmed = decimated.trimmed;
  local.straightened = decimated.straightened;
  local.merged = decimated.merged;
  local.decimation_seconds = stopwatch.lap();
  report_progress(progress, 0.7);

  const detail::PolygonJudge judge(surface, locator, normals, {epsilon, options.max_bend_degrees});
  auto set = detail::extract_polygons(
      network, surface, locator, normals, judge,
      {{options.max_degree, options.convex}, options.cell_tolerance * epsilon, options.flip_edges});
  if (options.max_degree == 4) detail::pair_triangles(set.polygons, network, judge, options.join_lines);
  local.added_samples = set.added_samples;
  local.dropped_samples = set.dropped_samples;
  local.convexity_splits = set.convexity_splits;
  local.conforming_edges = set.conforming_edges;
  OpenMesh::PolyMesh mesh;
  Output(network, mesh).add(set.polygons);
  local.polygon_seconds = stopwatch.lap();
  report_progress(progress, 1);

  count_faces(mesh, local);
  local.seconds = total.lap();
  if (report) *report = local;
  return mesh;
}

}  // namespace anisomesh
