// Topology, elements that are not manifold, T-junctions.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "compare/compare_parts.hh"
#include "numerics/disjoint_sets.hh"

namespace anisomesh::detail {

namespace {

/// A vertex is on an edge when nearer to it than this share of the edge's length, and as far from its ends.
constexpr double on_edge = 1e-5;

struct Topology {
  int components = 0, euler_characteristic = 0, border_loops = 0;
};

/// Vertices without a face are no part of the surface and are left out.
Topology topology_of(const OpenMesh::PolyConnectivity& mesh) {
  Topology topology;
  DisjointSets sets(mesh.n_vertices());
  const auto element = [](OpenMesh::VertexHandle v) { return static_cast<size_t>(v.idx()); };
  for (const auto edge : mesh.edges()) sets.join(element(edge.v0()), element(edge.v1()));
  int vertices = 0;
  for (const auto vertex : mesh.vertices()) {
    if (mesh.is_isolated(vertex)) continue;
    ++vertices;
    if (sets.root(element(vertex)) == element(vertex)) ++topology.components;
  }
  topology.euler_characteristic =
      vertices - static_cast<int>(mesh.n_edges()) + static_cast<int>(mesh.n_faces());
  std::vector<char> seen(mesh.n_halfedges(), 0);
  for (const auto start : mesh.halfedges()) {
    if (!start.is_boundary() || seen[static_cast<size_t>(start.idx())]) continue;
    ++topology.border_loops;
    for (auto at = start; !seen[static_cast<size_t>(at.idx())]; at = at.next())
      seen[static_cast<size_t>(at.idx())] = 1;
  }
  return topology;
}

/// Edges with more than two faces, or whose two faces run along them in the same direction.
size_t count_non_manifold_edges(const std::vector<std::vector<int>>& faces) {
  std::map<std::pair<int, int>, std::pair<int, int>> uses;  // forward and backward
  for (const auto& face : faces)
    for (size_t i = 0; i < face.size(); ++i) {
      const int a = face[i], b = face[(i + 1) % face.size()];
      auto& use = uses[std::minmax(a, b)];
      ++(a < b ? use.first : use.second);
    }
  return static_cast<size_t>(std::count_if(uses.begin(), uses.end(), [](const auto& entry) {
    return entry.second.first > 1 || entry.second.second > 1;
  }));
}

/// Vertices whose faces make more than one fan.
size_t count_non_manifold_vertices(const std::vector<std::vector<int>>& faces, size_t vertices) {
  std::vector<std::vector<std::pair<int, int>>> links(vertices);
  for (const auto& face : faces)
    for (size_t i = 0; i < face.size(); ++i)
      links[static_cast<size_t>(face[i])].emplace_back(face[(i + face.size() - 1) % face.size()],
                                                       face[(i + 1) % face.size()]);
  size_t count = 0;
  for (const auto& link : links) {
    std::map<int, size_t> local;
    for (const auto& [a, b] : link) local.emplace(a, 0), local.emplace(b, 0);
    size_t next = 0;
    for (auto& [vertex, index] : local) index = next++;
    DisjointSets sets(local.size());
    for (const auto& [a, b] : link) sets.join(local[a], local[b]);
    std::set<size_t> fans;
    for (size_t i = 0; i < next; ++i) fans.insert(sets.root(i));
    count += fans.size() > 1 ? 1 : 0;
  }
  return count;
}

/// Vertices of faces that lie inside an edge they are no end of.
size_t count_t_junctions(const PolygonSoup& result, const OpenMesh::PolyMesh& mesh) {
  std::vector<std::pair<int, int>> edges;
  std::vector<Box> boxes;
  double longest = 0;
  for (const auto edge : mesh.edges()) {
    const auto a = static_cast<size_t>(edge.v0().idx()), b = static_cast<size_t>(edge.v1().idx());
    edges.emplace_back(edge.v0().idx(), edge.v1().idx());
    boxes.emplace_back();
    boxes.back().add(result.points[a]);
    boxes.back().add(result.points[b]);
    longest = std::max(longest, (result.points[b] - result.points[a]).norm());
  }
  const BoxTree tree(boxes);
  const double margin = on_edge * longest;
  size_t count = 0;
  for (const auto vertex : mesh.vertices()) {
    if (mesh.is_isolated(vertex)) continue;
    const Vec3d p = result.points[static_cast<size_t>(vertex.idx())];
    bool inside = false;
    tree.nearest(p, margin * margin, [&](int item, double&) {
      const auto [a, b] = edges[static_cast<size_t>(item)];
      if (inside || a == vertex.idx() || b == vertex.idx()) return;
      const Vec3d from = result.points[static_cast<size_t>(a)];
      const Vec3d along = result.points[static_cast<size_t>(b)] - from;
      const double length = along.norm();
      if (!(length > 0)) return;
      const double t = dot(p - from, along) / (length * length);
      inside = t > on_edge && t < 1 - on_edge && (p - from - t * along).norm() < on_edge * length;
    });
    count += inside ? 1 : 0;
  }
  return count;
}

}  // namespace

std::vector<int> merge_by_place(const std::vector<Vec3d>& points) {
  std::vector<int> order(points.size()), merged(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int i) { return points[static_cast<size_t>(i)]; };
  const auto less = [&](int i, int j) {
    const Vec3d a = key(i), b = key(j);
    return std::tie(a[0], a[1], a[2], i) < std::tie(b[0], b[1], b[2], j);
  };
  std::sort(order.begin(), order.end(), less);
  for (size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
    merged[static_cast<size_t>(order[i])] = same ? merged[static_cast<size_t>(order[i - 1])] : order[i];
  }
  return merged;
}

void measure_topology(const OpenMesh::PolyConnectivity& reference, const PolygonSoup& result,
                      const OpenMesh::PolyMesh& mesh, Comparison& comparison) {
  const Topology wanted = topology_of(reference), found = topology_of(mesh);
  comparison.components = found.components;
  comparison.euler_characteristic = found.euler_characteristic;
  comparison.border_loops = found.border_loops;
  comparison.same_topology = wanted.components == found.components &&
                             wanted.euler_characteristic == found.euler_characteristic &&
                             wanted.border_loops == found.border_loops;
  comparison.edges = mesh.n_edges();
  comparison.vertices = 0;
  for (const auto vertex : mesh.vertices()) {
    if (mesh.is_isolated(vertex)) {
      ++comparison.isolated_vertices;
      continue;
    }
    ++comparison.vertices;
    ++comparison.vertices_by_valence[static_cast<int>(vertex.valence())];
  }
  const std::vector<int> merged = merge_by_place(result.points);
  auto faces = result.faces;
  for (auto& face : faces)
    for (int& corner : face) corner = merged[static_cast<size_t>(corner)];
  comparison.non_manifold_edges = count_non_manifold_edges(faces);
  comparison.non_manifold_vertices = count_non_manifold_vertices(faces, result.points.size());
  comparison.t_junctions = count_t_junctions(result, mesh);
}

}  // namespace anisomesh::detail
