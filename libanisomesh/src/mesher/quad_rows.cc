#include "mesher/quad_rows.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <queue>
#include <utility>

namespace anisomesh::detail {

namespace {

using OpenMesh::FaceHandle, OpenMesh::PolyMesh, OpenMesh::Vec3d;

/// Logarithms of lengths that are the same but for rounding.
constexpr double kSame = 1e-6;

size_t at(int i) { return static_cast<size_t>(i); }

}  // namespace

void part_at_middles(const PolygonCorners& corners, std::vector<PolygonCorners>& pieces) {
  const size_t n = corners.size();
  size_t from = n, to = n, least = 2 * n;
  for (size_t i = 0; i < n; ++i)
    for (size_t step = 2; corners[i].is_middle && step + 2 <= n; ++step) {
      const size_t j = (i + step) % n, difference = 2 * (2 * step > n ? 2 * step - n : n - 2 * step);
      const size_t cost = difference + (corners[j].is_middle ? 0 : 1);
      if (cost < least) least = cost, from = i, to = j;
    }
  if (from == n) {
    pieces.push_back(corners);
    return;
  }
  for (const auto& [first, last] : {std::array{from, to}, std::array{to, from}}) {
    PolygonCorners piece;
    for (size_t i = first;; i = (i + 1) % n) {
      piece.push_back(corners[i]);
      if (i == last) break;
    }
    piece.front().is_middle = piece.back().is_middle = false;
    part_at_middles(piece, pieces);
  }
}

QuadRows::QuadRows(const PolyMesh& mesh) : mesh_(mesh), sets_(mesh.n_edges()) {
  for (const auto f : mesh.faces()) {
    if (!is_quad(f)) continue;
    const auto h = f.halfedge();
    sets_.join(at(h.edge().idx()), at(h.next().next().edge().idx()));
    sets_.join(at(h.next().edge().idx()), at(h.prev().edge().idx()));
  }
  // Sides of the border that lie on one another, as at a slit or a seam of texture, are divided alike.
  std::map<std::array<Vec3d, 2>, OpenMesh::EdgeHandle> on_border;
  for (const auto e : mesh.edges()) {
    if (!e.is_boundary()) continue;
    std::array ends{mesh.point(e.v0()), mesh.point(e.v1())};
    if (ends[1] < ends[0]) std::swap(ends[0], ends[1]);
    const auto [there, is_first] = on_border.emplace(ends, e);
    if (!is_first) sets_.join(at(e.idx()), at(there->second.idx()));
  }
  parts_.assign(mesh.n_edges(), 1);
  length_.assign(mesh.n_edges(), 0);
  edges_.resize(mesh.n_edges());
  faces_.resize(mesh.n_edges());
  limited_.assign(mesh.n_edges(), 0);
  for (const auto e : mesh.edges()) {
    const size_t row = row_of(e);
    edges_[row].push_back(e);
    length_[row] += mesh.calc_edge_length(e);
  }
  for (size_t row = 0; row < length_.size(); ++row)
    if (!edges_[row].empty()) length_[row] /= static_cast<double>(edges_[row].size());
  for (const auto f : mesh.faces())
    for (const auto h : f.halfedges()) {
      const size_t row = row_of(h.edge());
      if (faces_[row].empty() || faces_[row].back() != f) faces_[row].push_back(f);
      if (!is_quad(f)) limited_[row] = 1, has_others_ = true;
    }
}

size_t QuadRows::count(bool faces) {
  size_t count = faces ? 0 : mesh_.n_vertices();
  for (const auto f : mesh_.faces()) count += faces ? pieces_of(f) : inner_vertices(f);
  for (const auto e : mesh_.edges()) count += faces ? 0 : parts(e) - 1;
  return count;
}

void QuadRows::divide(size_t most, bool faces) {
  using Entry = std::pair<double, long>;  // length of a part; rows in their order, the first first
  std::priority_queue<Entry> longest;
  const auto push = [&](size_t row) {
    const double length = length_[row] / static_cast<double>(parts_[row]);
    if (!limited_[row] || parts_[row] == 1)
      longest.emplace(std::round(std::log(length) / kSame), -static_cast<long>(row));
  };
  for (size_t row = 0; row < edges_.size(); ++row)
    if (!edges_[row].empty() && length_[row] > 0) push(row);
  for (size_t count = this->count(faces); !longest.empty();) {
    const auto row = static_cast<size_t>(-longest.top().second);
    longest.pop();
    const size_t before = around(row, faces);
    ++parts_[row];
    const size_t more = around(row, faces) - before;
    if (count + more > most)
      --parts_[row];  // and is not looked at again
    else
      count += more, push(row);
  }
}

std::array<size_t, 2> QuadRows::grid_of(FaceHandle f) {
  const auto h = OpenMesh::make_smart(f, mesh_).halfedge();
  return {parts(h.edge()), parts(h.next().edge())};
}

size_t QuadRows::pieces_of(FaceHandle f) {
  if (is_quad(f)) {
    const auto [a, b] = grid_of(f);
    return a * b;
  }
  PolygonCorners corners;
  size_t middles = 0;
  for (const auto h : mesh_.fh_range(f)) {
    corners.emplace_back();
    if (parts(mesh_.edge_handle(h)) == 2) corners.push_back({OpenMesh::VertexHandle(), true}), ++middles;
  }
  if (2 * middles == corners.size()) return middles;
  std::vector<PolygonCorners> pieces;
  part_at_middles(corners, pieces);
  return pieces.size();
}

size_t QuadRows::inner_vertices(FaceHandle f) {
  if (is_quad(f)) {
    const auto [a, b] = grid_of(f);
    return (a - 1) * (b - 1);
  }
  bool all = true;
  for (const auto e : mesh_.fe_range(f)) all = all && parts(e) == 2;
  return all ? 1 : 0;
}

// Faces or vertices of what a row has to do with.
size_t QuadRows::around(size_t row, bool faces) {
  size_t count = faces ? 0 : edges_[row].size() * (parts_[row] - 1);
  for (const auto f : faces_[row]) count += faces ? pieces_of(f) : inner_vertices(f);
  return count;
}

}  // namespace anisomesh::detail
