#include "mesher/polygon_judge.hh"

#include <algorithm>
#include <cmath>

#include "network/feature_sides.hh"
#include "surface/rounding.hh"

namespace anisomesh::detail {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double degree = pi / 180;

// Weights of the costs, found on the real meshes (docs/mesher.md).
constexpr double triangle_base = 1.4;  // two triangles are worth avoiding unless the quad is badly shaped
constexpr double shape_weight = 2;
constexpr double error_weight = 0.6;
constexpr double bent = 3;  // a quad bent too far: worse than two good triangles
constexpr double least_cosine = 0.3;
constexpr double averse = 30;        // for each corner where the cosine to the surface is below that
constexpr double touching = 5e2;     // itself: only where something would be folded otherwise
constexpr double folded = 1e3;       // only where nothing else is left
constexpr double least_area = 1e-5;  // twice the area over the square of the longest side
constexpr double on_side = 1.2e-5;   // of its length: a corner that near is on it
constexpr double forbidden = 1e6;    // concave or without area: two folded triangles are better than that

size_t at(int i) { return static_cast<size_t>(i); }

// Area vector: the normal of the plane of best fit times twice the area (Newell).
template <class Corners>
Vec3d area_vector(const Corners& p) {
  Vec3d sum(0, 0, 0);
  for (size_t i = 1; i + 1 < p.size(); ++i) sum += cross(p[i] - p[0], p[i + 1] - p[0]);
  return sum;
}

template <class Corners>
bool has_corner_on_side(const Corners& p) {
  const size_t n = p.size();
  for (size_t side = 0; side < n; ++side) {
    const Vec3d &a = p[side], along = p[(side + 1) % n] - a;
    const double squared = along.sqrnorm();
    for (size_t k = 2; k < n; ++k) {
      const Vec3d from_a = p[(side + k) % n] - a;
      const double t = squared > 0 ? (from_a | along) / squared : 0;
      if (t > 0 && t < 1 && (from_a - t * along).sqrnorm() <= on_side * on_side * squared) return true;
    }
  }
  return false;
}

// Cost of one corner by its inner angle: none up to a right angle, 1 where it is straight.
double angle_cost(double angle) {
  const double beyond = std::max(0.0, std::abs(angle - pi / 2) / (pi / 2));
  return beyond * beyond;
}

}  // namespace

void RegionCorners::add(const NetworkGraph& network, int n) {
  node.push_back(n);
  uv.push_back(network.graph.uv(n));
  position.push_back(network.positions[at(n)]);
  face.push_back(network.points[at(n)].face);
  corner_normal.push_back(network.touches(n, EdgeKind::feature) ? Vec3d(0, 0, 0) : network.normals[at(n)]);
}

void RegionCorners::set_face(const NetworkGraph& network, int before, int corner, int after) {
  if (network.feature_sides)
    face[at(corner)] = network.feature_sides->face_between(network, before, node[at(corner)], after);
}

PolygonJudge::PolygonJudge(const SurfaceRef& surface, const SurfaceLocator& locator,
                           const SurfaceNormals& normals, const JudgeOptions& options)
    : surface_(surface), locator_(locator), normals_(normals), directions_(surface), options_(options) {}

Vec3d PolygonJudge::surface_normal(const Vec2d& uv, const Vec3d& place, OpenMesh::FaceHandle start) const {
  return normals_.at(locator_.locate(uv, place, start));
}

bool PolygonJudge::middle_of(const RegionCorners& region, int a, int b, Vec3d& place,
                             SurfacePoint& below) const {
  bool inside = false;
  place = 0.5 * (region.position[at(a)] + region.position[at(b)]);
  below = locator_.locate(0.5 * (region.uv[at(a)] + region.uv[at(b)]), place, region.face[at(a)], &inside);
  return inside;
}

