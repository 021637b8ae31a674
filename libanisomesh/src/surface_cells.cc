#include "surface_cells.hh"

#include <algorithm>
#include <iterator>
#include <memory>
#include <numeric>

#include "numerics/bvh.hh"

namespace anisomesh::detail {

namespace {

using Triangle = MeshEmbedding::Triangle;
size_t at(int i) { return static_cast<size_t>(i); }

class SurfaceCells {
 public:
  SurfaceCells(const NetworkGraph& network, const SurfaceRef& surface, const MeshEmbedding& embedding,
               bool probes)
      : network_(network), surface_(surface), probes_(probes), triangles_(embedding.triangles()) {}

  std::vector<Cell> run() {
    find_neighbours();
    flood_all();
    for (Cell& cell : cells_) forbid_other_edges(cell);
    return std::move(cells_);
  }

 private:
  void find_neighbours();
  void flood_all();
  bool is_disc(const Cell& cell) const;
  void forbid_other_edges(Cell& cell) const;
  Cell cell_of(const std::vector<int>& triangles) const;
  void add_probes(int triangle, Cell& cell) const;

  const NetworkGraph& network_;
  const SurfaceRef& surface_;
  bool probes_;
  std::vector<Triangle> triangles_;
  std::vector<std::array<int, 3>>
      beyond_;  // of each triangle across side k to k + 1; -1: an edge of the network
  std::vector<int> first_neighbour_, neighbour_;  // of each node, over all edges of the triangulation
  std::vector<int> cell_of_triangle_;
  std::vector<Cell> cells_;
};

void SurfaceCells::find_neighbours() {
  struct Side {
    int low, high, triangle, k;
  };
  std::vector<Side> sides;
  sides.reserve(3 * triangles_.size());
  for (size_t t = 0; t < triangles_.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int a = triangles_[t].node[at(k)], b = triangles_[t].node[at((k + 1) % 3)];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<int>(t), k});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
    if (x.low != y.low) return x.low < y.low;
    return x.high != y.high ? x.high < y.high : x.triangle < y.triangle;
  });
  std::vector<std::array<int, 2>> edges;
  for (const Side& s : sides)
    if (edges.empty() || edges.back() != std::array<int, 2>{s.low, s.high}) edges.push_back({s.low, s.high});
  first_neighbour_.assign(network_.graph.n_nodes() + 1, 0);
  for (const auto& e : edges)
    for (const int n : e) ++first_neighbour_[at(n) + 1];
  std::partial_sum(first_neighbour_.begin(), first_neighbour_.end(), first_neighbour_.begin());
  neighbour_.resize(2 * edges.size());
  auto next = first_neighbour_;
  for (const auto& e : edges)
    for (size_t k = 0; k < 2; ++k) neighbour_[at(next[at(e[k])]++)] = e[1 - k];
  beyond_.assign(triangles_.size(), {-1, -1, -1});
  for (size_t i = 0; i + 1 < sides.size(); ++i) {
    const Side &x = sides[i], &y = sides[i + 1];
    if (x.low != y.low || x.high != y.high) continue;
    if (network_.graph.find_edge(x.low, x.high) >= 0) continue;
    beyond_[at(x.triangle)][at(x.k)] = y.triangle;
    beyond_[at(y.triangle)][at(y.k)] = x.triangle;
  }
}

// The surface is linear between its vertices, so they are where it is farthest from a polygon.
void SurfaceCells::add_probes(int triangle, Cell& cell) const {
  const auto& mesh = surface_.connectivity();
  for (const auto& pinned : *triangles_[at(triangle)].pinned) {
    const OpenMesh::VertexHandle v(pinned.vertex);
    auto h = mesh.halfedge_handle(v);
    if (mesh.is_boundary(h)) h = mesh.opposite_halfedge_handle(h);
    Probe probe;
    probe.position = surface_.point(v);
    probe.point.face = mesh.face_handle(h);
    const auto corners = surface_.corners(probe.point.face);
    for (size_t k = 0; k < 3; ++k) probe.point.barycentric[k] = corners.vertex[k] == v;
    probe.triangle = static_cast<int>(cell.triangles.size()) - 1;
    probe.barycentric = pinned.barycentric;
    cell.probes.push_back(probe);
  }
}

