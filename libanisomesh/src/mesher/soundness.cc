#include "mesher/soundness.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_set>

#include "anisomesh/errors.hh"
#include "mesher/conforming.hh"
#include "numerics/bvh.hh"
#include "surface/rounding.hh"

namespace anisomesh::detail {

namespace {

using Polygon = std::vector<int>;
size_t at(int i) { return static_cast<size_t>(i); }

constexpr double least_area = 1e-5;   // twice the area over the squared diameter
constexpr double surely_right = 0.3;  // cosine to the surface's normal at all corners: no closer look needed
constexpr double folded_cosine = -0.985;  // neighbours lie on each other: 170 degrees
constexpr double thin_area = 1e-3;        // likewise: more samples would not help such a polygon
constexpr int max_repairs = 3;            // rounds
constexpr size_t most_corners = 12;       // of what is cut up anew; twice as many around a vertex that goes

std::vector<Vec3d> positions_of(const Polygon& polygon, const NetworkGraph& network) {
  std::vector<Vec3d> result;
  for (const int n : polygon) result.push_back(network.positions[at(n)]);
  return result;
}

Vec3d area_vector(const Polygon& polygon, const NetworkGraph& network) {
  Vec3d sum(0, 0, 0);
  const Vec3d& first = network.positions[at(polygon[0])];
  for (size_t i = 1; i + 1 < polygon.size(); ++i)
    sum += cross(network.positions[at(polygon[i])] - first, network.positions[at(polygon[i + 1])] - first);
  return sum;
}

double diameter_of(const Polygon& polygon, const NetworkGraph& network) {
  double squared = 0;
  for (const int n : polygon)
    for (const int m : polygon)
      squared = std::max(squared, (network.positions[at(n)] - network.positions[at(m)]).sqrnorm());
  return std::sqrt(squared);
}

bool is_thin(const Polygon& polygon, const NetworkGraph& network) {
  const double diameter = diameter_of(polygon, network);
  return !(area_vector(polygon, network).norm() > thin_area * diameter * diameter);
}

bool is_feature_edge(const NetworkGraph& network, int a, int b) {
  const int edge = network.graph.find_edge(a, b);
  return edge >= 0 && !is_line(network.graph.edge(edge).kind);
}

// Components, Euler characteristic and border loops, from the sides of all faces.
struct Topology {
  int euler = 0, loops = 0;
  bool manifold = true;
};

Topology topology_of(const std::vector<Polygon>& polygons, size_t n_nodes) {
  Topology result;
  std::vector<std::array<int, 2>> sides;
  std::vector<int> faces(n_nodes, 0), edges(n_nodes, 0), onward(n_nodes, -1);
  for (const Polygon& p : polygons)
    for (size_t i = 0; i < p.size(); ++i) {
      sides.push_back({p[i], p[(i + 1) % p.size()]});
      ++faces[at(p[i])];
    }
  std::sort(sides.begin(), sides.end());
  if (std::adjacent_find(sides.begin(), sides.end()) != sides.end()) result.manifold = false;
  size_t n_edges = 0;
  for (const auto& side : sides) {
    const bool inner = std::binary_search(sides.begin(), sides.end(), std::array<int, 2>{side[1], side[0]});
    if (inner && side[0] > side[1]) continue;
    ++n_edges;
    ++edges[at(side[0])];
    ++edges[at(side[1])];
    if (inner) continue;
    if (onward[at(side[1])] >= 0) result.manifold = false;  // the border passes the node twice
    onward[at(side[1])] = side[0];
  }
  int vertices = 0;
  for (size_t n = 0; n < n_nodes; ++n) {
    if (faces[n] == 0) continue;
    ++vertices;
    if (edges[n] != faces[n] + (onward[n] >= 0 ? 1 : 0)) result.manifold = false;
  }
  result.euler = vertices - static_cast<int>(n_edges) + static_cast<int>(polygons.size());
  for (size_t n = 0; n < n_nodes; ++n) {
    if (onward[n] < 0) continue;
    ++result.loops;
    for (size_t at_node = n; onward[at_node] >= 0;) {
      const auto next = at(onward[at_node]);
      onward[at_node] = -1;
      at_node = next;
    }
  }
  return result;
}

Topology topology_of(const OpenMesh::TriConnectivity& mesh) {
  Topology result;
  int vertices = 0;
  for (const auto v : mesh.vertices()) vertices += mesh.is_isolated(v) ? 0 : 1;
  result.euler = vertices - static_cast<int>(mesh.n_edges()) + static_cast<int>(mesh.n_faces());
  std::vector<char> seen(mesh.n_halfedges(), 0);
  for (const auto h : mesh.halfedges()) {
    if (!mesh.is_boundary(h) || seen[at(h.idx())]) continue;
    ++result.loops;
    for (OpenMesh::HalfedgeHandle next = h; !seen[at(next.idx())]; next = mesh.next_halfedge_handle(next))
      seen[at(next.idx())] = 1;
  }
  return result;
}

/// Who is beside whom, features being walls.
PolygonAdjacency adjacency_of(const std::vector<Polygon>& polygons, const NetworkGraph& network) {
  return {polygons, network.graph.n_nodes(), [&](int a, int b) { return !is_feature_edge(network, a, b); }};
}

}  // namespace

// Of what is found from each of the corners' faces the nearest: at the tip of a spike one may lead to another
// side, farther off.
Soundness::Place Soundness::place_at(const Vec2d& uv, const Vec3d& point,
                                     const std::vector<OpenMesh::FaceHandle>& starts) const {
  Place place{point, OpenMesh::FaceHandle(), std::numeric_limits<double>::infinity()};
  for (const auto start : starts) {
    const SurfacePoint found = locator_.locate(uv, point, start);
    const double distance = (position(surface_, found) - point).norm();
    if (is_surely_less(distance, place.distance)) place.distance = distance, place.below = found.face;
  }
  return place;
}

// Whether the surface around a place faces the other way than `normal`, everywhere within reach. Where it is
// more tightly curled than the polygons are large, a polygon that stands for both sides is no fold.
bool Soundness::is_against(const Place& place, const Vec3d& normal, const FoldReach& reach) const {
  const auto& mesh = surface_.connectivity();
  const double limit = place.distance + reach.far;
  std::vector<OpenMesh::FaceHandle> found{place.below};
  std::unordered_set<int> seen{place.below.idx()};
  double nearest = std::numeric_limits<double>::infinity(), nearest_right = nearest, cosine = 1;
  for (size_t i = 0; i < found.size(); ++i) {
    const auto c = surface_.corners(found[i]);
    const Vec3d &p = surface_.point(c.vertex[0]), &q = surface_.point(c.vertex[1]),
                &r = surface_.point(c.vertex[2]);
    const Vec3d b = closest_barycentric(place.point, p, q, r);
    const double distance = (b[0] * p + b[1] * q + b[2] * r - place.point).norm();
    if (distance > limit) continue;
    const Vec3d n = cross(q - p, r - p);
    const double length = n.norm() * normal.norm();
    if (distance < nearest) nearest = distance, cosine = length > 0 ? (n | normal) / length : 0;
    if ((n | normal) > at_right_angles * length) {
      if (distance <= reach.near) return false;
      nearest_right = std::min(nearest_right, distance);
    }
    for (const auto f : mesh.ff_range(found[i]))
      if (seen.insert(f.idx()).second) found.push_back(f);
  }
  return nearest_right > nearest + reach.beyond(cosine);
}

// Four in each of the ruler's triangles: a bent quad may be right on those of the one diagonal only.
std::vector<Soundness::Place> Soundness::places_in(const Polygon& polygon,
                                                   const NetworkGraph& network) const {
  static const double weights[4][3] = {{1.0 / 3, 1.0 / 3, 1.0 / 3},
                                       {2.0 / 3, 1.0 / 6, 1.0 / 6},
                                       {1.0 / 6, 2.0 / 3, 1.0 / 6},
                                       {1.0 / 6, 1.0 / 6, 2.0 / 3}};
  std::vector<Place> places;
  std::vector<OpenMesh::FaceHandle> starts;
  for (const int n : polygon)
    if (const auto face = network.points[at(n)].face;
        std::find(starts.begin(), starts.end(), face) == starts.end())
      starts.push_back(face);
  const Vec3d area = area_vector(polygon, network);
  const double length = area.norm();
  for (const Triangle& corner : triangulate_polygon(positions_of(polygon, network),
                                                    length > 0 ? area / length : area, FaceDiagonal::shorter))
    for (const auto& w : weights) {
      const auto mean = [&](const auto& of) {
        return w[0] * of(polygon[at(corner[0])]) + w[1] * of(polygon[at(corner[1])]) +
               w[2] * of(polygon[at(corner[2])]);
      };
      places.push_back(place_at(mean([&](int n) { return network.graph.uv(n); }),
                                mean([&](int n) { return network.positions[at(n)]; }), starts));
    }
  return places;
}

// How far around each of its places a polygon is held to what the surface does.
FoldReach Soundness::reach_of(const Polygon& polygon, const std::vector<Place>& places,
                              const NetworkGraph& network) {
  double distance = 0;
  for (const Place& place : places) distance = std::max(distance, place.distance);
  return {diameter_of(polygon, network), distance};
}

// Turned over against the surface at more than half of a few places in it.
bool Soundness::is_folded(const Polygon& polygon, const NetworkGraph& network, const Vec3d& normal) const {
  const std::vector<Place> places = places_in(polygon, network);
  const FoldReach reach = reach_of(polygon, places, network);
  size_t against = 0;
  for (const Place& place : places) against += is_against(place, normal, reach) ? 1 : 0;
  return 2 * against > places.size();
}

// A triangle of the input is as sound as the input is.
bool Soundness::is_of_input(const Polygon& polygon, const NetworkGraph& network) const {
  return polygon.size() == 3 && is_divided_of_input(polygon, network);
}

// Likewise with more vertices on its sides, as where another border lies on one of them.
bool Soundness::is_divided_of_input(const Polygon& polygon, const NetworkGraph& network) const {
  std::vector<OpenMesh::VertexHandle> vertex;
  std::vector<OpenMesh::FaceHandle> divided;
  for (const int n : polygon) {
    const SurfacePoint& point = network.points[at(n)];
    const auto corners = surface_.corners(point.face);
    const auto& b = point.barycentric;
    const size_t corner = b[0] == 1 ? 0 : b[1] == 1 ? 1 : b[2] == 1 ? 2 : 3;
    if (corner < 3)
      vertex.push_back(corners.vertex[corner]);
    else if (b[0] == 0 || b[1] == 0 || b[2] == 0)
      divided.push_back(point.face);
    else
      return false;
  }
  if (vertex.size() != 3) return false;
  const auto& mesh = surface_.connectivity();
  const auto side = mesh.find_halfedge(vertex[0], vertex[1]);
  return side.is_valid() && !mesh.is_boundary(side) &&
         mesh.to_vertex_handle(mesh.next_halfedge_handle(side)) == vertex[2] &&
         std::all_of(divided.begin(), divided.end(), [&](auto f) { return f == mesh.face_handle(side); });
}

bool Soundness::is_sound(const Polygon& polygon, const NetworkGraph& network) const {
  const Vec3d area = area_vector(polygon, network);
  const double diameter = diameter_of(polygon, network), length = area.norm();
  if (!(length > least_area * diameter * diameter)) return false;
  const Vec3d normal = area / length;
  if (convex_ && polygon.size() > 3 && !PolygonJudge::is_convex(positions_of(polygon, network))) return false;
  const bool right = std::all_of(polygon.begin(), polygon.end(),
                                 [&](int n) { return (network.normals[at(n)] | normal) > surely_right; });
  return right || !is_folded(polygon, network, normal);
}

std::vector<int> Soundness::unsound(const std::vector<Polygon>& polygons, const NetworkGraph& network,
                                    bool or_touching) const {
  std::vector<char> bad(polygons.size(), 0);
  for (size_t p = 0; p < polygons.size(); ++p)
    bad[p] = !is_sound(polygons[p], network) ||
             (or_touching &&
              ((polygons[p].size() > 3 && PolygonJudge::touches_itself(positions_of(polygons[p], network))) ||
               coincident_.has_one(polygons[p], network)));
  // A polygon may lie folded onto one beyond a feature, too.
  const PolygonAdjacency adjacency(polygons, network.graph.n_nodes(), [](int, int) { return true; });
  for (size_t p = 0; p < polygons.size(); ++p)
    for (size_t i = 0; i < polygons[p].size(); ++i) {
      const int q = adjacency.neighbor(static_cast<int>(p), i);
      if (q <= static_cast<int>(p)) continue;
      const Vec3d n = area_vector(polygons[p], network), m = area_vector(polygons[at(q)], network);
      if ((n | m) > folded_cosine * n.norm() * m.norm()) continue;
      const int a = polygons[p][i], b = polygons[p][(i + 1) % polygons[p].size()];
      const Place middle = place_at(0.5 * (network.graph.uv(a) + network.graph.uv(b)),
                                    0.5 * (network.positions[at(a)] + network.positions[at(b)]),
                                    {network.points[at(a)].face, network.points[at(b)].face});
      const auto against = [&](const Polygon& polygon, const Vec3d& normal) {
        return is_against(middle, normal, reach_of(polygon, places_in(polygon, network), network));
      };
      bad[p] |= against(polygons[p], n);
      bad[at(q)] |= against(polygons[at(q)], m);
    }
  std::vector<int> result;
  for (size_t p = 0; p < polygons.size(); ++p)
    if (bad[p] &&
        !(or_touching ? is_of_input(polygons[p], network) : is_divided_of_input(polygons[p], network)))
      result.push_back(static_cast<int>(p));
  return result;
}

// Of several sets of polygons the one that can be cut up anew with the least cost, so that all is sound.
const std::vector<int>* Soundness::cheapest(const std::vector<std::vector<int>>& paths,
                                            const PolygonAdjacency& adjacency,
                                            const std::vector<Polygon>& polygons, const NetworkGraph& network,
                                            int max_degree, bool may_drop,
                                            std::vector<Polygon>& best_pieces) const {
  double best = std::numeric_limits<double>::infinity();
  const std::vector<int>* best_path = nullptr;
  for (const auto& path : paths) {
    if (path.empty()) continue;
    RegionCorners corners = adjacency.around(polygons, path, network, may_drop);
    if (corners.loop == 0 || corners.loop > (may_drop ? 2 : 1) * most_corners) continue;
    const auto before = in_corners(corners, polygons, path);
    size_t kept = 0, all = 0;
    for (size_t i = 0; i < path.size(); ++i) {
      kept += before[i].size();
      all += polygons[at(path[i])].size();
    }
    const bool less = kept < all;
    std::vector<Polygon> pieces = best_partition(corners, judge_, max_degree != 3);
    double cost = pieces.empty() ? std::numeric_limits<double>::infinity() : judge_.cost(corners, pieces);
    for (Polygon& piece : pieces) {
      if (corners.has_forbidden(piece)) cost = std::numeric_limits<double>::infinity();
      for (int& i : piece) i = corners.node[at(i)];
      if (!is_sound(piece, network) || coincident_.has_one(piece, network))
        cost = std::numeric_limits<double>::infinity();
    }
    cost -= less ? static_cast<double>(path.size()) : judge_.cost(corners, before);
    if (!(cost < best)) continue;
    best = cost;
    best_path = &path;
    best_pieces = std::move(pieces);
  }
  return best_path;
}

// The cheapest new partition of the polygon with one or two of its neighbours that is sound; where there is
// none, of all that is around one of its corners, without that.
bool Soundness::repair_one(int polygon, std::vector<Polygon>& polygons, PolygonAdjacency& adjacency,
                           const NetworkGraph& network, int max_degree, bool may_drop) const {
  const auto neighbors = [&](int p) {
    std::vector<int> result;
    for (size_t i = 0; i < polygons[at(p)].size(); ++i)
      if (adjacency.neighbor(p, i) >= 0) result.push_back(adjacency.neighbor(p, i));
    return result;
  };
  std::vector<std::vector<int>> paths{{polygon}};
  for (const int n : neighbors(polygon)) {
    paths.push_back({polygon, n});
    for (const int m : neighbors(polygon))
      if (n < m) paths.push_back({n, polygon, m});
    for (const int m : neighbors(n))
      if (m != polygon) paths.push_back({polygon, n, m});
  }
  std::vector<Polygon> best_pieces;
  const std::vector<int>* best_path =
      cheapest(paths, adjacency, polygons, network, max_degree, false, best_pieces);
  if (!best_path && (may_drop || is_thin(polygons[at(polygon)], network))) {  // a vertex less
    for (const int n : polygons[at(polygon)]) paths.push_back(adjacency.fan(polygons, polygon, n));
    best_path = cheapest(paths, adjacency, polygons, network, max_degree, true, best_pieces);
  }
  if (!best_path) return false;
  std::vector<int> places = *best_path;
  for (const int p : places) adjacency.take_out(polygons, p);
  for (; places.size() < best_pieces.size(); polygons.emplace_back())
    places.push_back(static_cast<int>(polygons.size()));
  for (size_t i = 0; i < places.size(); ++i) {
    polygons[at(places[i])] = i < best_pieces.size() ? best_pieces[i] : Polygon{};
    adjacency.put_in(polygons, places[i]);
  }
  return true;
}

std::vector<Polygon> Soundness::repair(std::vector<Polygon>& polygons, const NetworkGraph& network,
                                       int max_degree, bool may_drop) {
  coincident_ = {polygons, network};
  std::vector<int> bad = unsound(polygons, network, true);
  for (int round = 0; round < max_repairs && !bad.empty(); ++round) {
    size_t repaired = 0;
    PolygonAdjacency adjacency = adjacency_of(polygons, network);
    std::vector<Polygon> waiting;  // the repair of another may change one, which is then left alone
    waiting.reserve(bad.size());
    for (const int p : bad) waiting.push_back(polygons[at(p)]);
    for (size_t i = 0; i < bad.size(); ++i)
      if (polygons[at(bad[i])] == waiting[i])
        repaired += repair_one(bad[i], polygons, adjacency, network, max_degree, may_drop);
    const auto left =
        std::remove_if(polygons.begin(), polygons.end(), [](const auto& p) { return p.empty(); });
    polygons.erase(left, polygons.end());
    coincident_ = {polygons, network};
    bad = unsound(polygons, network, true);
    if (repaired == 0) break;
  }
  bad = unsound(polygons, network, false);
  std::vector<Polygon> left;
  left.reserve(bad.size());
  for (const int p : bad) left.push_back(polygons[at(p)]);
  return left;
}

std::vector<Polygon> Soundness::coincident(const std::vector<Polygon>& polygons,
                                           const NetworkGraph& network) const {
  std::vector<Polygon> result;
  for (const Polygon& p : polygons)
    if (coincident_.has_one(p, network)) result.push_back(p);
  return result;
}

std::vector<Polygon> Soundness::folded(const std::vector<Polygon>& polygons, const NetworkGraph& network,
                                       const ReferenceSurface& reference) const {
  std::vector<Polygon> result;
  const auto marks = folded_faces(reference, {network.positions, polygons, FaceDiagonal::shorter});
  for (size_t p = 0; p < polygons.size(); ++p)
    if (marks[p] && !is_of_input(polygons[p], network)) result.push_back(polygons[p]);
  return result;
}

void Soundness::require_topology(const std::vector<Polygon>& polygons) const {
  int nodes = 0;
  for (const Polygon& p : polygons)
    for (const int n : p) nodes = std::max(nodes, n + 1);
  const Topology result = topology_of(polygons, at(nodes)), input = topology_of(surface_.connectivity());
  if (!result.manifold) throw CannotProcess("the polygons are not manifold; try a smaller epsilon");
  if (result.euler != input.euler || result.loops != input.loops)
    throw CannotProcess("the polygons have " + std::to_string(result.loops) +
                        " border loops and Euler characteristic " + std::to_string(result.euler) +
                        ", the input " + std::to_string(input.loops) + " and " + std::to_string(input.euler) +
                        "; try a smaller epsilon");
}

}  // namespace anisomesh::detail
