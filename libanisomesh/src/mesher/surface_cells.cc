#include "mesher/surface_cells.hh"

#include <algorithm>
#include <iterator>

namespace anisomesh::detail {

namespace {

using Triangle = MeshEmbedding::Triangle;
size_t at(int i) { return static_cast<size_t>(i); }

class SurfaceCells {
 public:
  SurfaceCells(const NetworkGraph& network, const SurfaceRef& surface, const MeshEmbedding& embedding,
               bool probes)
      : network_(network),
        surface_(surface),
        embedding_(embedding),
        probes_(probes),
        triangles_(embedding.triangles()) {}

  std::vector<Cell> run() {
    flood_all();
    for (Cell& cell : cells_) forbid_other_edges(cell);
    return std::move(cells_);
  }

 private:
  void flood_all();
  bool is_side(int triangle, size_t k) const;
  void forbid_other_edges(Cell& cell) const;
  Cell cell_of(const std::vector<int>& triangles) const;
  void add_probes(int triangle, Cell& cell) const;

  const NetworkGraph& network_;
  const SurfaceRef& surface_;
  const MeshEmbedding& embedding_;
  bool probes_;
  std::vector<Triangle> triangles_;
  std::vector<Cell> cells_;
};

// Whether an edge of the network, or the border, runs along the side from corner k to the next.
bool SurfaceCells::is_side(int triangle, size_t k) const {
  const Triangle& t = triangles_[at(triangle)];
  return t.across[k] < 0 || network_.graph.find_edge(t.node[k], t.node[(k + 1) % 3]) >= 0;
}

// The surface is linear between its vertices, so they are where it is farthest from a polygon.
void SurfaceCells::add_probes(int triangle, Cell& cell) const {
  const auto& mesh = surface_.connectivity();
  for (const auto& pinned : *triangles_[at(triangle)].pinned) {
    Probe probe;
    probe.triangle = static_cast<int>(cell.triangles.size()) - 1;
    probe.barycentric = pinned.barycentric;
    if (const auto* sample = embedding_.sample(pinned)) {
      probe.position = sample->position;
      probe.point = sample->point;
      cell.probes.push_back(probe);
      continue;
    }
    // A vertex of a feature that went is as near to the cell as the feature is followed, and may be outside.
    if (network_.origins[at(pinned.vertex)] == Origin::feature) continue;
    const OpenMesh::VertexHandle v(pinned.vertex);
    auto h = mesh.halfedge_handle(v);
    if (mesh.is_boundary(h)) h = mesh.opposite_halfedge_handle(h);
    probe.position = surface_.point(v);
    probe.point.face = mesh.face_handle(h);
    const auto corners = surface_.corners(probe.point.face);
    for (size_t k = 0; k < 3; ++k) probe.point.barycentric[k] = corners.vertex[k] == v;
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
      if (triangles.size() == 1 || is_side(i, k)) cell.sides.push_back({node[k], node[(k + 1) % 3]});
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
    for (const int m : embedding_.neighbours(n)) {
      if (n < m && std::binary_search(corners.begin(), corners.end(), m) &&
          !std::binary_search(own.begin(), own.end(), std::array<int, 2>{n, m}))
        cell.forbidden.push_back({n, m});
    }
}

// One loop around it that passes each node once, and as many triangles as a disc has with these nodes.
bool is_disc(const Cell& cell) {
  const size_t length = loop_around(cell).size();
  return length > 0 && cell.triangles.size() == length + 2 * cell.samples.size() - 2;
}

void SurfaceCells::flood_all() {
  std::vector<char> seen(triangles_.size(), 0);
  for (size_t start = 0; start < triangles_.size(); ++start) {
    if (seen[start]) continue;
    std::vector<int> found{static_cast<int>(start)};
    seen[start] = 1;
    for (size_t i = 0; i < found.size(); ++i)
      for (size_t k = 0; k < 3; ++k) {
        const int next = triangles_[at(found[i])].across[k];
        if (is_side(found[i], k) || seen[at(next)]) continue;
        seen[at(next)] = 1;
        found.push_back(next);
      }
    cells_.push_back(cell_of(found));
    if (is_disc(cells_.back())) continue;
    cells_.pop_back();
    for (const int t : found) cells_.push_back(cell_of({t}));
  }
}

}  // namespace

std::vector<Cell> surface_cells(const NetworkGraph& network, const SurfaceRef& surface,
                                const MeshEmbedding& embedding, bool probes) {
  return SurfaceCells(network, surface, embedding, probes).run();
}

}  // namespace anisomesh::detail
