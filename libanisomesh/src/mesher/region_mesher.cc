#include "mesher/region_mesher.hh"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "numerics/bvh.hh"
#include "numerics/segment.hh"
#include "numerics/shorter_diagonal.hh"
#include "numerics/small_triangulation.hh"
#include "surface/rounding.hh"

namespace anisomesh::detail {

namespace {

using Piece = std::vector<int>;
size_t at(int i) { return static_cast<size_t>(i); }

constexpr size_t max_added = 100;      // per region, or as many as it has samples; a bound, not a rule
constexpr double edge_distance = 0.3;  // of the region's size: nearer to its border a new vertex weighs less
constexpr int flip_passes = 8;
constexpr double least_share = 0.1;  // of the tolerance: more samples than it asks for are no help

double turn(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

class RegionMesher {
 public:
  RegionMesher(Region& region, const PolygonJudge& judge, const RegionOptions& options)
      : region_(region),
        corners_(region.corners),
        judge_(judge),
        options_(options),
        tolerance_(region.at_feature ? std::max(region.share, least_share) *
                                           std::min(options.cell_tolerance, options.feature_cell_tolerance)
                                     : options.cell_tolerance) {}

  RegionPolygons run();

 private:
  std::vector<Piece> pieces_of(const SmallTriangulation& triangulation) const;
  double distance(const Probe& probe, int a, int b, int c) const;
  double distance(const Probe& probe, const std::vector<std::array<int, 3>>& triangles) const;
  double squared_distance(const Probe& probe, const std::array<int, 3>& triangle) const;
  void bring_up_to_date(const std::vector<std::array<int, 3>>& triangles);
  std::vector<std::array<int, 3>> as_drawn(const std::vector<Piece>& pieces) const;
  Probe* worst_probe(const SmallTriangulation& triangulation);
  bool add_worst(SmallTriangulation& triangulation, RegionPolygons& result);
  void drop_last_corner();
  size_t folds(const SmallTriangulation& triangulation) const;
  double border_distance(const Vec3d& p) const;
  double cost(int a, int b, int c);
  void flip_to_lower_cost(SmallTriangulation& triangulation);

  Region& region_;
  RegionCorners& corners_;
  const PolygonJudge& judge_;
  const RegionOptions& options_;
  const double tolerance_;

  // What is known of each probe while samples are added: each changes few triangles only.
  struct Known {
    double squared = std::numeric_limits<double>::infinity();  // distance from the triangles, and which
    size_t triangle = 0;
    double border = -1;  // distance; below 0: not asked for yet
  };
  std::vector<Known> known_;
  std::vector<std::array<int, 3>> known_for_;
  std::map<std::array<int, 3>, double> costs_;  // of triangles
  ChordCosts chords_;
};

// Distance of the surface from the plane of a triangle; the nearest point is not sought, since it lies
// sideways only where the surface is steep against the triangle.
double RegionMesher::distance(const Probe& probe, int a, int b, int c) const {
  const Vec3d &p = corners_.position[at(a)], &q = corners_.position[at(b)], &r = corners_.position[at(c)];
  const Vec3d normal = cross(q - p, r - p);
  const double length = normal.norm();
  return length > 0 ? std::abs((probe.position - p) | normal) / length : 0;
}

double RegionMesher::distance(const Probe& probe, const std::vector<std::array<int, 3>>& triangles) const {
  if (corners_.on_surface) {  // by what is nearest in space: (u, v) is too coarse a guess
    double least = std::numeric_limits<double>::infinity();
    for (const auto& t : triangles) least = std::min(least, squared_distance(probe, t));
    return std::sqrt(least);
  }
  double best = -std::numeric_limits<double>::infinity(), result = 0;
  for (const auto& t : triangles) {
    const Vec2d &a = corners_.uv[at(t[0])], &b = corners_.uv[at(t[1])], &c = corners_.uv[at(t[2])];
    const double inside = std::min({turn(a, b, probe.uv), turn(b, c, probe.uv), turn(c, a, probe.uv)}) /
                          std::abs(turn(a, b, c));
    if (inside <= best) continue;
    best = inside;
    result = distance(probe, t[0], t[1], t[2]);
    if (best >= 0) break;
  }
  return result;
}

double RegionMesher::squared_distance(const Probe& probe, const std::array<int, 3>& triangle) const {
  const Vec3d &p = corners_.position[at(triangle[0])], &q = corners_.position[at(triangle[1])],
              &r = corners_.position[at(triangle[2])];
  const Vec3d b = closest_barycentric(probe.position, p, q, r);
  return (b[0] * p + b[1] * q + b[2] * r - probe.position).sqrnorm();
}

// Only triangles that are not what they were are measured again; all where a probe's nearest is one of them.
void RegionMesher::bring_up_to_date(const std::vector<std::array<int, 3>>& triangles) {
  std::vector<size_t> changed;
  std::vector<char> is_changed(std::max(triangles.size(), known_for_.size()), 1);
  for (size_t t = 0; t < triangles.size(); ++t) {
    is_changed[t] = t >= known_for_.size() || triangles[t] != known_for_[t];
    if (is_changed[t]) changed.push_back(t);
  }
  for (size_t i = 0; i < known_.size(); ++i) {
    Known& known = known_[i];
    const auto look = [&](size_t t) {
      const double squared = squared_distance(region_.probes[i], triangles[t]);
      if (squared < known.squared) known.squared = squared, known.triangle = t;
    };
    if (known_for_.empty() || is_changed[known.triangle]) {
      known.squared = std::numeric_limits<double>::infinity();
      for (size_t t = 0; t < triangles.size(); ++t) look(t);
    } else {
      for (const size_t t : changed) look(t);
    }
  }
  known_for_ = triangles;
}

// Triangles of the polygons with the shorter diagonal, as a viewer draws them.
std::vector<std::array<int, 3>> RegionMesher::as_drawn(const std::vector<Piece>& pieces) const {
  std::vector<std::array<int, 3>> triangles;
  for (const Piece& p : pieces) {
    const size_t first = p.size() == 4 ? shorter_diagonal(p, corners_.position) : 0;
    for (size_t i = 1; i + 1 < p.size(); ++i)
      triangles.push_back({p[first], p[(first + i) % p.size()], p[(first + i + 1) % p.size()]});
  }
  return triangles;
}

double RegionMesher::border_distance(const Vec3d& p) const {
  double nearest = std::numeric_limits<double>::infinity();
  const size_t n = corners_.loop;
  for (size_t i = 0; i < n; ++i)
    nearest = std::min(nearest, off_segment(p, corners_.position[i], corners_.position[(i + 1) % n]).norm());
  return nearest;
}

// The probe that the triangles are farthest from, rather one in the middle than one at the border.
Probe* RegionMesher::worst_probe(const SmallTriangulation& triangulation) {
  double worst = 0, area = 0;
  for (const auto& t : triangulation.triangles())
    area += 0.5 * cross(corners_.position[at(t[1])] - corners_.position[at(t[0])],
                        corners_.position[at(t[2])] - corners_.position[at(t[0])])
                      .norm();
  const double size = edge_distance * std::sqrt(area);
  Probe* chosen = nullptr;
  known_.resize(region_.probes.size());
  if (corners_.on_surface) bring_up_to_date(triangulation.triangles());
  for (size_t i = 0; i < region_.probes.size(); ++i) {
    Probe& probe = region_.probes[i];
    double d = 0;
    if (corners_.on_surface) {
      d = std::sqrt(known_[i].squared);
    } else {
      const auto& t = triangulation.triangles()[at(triangulation.locate(probe.uv))];
      d = distance(probe, t[0], t[1], t[2]);
    }
    if (d <= tolerance_) continue;
    double& border = known_[i].border;
    if (border < 0) border = border_distance(probe.position);
    const double weighted = d * std::min(1.0, border / size);
    if (!is_surely_less(worst, weighted)) continue;
    worst = weighted;
    chosen = &probe;
  }
  return chosen;
}

void RegionMesher::drop_last_corner() {
  corners_.node.pop_back();
  corners_.uv.pop_back();
  corners_.position.pop_back();
  corners_.face.pop_back();
  corners_.corner_normal.pop_back();
}

// Triangles that the judge would rather have any other way.
size_t RegionMesher::folds(const SmallTriangulation& triangulation) const {
  const auto& all = triangulation.triangles();
  return static_cast<size_t>(std::count_if(all.begin(), all.end(), [this](const std::array<int, 3>& t) {
    return judge_.is_folded(corners_, t[0], t[1], t[2]);
  }));
}

// Inserts the worst probe. Where vertices of the input have gone, a probe may be pinned to a triangle in
// whose plane it lies outside: beside the corner of a hole, say, where it is near enough to another one. As a
// vertex it turns a triangle over. Most such folds are repaired, and the sample is worth it; where one was
// not, the sample is not taken the next time.
bool RegionMesher::add_worst(SmallTriangulation& triangulation, RegionPolygons& result) {
  Probe* chosen = worst_probe(triangulation);
  if (!chosen) return false;
  corners_.node.push_back(-1);
  corners_.uv.push_back(chosen->uv);
  corners_.position.push_back(chosen->position);
  corners_.face.push_back(chosen->point.face);
  corners_.corner_normal.emplace_back(0, 0, 0);
  const SurfacePoint point = chosen->point;
  const auto index = chosen - region_.probes.data();
  region_.probes.erase(region_.probes.begin() + index);
  known_.erase(known_.begin() + index);
  std::optional<SmallTriangulation> before;
  if (corners_.on_surface && region_.share < 1) before = triangulation;
  if (!triangulation.insert(static_cast<int>(corners_.uv.size()) - 1)) {
    drop_last_corner();
    return true;
  }
  if (options_.flip_edges) flip_to_lower_cost(triangulation);
  if (before && folds(triangulation) > folds(*before)) {
    triangulation = std::move(*before);
    drop_last_corner();
    costs_.clear();  // the next corner has its number
    chords_.clear();
  } else {
    result.added.push_back(point);
  }
  return true;
}

double RegionMesher::cost(int a, int b, int c) {
  const auto [found, is_new] = costs_.try_emplace({a, b, c}, 0.0);
  if (is_new) found->second = judge_.triangle_cost(corners_, a, b, c, &chords_);
  return found->second;
}

// [ACDLD03, section 4.2]: "further edge-swaps can be performed later to reduce ... approximation error".
void RegionMesher::flip_to_lower_cost(SmallTriangulation& triangulation) {
  bool changed = true;
  for (int pass = 0; changed && pass < flip_passes; ++pass) {
    changed = false;
    for (int t = 0; t < static_cast<int>(triangulation.triangles().size()); ++t)
      for (size_t k = 0; k < 3; ++k) {
        if (triangulation.neighbor(t, k) < t || !triangulation.can_flip(t, k)) continue;
        const auto& c = triangulation.triangles()[at(t)];
        const int apex = c[k], a = c[(k + 1) % 3], b = c[(k + 2) % 3], foot = triangulation.across(t, k);
        const double now = cost(apex, a, b) + cost(foot, b, a);
        const double then = cost(apex, a, foot) + cost(foot, b, apex);
        if (then >= now - 1e-6) continue;
        triangulation.flip(t, k);
        changed = true;
      }
  }
}

std::vector<Piece> RegionMesher::pieces_of(const SmallTriangulation& triangulation) const {
  std::vector<Piece> pieces;
  for (const auto& t : triangulation.triangles()) pieces.push_back({t[0], t[1], t[2]});
  return options_.partition.max_degree == 0 || options_.partition.max_degree > 4
             ? join_triangles(corners_, std::move(pieces), judge_, options_.partition)
             : pieces;
}

RegionPolygons RegionMesher::run() {
  RegionPolygons result;
  const bool bounded = std::isfinite(tolerance_);
  if (region_.simple) {
    result.convex = PolygonJudge::is_convex(
        {corners_.position.begin(), corners_.position.begin() + static_cast<std::ptrdiff_t>(corners_.loop)});
    if ((bounded && region_.share > kept_share) || region_.isotropic == 0) {
      result.polygons = partition_region(corners_, judge_, options_.partition);
      const auto drawn = as_drawn(result.polygons);
      const bool near = std::all_of(region_.probes.begin(), region_.probes.end(),
                                    [&](const Probe& probe) { return distance(probe, drawn) <= tolerance_; });
      const bool taken = std::any_of(result.polygons.begin(), result.polygons.end(),
                                     [&](const Piece& p) { return corners_.has_forbidden(p); });
      if (near && !taken) return result;
    }
  }
  SmallTriangulation triangulation(corners_.uv, region_.triangles, region_.walls);
  const int n = static_cast<int>(corners_.size());
  if (!region_.holds_samples)
    for (int i = n - static_cast<int>(region_.isotropic); i < n; ++i) triangulation.insert(i);
  if (options_.flip_edges) flip_to_lower_cost(triangulation);
  const size_t most = std::max(max_added, region_.isotropic);
  while (bounded && result.added.size() < most && add_worst(triangulation, result)) {
  }
  result.polygons = pieces_of(triangulation);
  return result;
}

}  // namespace

RegionPolygons mesh_region(Region& region, const PolygonJudge& judge, const RegionOptions& options) {
  return RegionMesher(region, judge, options).run();
}

}  // namespace anisomesh::detail
