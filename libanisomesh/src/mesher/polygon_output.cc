#include "mesher/polygon_output.hh"

#include <string>

#include "anisomesh/errors.hh"
#include "anisomesh/mesher.hh"
#include "anisomesh/properties.hh"
#include "numerics/shorter_diagonal.hh"

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

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
    // A viewer that draws a fan from the first corner then uses the shorter diagonal.
    const size_t first = polygon.size() == 4 ? shorter_diagonal(polygon, network_.positions) : 0;
    for (size_t i = 0; i < polygon.size(); ++i)
      corners.push_back(vertices_[at(polygon[(first + i) % polygon.size()])]);
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

}  // namespace

OpenMesh::PolyMesh make_mesh(const NetworkGraph& network, const std::vector<std::vector<int>>& polygons) {
  OpenMesh::PolyMesh mesh;
  Output(network, mesh).add(polygons);
  return mesh;
}

}  // namespace anisomesh::detail