double PolygonJudge::error_at(const RegionCorners& region, const Vec3d& place,
                              const SurfacePoint& below) const {
  const Vec3d off = position(surface_, below) - place;
  // A chord across a hole may lie in the plane of what is around the hole.
  if (region.on_surface) return off.norm();
  const auto c = surface_.corners(below.face);
  const Vec3d normal = cross(surface_.point(c.vertex[1]) - surface_.point(c.vertex[0]),
                             surface_.point(c.vertex[2]) - surface_.point(c.vertex[0]));
  const double length = normal.norm();
  return length > 0 ? std::abs(off | normal) / length : 0;
}

double PolygonJudge::chord_error(const RegionCorners& region, int a, int b) const {
  Vec3d place;
  SurfacePoint below;
  return middle_of(region, a, b, place, below) ? error_at(region, place, below) : 0;
}

double PolygonJudge::error_cost(double error) const {
  if (!(options_.epsilon > 0) || !std::isfinite(options_.epsilon)) return 0;
  return error_weight * std::min(error / options_.epsilon, options_.max_error_ratio);
}

double PolygonJudge::chord_cost(const RegionCorners& region, int a, int b) const {
  Vec3d place;
  SurfacePoint below;
  double cost = region.is_forbidden(a, b) ? forbidden : 0;
  if (middle_of(region, a, b, place, below))
    cost += 0.5 * error_cost(error_at(region, place, below)) +
            0.5 * options_.alignment_weight *
                directions_.misalignment(below, region.position[at(b)] - region.position[at(a)]);
  return cost;
}

// Which way the surface faces at some corners; where all lie on features, in the region.
Vec3d PolygonJudge::reference_normal(const RegionCorners& region, std::initializer_list<int> corners) {
  Vec3d sum(0, 0, 0);
  for (const int i : corners) sum += region.corner_normal[at(i)];
  return sum.sqrnorm() > 0 ? sum : region.normal;
}

// At how many corners the surface stands steeply on the polygon or faces the other way, as where one spans a
// hole or lies along a rim, however near to the surface it is.
int PolygonJudge::against(const RegionCorners& region, std::initializer_list<int> corners,
                          const Vec3d& area) {
  if (!region.on_surface) return 0;
  int count = 0;
  for (const int i : corners) count += (region.corner_normal[at(i)] | area) < least_cosine * area.norm();
  return count;
}

bool PolygonJudge::is_folded(const RegionCorners& region, int a, int b, int c) {
  const std::array<Vec3d, 3> p{region.position[at(a)], region.position[at(b)], region.position[at(c)]};
  return (area_vector(p) | reference_normal(region, {a, b, c})) <= 0;
}

double PolygonJudge::triangle_cost(const RegionCorners& region, int a, int b, int c,
                                   ChordCosts* known) const {
  const std::array<Vec3d, 3> p{region.position[at(a)], region.position[at(b)], region.position[at(c)]};
  const Vec3d area = area_vector(p);
  double longest = 0, widest = 0;
  for (size_t k = 0; k < 3; ++k) {
    const Vec3d in = p[k] - p[(k + 2) % 3], out = p[(k + 1) % 3] - p[k];
    longest = std::max(longest, out | out);
    widest = std::max(widest, pi - std::atan2(cross(in, out).norm(), in | out));
  }
  double cost = triangle_base + shape_weight * angle_cost(std::max(widest, pi / 2));
  if (!(area.norm() > least_area * longest)) cost += folded;
  if ((area | reference_normal(region, {a, b, c})) <= 0) cost += folded;
  cost += averse * against(region, {a, b, c}, area);
  // Every inner chord is a side of two pieces.
  for (const auto& side : {std::array<int, 2>{a, b}, {b, c}, {c, a}}) {
    if (region.is_side(side[0], side[1])) continue;
    if (!known) {
      cost += chord_cost(region, side[0], side[1]);
      continue;
    }
    const auto [found, is_new] = known->try_emplace(side, 0.0);
    if (is_new) found->second = chord_cost(region, side[0], side[1]);
    cost += found->second;
  }
  return cost;
}

