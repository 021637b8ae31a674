#include "mesher/polygon_adjacency.hh"

#include <algorithm>
#include <utility>

#include "mesher/region_layout.hh"

namespace anisomesh::detail {

namespace {

using Polygon = std::vector<int>;
size_t at(int i) { return static_cast<size_t>(i); }

std::uint64_t key_of(int a, int b) {
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | static_cast<std::uint64_t>(std::max(a, b));
}

}  // namespace

PolygonAdjacency::PolygonAdjacency(const std::vector<Polygon>& polygons, size_t n_nodes,
                                   std::function<bool(int, int)> may_cross)
    : faces_at_(n_nodes, 0), may_cross_(std::move(may_cross)) {
  sides_.reserve(2 * polygons.size());
  for (size_t p = 0; p < polygons.size(); ++p) put_in(polygons, static_cast<int>(p));
}

void PolygonAdjacency::put_in(const std::vector<Polygon>& polygons, int polygon) {
  const Polygon& corners = polygons[at(polygon)];
  if (neighbors_.size() <= at(polygon)) neighbors_.resize(at(polygon) + 1);
  neighbors_[at(polygon)].assign(corners.size(), -1);
  count(corners, 1);
  for (size_t i = 0; i < corners.size(); ++i) {
    const int from = corners[i], to = corners[(i + 1) % corners.size()];
    auto& [first, second] = sides_[key_of(from, to)];
    if (first.polygon >= 0 && second.polygon >= 0) continue;  // one too many: the topology will tell
    (first.polygon < 0 ? first : second) = {polygon, i};
    if (first.polygon < 0 || second.polygon < 0 || !may_cross_(from, to)) continue;
    neighbors_[at(first.polygon)][first.corner] = second.polygon;
    neighbors_[at(second.polygon)][second.corner] = first.polygon;
  }
}

void PolygonAdjacency::take_out(const std::vector<Polygon>& polygons, int polygon) {
  const Polygon& corners = polygons[at(polygon)];
  count(corners, -1);
  for (size_t i = 0; i < corners.size(); ++i) {
    const auto found = sides_.find(key_of(corners[i], corners[(i + 1) % corners.size()]));
    if (found == sides_.end()) continue;
    auto& [first, second] = found->second;
    if (second.polygon == polygon && second.corner == i) std::swap(first, second);
    if (first.polygon != polygon || first.corner != i) continue;
    first = second;
    second = {};
    if (first.polygon < 0)
      sides_.erase(found);
    else
      neighbors_[at(first.polygon)][first.corner] = -1;
  }
  neighbors_[at(polygon)].clear();
}

bool PolygonAdjacency::are_joined(int a, int b) const { return sides_.count(key_of(a, b)) > 0; }

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

// The nodes around polygons each of which lies beside the one before it; one may be there more than once.
Polygon PolygonAdjacency::ring_around(const std::vector<Polygon>& polygons,
                                      const std::vector<int>& path) const {
  Polygon ring = polygons[at(path.front())];
  for (size_t i = 1; i < path.size(); ++i) {
    const Polygon& before = polygons[at(path[i - 1])];
    const Polygon& next = polygons[at(path[i])];
    size_t side = 0;
    while (neighbor(path[i - 1], side) != path[i]) ++side;
    const int a = before[side], b = before[(side + 1) % before.size()];
    size_t place = 0;
    while (place < ring.size() && (ring[place] != a || ring[(place + 1) % ring.size()] != b)) ++place;
    if (place == ring.size()) return {};
    const auto start = static_cast<size_t>(std::find(next.begin(), next.end(), a) - next.begin());
    for (size_t k = 1; next[(start + k) % next.size()] != b; ++k)
      ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(++place), next[(start + k) % next.size()]);
  }
  return ring;
}

// Where polygons lie beside each other by more than one side, the ring runs to a node that they enclose and
// back. \return such nodes, which are no corners any more
Polygon PolygonAdjacency::take_out_enclosed(Polygon& ring) const {
  Polygon enclosed;
  for (size_t i = 0; ring.size() > 3 && i < ring.size();) {
    const size_t n = ring.size(), before = (i + n - 1) % n, after = (i + 1) % n;
    if (ring[before] != ring[after] || !may_cross_(ring[i], ring[after])) {
      ++i;
      continue;
    }
    enclosed.push_back(ring[i]);
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(std::max(i, after)));
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(std::min(i, after)));
    i = 0;
  }
  return enclosed;
}

RegionCorners PolygonAdjacency::around(const std::vector<Polygon>& polygons, const std::vector<int>& path,
                                       const NetworkGraph& network, bool may_drop) const {
  Polygon ring = ring_around(polygons, path), known;
  if (may_drop) known = take_out_enclosed(ring);
  RegionCorners corners;
  if (ring.size() < 3) return corners;
  Polygon sorted = ring;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return corners;
  // Polygons that lie on each other leave corners out.
  known.insert(known.end(), sorted.begin(), sorted.end());
  std::sort(known.begin(), known.end());
  for (const int p : path)
    for (const int n : polygons[at(p)])
      if (!std::binary_search(known.begin(), known.end(), n)) return corners;
  for (const int n : ring) corners.add(network, n);
  corners.loop = ring.size();
  for (size_t i = 1; i + 1 < ring.size(); ++i)
    corners.normal +=
        cross(corners.position[i] - corners.position[0], corners.position[i + 1] - corners.position[0]);
  if (!network.planar) {
    corners.on_surface = true;
    for (size_t i = 0, n = ring.size(); i < n; ++i)
      corners.set_face(network, ring[(i + n - 1) % n], static_cast<int>(i), ring[(i + 1) % n]);
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
