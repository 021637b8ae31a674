#include "polygon_adjacency.hh"

#include <algorithm>

#include "region_layout.hh"

namespace anisomesh::detail {

namespace {

using Polygon = std::vector<int>;
size_t at(int i) { return static_cast<size_t>(i); }

}  // namespace

PolygonAdjacency::PolygonAdjacency(const std::vector<Polygon>& polygons, size_t n_nodes,
                                   const std::function<bool(int, int)>& may_cross)
    : faces_at_(n_nodes, 0) {
  struct Side {
    int low, high;
    size_t place;
    int polygon;
  };
  std::vector<Side> sides;
  for (size_t p = 0; p < polygons.size(); ++p) {
    first_.push_back(neighbors_.size());
    count(polygons[p], 1);
    for (size_t i = 0; i < polygons[p].size(); ++i) {
      const int from = polygons[p][i], to = polygons[p][(i + 1) % polygons[p].size()];
      sides.push_back({std::min(from, to), std::max(from, to), neighbors_.size(), static_cast<int>(p)});
      neighbors_.push_back(-1);
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
    if (x.low != y.low) return x.low < y.low;
    return x.high != y.high ? x.high < y.high : x.place < y.place;
  });
  sides_.reserve(sides.size());
  for (const Side& s : sides) sides_.push_back({s.low, s.high});
  for (size_t i = 0; i + 1 < sides.size(); ++i) {
    const Side &x = sides[i], &y = sides[i + 1];
    if (x.low != y.low || x.high != y.high || !may_cross(x.low, x.high)) continue;
    neighbors_[x.place] = y.polygon;
    neighbors_[y.place] = x.polygon;
  }
}

bool PolygonAdjacency::are_joined(int a, int b) const {
  return std::binary_search(sides_.begin(), sides_.end(), std::array<int, 2>{std::min(a, b), std::max(a, b)});
}

void PolygonAdjacency::forbid_other_sides(RegionCorners& corners, const std::vector<Polygon>& polygons,
                                          const std::vector<int>& path) const {
  const auto is_own = [&](int a, int b) {
    for (const int p : path)
      for (size_t i = 0; i < polygons[at(p)].size(); ++i) {
        const int from = polygons[at(p)][i], to = polygons[at(p)][(i + 1) % polygons[at(p)].size()];
        if ((from == a && to == b) || (from == b && to == a)) return true;
      }
    return false;
  };
  for (size_t i = 0; i < corners.size(); ++i)
    for (size_t k = i + 1; k < corners.size(); ++k)
      if (are_joined(corners.node[i], corners.node[k]) && !is_own(corners.node[i], corners.node[k]))
        corners.forbid(static_cast<int>(i), static_cast<int>(k));
}

std::vector<int> PolygonAdjacency::fan(const std::vector<Polygon>& polygons, int polygon, int node) const {
  std::vector<int> result{polygon};
  while (true) {
    const Polygon& last = polygons[at(result.back())];
    const auto corner = std::find(last.begin(), last.end(), node) - last.begin();
    const int next = neighbor(result.back(), (static_cast<size_t>(corner) + last.size() - 1) % last.size());
    if (next == polygon) return result;
    if (next < 0 || static_cast<int>(result.size()) > faces_at(node)) return {};
    result.push_back(next);
  }
}

RegionCorners PolygonAdjacency::around(const std::vector<Polygon>& polygons, const std::vector<int>& path,
                                       const NetworkGraph& network, bool may_drop) const {
  Polygon ring = polygons[at(path.front())];
  for (size_t i = 1; i < path.size(); ++i) {
    const Polygon& before = polygons[at(path[i - 1])];
    const Polygon& next = polygons[at(path[i])];
    size_t side = 0;
    while (neighbor(path[i - 1], side) != path[i]) ++side;
    const int a = before[side], b = before[(side + 1) % before.size()];
    const auto start = static_cast<size_t>(std::find(next.begin(), next.end(), a) - next.begin());
    auto place = std::find(ring.begin(), ring.end(), b) - ring.begin();
    for (size_t k = 1; next[(start + k) % next.size()] != b; ++k, ++place)
      ring.insert(ring.begin() + place, next[(start + k) % next.size()]);
  }
  // Where the last polygon lies beside the first as well, the node they all share is no corner any more.
  for (size_t i = 0; may_drop && ring.size() > 3 && i < ring.size();) {
    const size_t n = ring.size(), before = (i + n - 1) % n, after = (i + 1) % n;
    if (ring[before] != ring[after]) {
      ++i;
      continue;
    }
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(std::max(i, after)));
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(std::min(i, after)));
    i = 0;
  }
  RegionCorners corners;
  if (ring.size() < 3) return corners;
  Polygon sorted = ring;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return corners;
  // Polygons that lie on each other leave corners out.
  for (const int p : path)
    for (const int n : polygons[at(p)])
      if (!std::binary_search(sorted.begin(), sorted.end(), n)) return corners;
  for (const int n : ring) corners.add(network, n);
  corners.loop = ring.size();
  for (size_t i = 1; i + 1 < ring.size(); ++i)
    corners.normal +=
        cross(corners.position[i] - corners.position[0], corners.position[i + 1] - corners.position[0]);
  if (!network.planar) {
    corners.on_surface = true;
    corners.take_normals_of(in_corners(corners, polygons, path));
    lay_out(corners);
    forbid_other_sides(corners, polygons, path);
  }
  return corners;
}

std::vector<Polygon> in_corners(const RegionCorners& corners, const std::vector<Polygon>& polygons,
                                const std::vector<int>& path) {
  std::vector<Polygon> result;
  for (const int p : path) {
    result.emplace_back();
    for (const int n : polygons[at(p)]) {
      const auto place = std::find(corners.node.begin(), corners.node.end(), n);
      if (place != corners.node.end())
        result.back().push_back(static_cast<int>(place - corners.node.begin()));
    }
  }
  return result;
}

}  // namespace anisomesh::detail