double PolygonJudge::quad_cost(const RegionCorners& region, const std::array<int, 4>& quad) const {
  std::array<Vec3d, 4> p;
  for (size_t k = 0; k < 4; ++k) p[k] = region.position[at(quad[k])];
  const Vec3d area = area_vector(p);
  const double length = area.norm();
  double longest = 0;
  for (size_t k = 0; k < 4; ++k) longest = std::max(longest, (p[(k + 1) % 4] - p[k]).sqrnorm());
  if (!(length > least_area * longest)) return 2 * forbidden;
  const Vec3d normal = area / length;
  double shape = 0, cost = 1;
  for (size_t k = 0; k < 4; ++k) {
    const Vec3d in = p[k] - p[(k + 3) % 4], out = p[(k + 1) % 4] - p[k];
    const double turn = std::atan2(cross(in, out) | normal, (in | out) - (in | normal) * (out | normal));
    if (turn < -4 * degree) cost += forbidden;
    shape = std::max(shape, angle_cost(pi - turn));
  }
  if ((normal | reference_normal(region, {quad[0], quad[1], quad[2], quad[3]})) <= 0) cost += 2 * folded;
  if (has_corner_on_side(p)) cost += touching;
  cost += averse * against(region, {quad[0], quad[1], quad[2], quad[3]}, area);
  cost += shape_weight * shape;
  // Whoever draws it will use the shorter diagonal.
  const bool second = is_surely_less((p[1] - p[3]).sqrnorm(), (p[0] - p[2]).sqrnorm());
  const size_t first_corner = second ? 1 : 0;
  const Vec3d &a = p[first_corner], &c = p[first_corner + 2];
  const Vec3d &b = p[(first_corner + 1) % 4], &d = p[(first_corner + 3) % 4];
  const Vec3d n1 = cross(b - a, c - a), n2 = cross(c - a, d - a);
  // Where three corners lie on a line, rounding decides which way their triangle faces.
  const bool faces = std::min(n1.sqrnorm(), n2.sqrnorm()) > kRounding * kRounding * longest * longest;
  const double bend = std::atan2(cross(n1, n2).norm(), n1 | n2);
  if (faces && bend > options_.max_bend_degrees * degree) cost += bent;
  cost += error_cost(chord_error(region, quad[first_corner], quad[first_corner + 2]));
  for (size_t k = 0; k < 4; ++k)
    if (!region.is_side(quad[k], quad[(k + 1) % 4])) cost += chord_cost(region, quad[k], quad[(k + 1) % 4]);
  return cost;
}

double PolygonJudge::cost(const RegionCorners& region, const std::vector<std::vector<int>>& polygons) const {
  double sum = 0;
  for (const auto& p : polygons)
    sum += p.size() == 3   ? triangle_cost(region, p[0], p[1], p[2])
           : p.size() == 4 ? quad_cost(region, {p[0], p[1], p[2], p[3]})
                           : 1;
  return sum;
}

bool PolygonJudge::touches_itself(const std::vector<Vec3d>& p) { return has_corner_on_side(p); }

bool PolygonJudge::is_convex(const std::vector<Vec3d>& p) {
  const size_t n = p.size();
  const Vec3d area = area_vector(p);
  const double length = area.norm();
  if (!(length > 0)) return false;
  const Vec3d normal = area / length;
  const auto turn = [&](size_t k) {  // sine and cosine of the turn in the plane, times the lengths there
    const Vec3d in = p[k] - p[(k + n - 1) % n], out = p[(k + 1) % n] - p[k];
    return Vec2d(cross(in, out) | normal, (in | out) - (in | normal) * (out | normal));
  };
  size_t left = 0;
  while (left < n && turn(left)[0] > 0) ++left;
  if (left == n && n <= 4) return true;  // so few turns to the left do not go around twice
  double turns = 0;
  for (size_t k = 0; k < n; ++k) {
    const Vec2d t = turn(k);
    const double angle = std::atan2(t[0], t[1]);
    if (angle < -4 * degree) return false;
    turns += angle;
  }
  return turns < 3 * pi;
}

}  // namespace anisomesh::detail
