// Features and borders of a result that is being changed: what is beside them, on both sides.
#include <algorithm>
#include <utility>

#include "anisomesh/mesher.hh"
#include "balance/patch_mesh.hh"

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

bool contains(const std::vector<int>& values, int value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

}  // namespace

// The others on the sides of curves at a vertex, each once.
std::vector<int> PatchMesh::beside_on_curve(int v) const {
  std::vector<int> found;
  for (const int p : vertices_[at(v)].polygons) {
    const auto& polygon = polygons_[at(p)];
    const size_t n = polygon.size();
    for (size_t i = 0; i < n; ++i)
      for (const int w : {polygon[(i + 1) % n], polygon[(i + n - 1) % n]})
        if (polygon[i] == v && is_on_curve(v, w) && !contains(found, w)) found.push_back(w);
  }
  return found;
}

// Polygons on one side of a curve around a vertex of it, counter-clockwise from the side to `from` to that to
// `to`, and the ring without the vertex, which begins with the side from `to` to `from` that takes its place.
// Where the only polygon is a triangle, the one beyond takes its place.
PatchMesh::Patch PatchMesh::beside_curve(int v, int from, int to) const {
  std::vector<int> fan;
  for (int w = from; w != to;) {
    const auto& around = vertices_[at(v)].polygons;
    const auto found = std::find_if(around.begin(), around.end(), [&](int p) {
      const auto& polygon = polygons_[at(p)];
      const auto corner = std::find(polygon.begin(), polygon.end(), v);
      return (corner + 1 == polygon.end() ? polygon.front() : *(corner + 1)) == w;
    });
    if (found == around.end() || contains(fan, *found)) return {};
    const auto& polygon = polygons_[at(*found)];
    const auto corner = std::find(polygon.begin(), polygon.end(), v);
    w = corner == polygon.begin() ? polygon.back() : *(corner - 1);
    fan.push_back(*found);
  }
  if (fan.size() == 1 && polygons_[at(fan.front())].size() == 3) {
    fan.push_back(across(from, to));
    if (fan.back() < 0 || contains(vertices_[at(v)].polygons, fan.back())) return {};
  }
  Patch side = with_ring(fan);
  const auto place = std::find(side.ring.begin(), side.ring.end(), v);
  if (place == side.ring.end()) return {};
  std::rotate(side.ring.begin(), place, side.ring.end());
  side.ring.erase(side.ring.begin());  // from ... to
  if (side.ring.size() < 3 || side.ring.front() != from || side.ring.back() != to) return {};
  std::rotate(side.ring.begin(), side.ring.end() - 1, side.ring.end());
  return side;
}

PatchMesh::CurveStar PatchMesh::curve_star(int vertex) const {
  const Vertex& v = vertices_[at(vertex)];
  if (!v.on_curve || v.origin == static_cast<int>(Origin::corner)) return {};
  const std::vector<int> ends = beside_on_curve(vertex);
  if (ends.size() != 2 || kind_.at(key(vertex, ends[0])) != kind_.at(key(vertex, ends[1]))) return {};
  CurveStar star;
  size_t found = 0;
  for (const int i : {0, 1}) {
    Patch side = beside_curve(vertex, ends[at(i)], ends[at(1 - i)]);
    if (side.ring.empty()) continue;
    found += at(static_cast<int>(std::count_if(side.polygons.begin(), side.polygons.end(),
                                               [&](int p) { return contains(v.polygons, p); })));
    star.sides.push_back(std::move(side));
  }
  if (found != v.polygons.size()) return {};
  Patch whole = star.sides.front();
  whole.bridge = {ends[0], ends[1]};
  if (star.sides.size() == 2) {
    const Patch& other = star.sides.back();
    whole.on_first_side = whole.polygons.size();
    whole.polygons.insert(whole.polygons.end(), other.polygons.begin(), other.polygons.end());
    std::rotate(whole.ring.begin(), whole.ring.begin() + 1, whole.ring.end());
    for (size_t i = 2; i < other.ring.size(); ++i) {
      if (contains(whole.ring, other.ring[i])) return {};
      whole.ring.push_back(other.ring[i]);
    }
  }
  if (inner_vertices(whole) != std::vector<int>{vertex}) return {};
  star.whole = std::move(whole);
  return star;
}

PatchMesh::CurveStar PatchMesh::curve_side(int v, int w) const {
  CurveStar star;
  std::vector<int> rings[2];  // from the one end to the other, the long way
  for (const auto& [from, to] : {std::pair(v, w), std::pair(w, v)}) {
    for (const int p : vertices_[at(from)].polygons) {
      std::vector<int> ring = polygons_[at(p)];
      const auto corner = std::find(ring.begin(), ring.end(), to);
      if (corner == ring.end()) continue;
      std::rotate(ring.begin(), corner, ring.end());
      if (ring.back() != from) continue;
      rings[star.sides.size()] = ring;
      ring.push_back(-1);
      star.sides.push_back({{p}, std::move(ring)});
      break;
    }
  }
  if (star.sides.empty()) return star;
  Patch& whole = star.whole;
  whole.ring = std::move(rings[0]);
  whole.polygons = star.sides.front().polygons;
  if (star.sides.size() == 1) return star;
  whole.on_first_side = 1;
  whole.polygons.push_back(star.sides.back().polygons.front());
  for (size_t i = 1; i + 1 < rings[1].size(); ++i) {
    if (contains(whole.ring, rings[1][i])) return {};
    whole.ring.push_back(rings[1][i]);
  }
  return star;
}

int PatchMesh::add_vertex_on_curve(const Vec3d& point, const SurfacePoint& source,
                                   const std::array<int, 2>& ends) {
  const int v = add_vertex(point, source), kind = kind_.at(key(ends[0], ends[1]));
  const bool border = kind == static_cast<int>(EdgeKind::border);
  vertices_[at(v)].origin = static_cast<int>(border ? Origin::border : Origin::feature);
  vertices_[at(v)].on_curve = true;
  kind_.erase(key(ends[0], ends[1]));
  curve_.erase(key(ends[0], ends[1]));
  for (const int end : ends) {
    kind_[key(v, end)] = kind;
    curve_[key(v, end)] = 1;
  }
  return v;
}

}  // namespace anisomesh::detail
