#include "mesher/region_layout.hh"

#include <algorithm>
#include <cmath>

#include "mesher/conforming.hh"

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

constexpr double pi = 3.14159265358979323846;
constexpr int tutte_rounds = 200;
constexpr double least_cosine = 0.7;  // of the surface at a corner to the region's normal
constexpr double least_turn = 1e-3;   // of a projected triangle: twice its area over the squared longest side

double turn(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// Coordinates across the normal of a region.
class Projection {
 public:
  explicit Projection(const RegionCorners& corners) : origin_(corners.position.front()) {
    const double length = corners.normal.norm();
    const Vec3d n = length > 0 ? corners.normal / length : Vec3d(0, 0, 1);
    const int least = std::abs(n[0]) <= std::abs(n[1]) ? (std::abs(n[0]) <= std::abs(n[2]) ? 0 : 2)
                                                       : (std::abs(n[1]) <= std::abs(n[2]) ? 1 : 2);
    Vec3d axis(0, 0, 0);
    axis[least] = 1;
    x_ = cross(axis, n).normalized();
    y_ = cross(n, x_);
  }
  Vec2d operator()(const Vec3d& place) const { return {(place - origin_) | x_, (place - origin_) | y_}; }

 private:
  Vec3d origin_, x_, y_;
};

bool is_unfolded(const RegionCorners& corners, const std::vector<std::array<int, 3>>& triangles) {
  return std::all_of(triangles.begin(), triangles.end(), [&](const std::array<int, 3>& t) {
    const Vec2d &a = corners.uv[at(t[0])], &b = corners.uv[at(t[1])], &c = corners.uv[at(t[2])];
    const double longest = std::max({(b - a).sqrnorm(), (c - b).sqrnorm(), (a - c).sqrnorm()});
    return turn(a, b, c) > least_turn * longest;
  });
}

// Two sides on one straight line do not meet where they are apart on it; the turns there are rounding.
bool are_apart(const Vec2d& a, const Vec2d& b, const Vec2d& c, const Vec2d& d) {
  for (int k = 0; k < 2; ++k)
    if (std::max(a[k], b[k]) < std::min(c[k], d[k]) || std::max(c[k], d[k]) < std::min(a[k], b[k]))
      return true;
  return turn(a, b, c) * turn(a, b, d) > 0 || turn(c, d, a) * turn(c, d, b) > 0;
}

// The loop encloses an area on its left and no two of its sides meet.
bool is_simple(const RegionCorners& corners) {
  const size_t n = corners.loop;
  double area = 0;
  for (size_t i = 1; i + 1 < n; ++i) area += turn(corners.uv[0], corners.uv[i], corners.uv[i + 1]);
  if (!(area > 0)) return false;
  for (size_t i = 0; i < n; ++i)
    for (size_t k = i + 2; k < n; ++k) {
      if (i == 0 && k == n - 1) continue;
      if (!are_apart(corners.uv[i], corners.uv[(i + 1) % n], corners.uv[k], corners.uv[(k + 1) % n]))
        return false;
    }
  return true;
}

void spread_on_circle(RegionCorners& corners, const std::vector<std::array<int, 3>>& triangles) {
  const size_t n = corners.loop;
  std::vector<double> arc(n + 1, 0);
  for (size_t i = 0; i < n; ++i)
    arc[i + 1] = arc[i] + (corners.position[(i + 1) % n] - corners.position[i]).norm();
  // Half by length and half by number, so that short sides are not lost to rounding.
  const double total = arc[n] > 0 ? arc[n] : 1;
  for (size_t i = 0; i < n; ++i) {
    const double share = 0.5 * arc[i] / total + 0.5 * static_cast<double>(i) / static_cast<double>(n);
    corners.uv[i] = {std::cos(2 * pi * share), std::sin(2 * pi * share)};
  }
  std::vector<std::vector<int>> neighbours(corners.size());
  for (const auto& t : triangles)
    for (size_t k = 0; k < 3; ++k) {
      neighbours[at(t[k])].push_back(t[(k + 1) % 3]);
      neighbours[at(t[k])].push_back(t[(k + 2) % 3]);
    }
  for (size_t i = n; i < corners.size(); ++i) corners.uv[i] = {0, 0};
  for (int round = 0; round < tutte_rounds; ++round)
    for (size_t i = n; i < corners.size(); ++i) {
      Vec2d sum(0, 0);
      for (const int k : neighbours[i]) sum += corners.uv[at(k)];
      if (!neighbours[i].empty()) corners.uv[i] = sum / static_cast<double>(neighbours[i].size());
    }
}

}  // namespace

void project(RegionCorners& corners) {
  const Projection projection(corners);
  for (size_t i = 0; i < corners.size(); ++i) corners.uv[i] = projection(corners.position[i]);
}

void lay_out(RegionCorners& corners) {
  project(corners);
  if (!is_simple(corners)) spread_on_circle(corners, {});
}

// Other triangles with the same corners, that are drawn without folds. Where the surface turns away, what
// lies between the corners would not be drawn between them.
bool cut_anew(Region& region) {
  const RegionCorners& corners = region.corners;
  if (!is_simple(corners)) return false;
  for (const Vec3d& n : corners.corner_normal)
    if (n.sqrnorm() > 0 && (n | corners.normal) < least_cosine) return false;
  std::vector<std::array<int, 3>> triangles;
  for (const auto& t : cut_ears(region.corners)) {
    triangles.push_back({t[0], t[1], t[2]});
    for (size_t k = 0; k < 3; ++k)
      if (region.corners.is_forbidden(t[k], t[(k + 1) % 3])) return false;
  }
  region.triangles = std::move(triangles);
  region.holds_samples = false;
  return true;
}

void lay_out(Region& region) {
  project(region.corners);
  const auto& uv = region.corners.uv;
  if (!is_unfolded(region.corners, region.triangles)) {
    if (cut_anew(region)) {
      const Projection projection(region.corners);
      for (Probe& probe : region.probes) probe.uv = projection(probe.position);
      return;
    }
    spread_on_circle(region.corners, region.triangles);
  }
  for (Probe& probe : region.probes) {
    const auto& t = region.triangles[at(probe.triangle)];
    probe.uv = probe.barycentric[0] * uv[at(t[0])] + probe.barycentric[1] * uv[at(t[1])] +
               probe.barycentric[2] * uv[at(t[2])];
  }
}

}  // namespace anisomesh::detail
