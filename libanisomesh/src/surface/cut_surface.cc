#include "surface/cut_surface.hh"

#include <algorithm>
#include <numeric>
#include <utility>

namespace anisomesh::detail {

namespace {

using OpenMesh::HalfedgeHandle;

/// The position of a halfedge's from-vertex among the corners of its face.
size_t corner_of(const OpenMesh::TriConnectivity& mesh, HalfedgeHandle halfedge) {
  const auto first = mesh.halfedge_handle(mesh.face_handle(halfedge));  // corner 0 is its to-vertex
  if (halfedge == first) return 2;
  return halfedge == mesh.next_halfedge_handle(first) ? 0 : 1;
}

/// Gives `node` to all corners around the from-vertex of `start` that are reached without crossing a feature.
void spread(const OpenMesh::TriConnectivity& mesh, HalfedgeHandle start, int node, CutSurface& cut) {
  const auto assign = [&](HalfedgeHandle h) {
    int& place = cut.corner_node[static_cast<size_t>(mesh.face_handle(h).idx())][corner_of(mesh, h)];
    if (place >= 0) return false;
    place = node;
    return true;
  };
  assign(start);
  for (auto h = start;;) {  // counter-clockwise
    const auto side = mesh.prev_halfedge_handle(h);
    h = mesh.opposite_halfedge_handle(side);
    if (mesh.is_boundary(h) || is_feature(mesh, mesh.edge_handle(h)) || !assign(h)) break;
  }
  for (auto h = start;;) {  // clockwise
    const auto across = mesh.opposite_halfedge_handle(h);
    if (mesh.is_boundary(across) || is_feature(mesh, mesh.edge_handle(h))) break;
    h = mesh.next_halfedge_handle(across);
    if (!assign(h)) break;
  }
}

}  // namespace

bool is_feature(const OpenMesh::TriConnectivity& mesh, OpenMesh::EdgeHandle edge) {
  return mesh.has_edge_status() && mesh.status(edge).feature();
}

CutSurface cut_along_features(const SurfaceRef& surface) {
  const auto& mesh = surface.connectivity();
  CutSurface cut;
  cut.on_feature.assign(mesh.n_vertices(), 0);
  for (const auto e : mesh.all_edges())
    if (is_feature(mesh, e))
      for (const auto v : {e.v0(), e.v1()}) cut.on_feature[static_cast<size_t>(v.idx())] = 1;
  cut.corner_node.assign(mesh.n_faces(), {-1, -1, -1});
  cut.vertex_of_node.resize(mesh.n_vertices());
  std::iota(cut.vertex_of_node.begin(), cut.vertex_of_node.end(), 0);
  for (const auto v : mesh.all_vertices()) {
    bool first = true;
    for (const auto h : mesh.voh_range(v)) {
      if (h.is_boundary()) continue;
      int& place = cut.corner_node[static_cast<size_t>(h.face().idx())][corner_of(mesh, h)];
      if (place >= 0) continue;
      if (!cut.on_feature[static_cast<size_t>(v.idx())]) {
        place = v.idx();
        continue;
      }
      if (!first) cut.vertex_of_node.push_back(v.idx());
      spread(mesh, h, first ? v.idx() : static_cast<int>(cut.nodes()) - 1, cut);
      first = false;
    }
  }
  return cut;
}

NodeNeighbours node_neighbours(const SurfaceRef& surface, const CutSurface& cut) {
  const auto& mesh = surface.connectivity();
  const auto for_pairs = [&](auto&& visit) {
    for (const auto f : mesh.all_faces()) {
      const auto& nodes = cut.corner_node[static_cast<size_t>(f.idx())];
      auto h = mesh.halfedge_handle(f);  // from corner 2 to corner 0
      for (size_t i = 0; i < 3; ++i, h = mesh.next_halfedge_handle(h)) {
        const int from = nodes[(i + 2) % 3], to = nodes[i];
        visit(from,
              to);  // the face across visits the other direction, if it is on the same side of all features
        if (mesh.is_boundary(mesh.opposite_halfedge_handle(h)) || is_feature(mesh, mesh.edge_handle(h)))
          visit(to, from);
      }
    }
  };
  NodeNeighbours neighbours;
  neighbours.offset.assign(cut.nodes() + 1, 0);
  for_pairs([&](int from, int) { ++neighbours.offset[static_cast<size_t>(from) + 1]; });
  std::partial_sum(neighbours.offset.begin(), neighbours.offset.end(), neighbours.offset.begin());
  neighbours.node.resize(static_cast<size_t>(neighbours.offset.back()));
  auto next = neighbours.offset;
  for_pairs([&](int from, int to) {
    neighbours.node[static_cast<size_t>(next[static_cast<size_t>(from)]++)] = to;
  });
  return neighbours;
}

std::vector<Vec3d> one_sided_values(const CutSurface& cut, const NodeNeighbours& neighbours,
                                    const std::vector<Vec3d>& at_vertices) {
  std::vector<Vec3d> values(cut.nodes());
  for (size_t n = 0; n < values.size(); ++n)
    values[n] = at_vertices[static_cast<size_t>(cut.vertex_of_node[n])];
  return one_sided_values(cut, neighbours, std::move(values),
                          [](size_t, size_t, const Vec3d& tensor) { return tensor; });
}

std::vector<Vec3d> one_sided_values(
    const CutSurface& cut, const NodeNeighbours& neighbours, std::vector<Vec3d> values,
    const std::function<Vec3d(size_t from, size_t to, const Vec3d& tensor)>& carry) {
  std::vector<char> known(cut.nodes());
  std::vector<size_t> open;
  for (size_t n = 0; n < values.size(); ++n) {
    known[n] = !cut.on_feature[static_cast<size_t>(cut.vertex_of_node[n])];
    if (!known[n]) open.push_back(n);
  }
  // Nodes whose neighbours all lie on features get their values from those, once they have some.
  while (!open.empty()) {
    std::vector<std::pair<size_t, Vec3d>> found;
    for (const size_t n : open) {
      Vec3d sum(0, 0, 0);
      int count = 0;
      for (int k = neighbours.offset[n]; k < neighbours.offset[n + 1]; ++k) {
        const auto other = static_cast<size_t>(neighbours.node[static_cast<size_t>(k)]);
        if (!known[other]) continue;
        sum += carry(other, n, values[other]);
        ++count;
      }
      if (count > 0) found.emplace_back(n, sum / count);
    }
    if (found.empty()) break;  // a part without a vertex off the features: the vertices' own values stay
    for (const auto& [n, value] : found) {
      values[n] = value;
      known[n] = 1;
    }
    open.erase(std::remove_if(open.begin(), open.end(), [&](size_t n) { return known[n] != 0; }), open.end());
  }
  return values;
}

}  // namespace anisomesh::detail