Cell SurfaceCells::cell_of(const std::vector<int>& triangles) const {
  Cell cell;
  cell.holds_samples = true;
  std::vector<int> inner;
  for (const int i : triangles) {
    const auto& node = triangles_[at(i)].node;
    cell.triangles.push_back(node);
    for (size_t k = 0; k < 3; ++k)
      if (beyond_[at(i)][k] < 0 || triangles.size() == 1) cell.sides.push_back({node[k], node[(k + 1) % 3]});
    inner.insert(inner.end(), node.begin(), node.end());
    if (probes_) add_probes(i, cell);
  }
  std::sort(inner.begin(), inner.end());
  inner.erase(std::unique(inner.begin(), inner.end()), inner.end());
  std::vector<int> around;
  for (const auto& side : cell.sides) around.push_back(side[0]);
  std::sort(around.begin(), around.end());
  std::set_difference(inner.begin(), inner.end(), around.begin(), around.end(),
                      std::back_inserter(cell.samples));
  return cell;
}

// Corners of the cell that have an edge outside it must not get another inside.
void SurfaceCells::forbid_other_edges(Cell& cell) const {
  std::vector<int> corners;
  std::vector<std::array<int, 2>> own;
  for (const auto& t : cell.triangles)
    for (size_t k = 0; k < 3; ++k) {
      corners.push_back(t[k]);
      own.push_back({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
    }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  std::sort(own.begin(), own.end());
  for (const int n : corners)
    for (int i = first_neighbour_[at(n)]; i < first_neighbour_[at(n) + 1]; ++i) {
      const int m = neighbour_[at(i)];
      if (n < m && std::binary_search(corners.begin(), corners.end(), m) &&
          !std::binary_search(own.begin(), own.end(), std::array<int, 2>{n, m}))
        cell.forbidden.push_back({n, m});
    }
}

// One loop around it that passes each node once, and as many triangles as a disc has with these nodes.
bool SurfaceCells::is_disc(const Cell& cell) const {
  if (cell.sides.empty()) return false;
  auto sides = cell.sides;
  std::sort(sides.begin(), sides.end());
  for (size_t i = 0; i + 1 < sides.size(); ++i)
    if (sides[i][0] == sides[i + 1][0]) return false;
  size_t length = 0;
  int node = sides.front()[0];
  do {
    const auto next = std::lower_bound(sides.begin(), sides.end(), std::array<int, 2>{node, -1});
    if (next == sides.end() || (*next)[0] != node) return false;
    node = (*next)[1];
    ++length;
  } while (node != sides.front()[0] && length <= sides.size());
  return length == sides.size() && cell.triangles.size() == length + 2 * cell.samples.size() - 2;
}

void SurfaceCells::flood_all() {
  cell_of_triangle_.assign(triangles_.size(), -1);
  for (size_t start = 0; start < triangles_.size(); ++start) {
    if (cell_of_triangle_[start] >= 0) continue;
    std::vector<int> found{static_cast<int>(start)};
    const int cell = static_cast<int>(cells_.size());
    cell_of_triangle_[start] = cell;
    for (size_t i = 0; i < found.size(); ++i)
      for (const int next : beyond_[at(found[i])]) {
        if (next < 0 || cell_of_triangle_[at(next)] >= 0) continue;
        cell_of_triangle_[at(next)] = cell;
        found.push_back(next);
      }
    cells_.push_back(cell_of(found));
    if (is_disc(cells_.back())) continue;
    cells_.pop_back();
    for (const int t : found) {
      cell_of_triangle_[at(t)] = static_cast<int>(cells_.size());
      cells_.push_back(cell_of({t}));
    }
  }
}

}  // namespace

std::vector<Cell> surface_cells(const NetworkGraph& network, const SurfaceRef& surface,
                                const MeshEmbedding& embedding, bool probes) {
  return SurfaceCells(network, surface, embedding, probes).run();
}

}  // namespace anisomesh::detail
