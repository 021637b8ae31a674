#include "numerics/hausdorff.hh"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace anisomesh::detail {

namespace {

constexpr int max_depth = 12;

struct Corner {
  Vec3d place;
  ClosestPoint nearest;
};

class Search {
 public:
  Search(const TriangleTree& to, double limit) : to_(to), limit_(limit) {}

  DistanceBounds bounds;

  Corner corner(const Vec3d& place) {
    Corner c{place, to_.closest(place)};
    bounds.at_least = std::max(bounds.at_least, std::sqrt(c.nearest.squared_distance));
    return c;
  }
  void look(const Corner& a, const Corner& b, const Corner& c, int depth) {
    const double bound = bound_of(a, b, c);
    if (bound <= limit_ || bounds.at_least > limit_ || depth == max_depth) {
      bounds.at_most = std::max(bounds.at_most, bound);
      return;
    }
    const Corner ab = corner(0.5 * (a.place + b.place)), bc = corner(0.5 * (b.place + c.place)),
                 ca = corner(0.5 * (c.place + a.place));
    look(a, ab, ca, depth + 1);
    look(b, bc, ab, depth + 1);
    look(c, ca, bc, depth + 1);
    look(ab, bc, ca, depth + 1);
  }
  /// The same of a segment, which is a triangle whose last two corners are one.
  void look(const Corner& a, const Corner& b, int depth) {
    const double bound = bound_of(a, b, b);
    if (bound <= limit_ || bounds.at_least > limit_ || depth == max_depth) {
      bounds.at_most = std::max(bounds.at_most, bound);
      return;
    }
    const Corner middle = corner(0.5 * (a.place + b.place));
    look(a, middle, depth + 1);
    look(middle, b, depth + 1);
  }

 private:
  // The distance to one triangle is convex, so on a piece it is largest at a corner; and the distance to all
  // changes by no more than one goes.
  double bound_of(const Corner& a, const Corner& b, const Corner& c) const {
    const Corner* corners[3] = {&a, &b, &c};
    double best = std::numeric_limits<double>::infinity();
    for (const Corner* base : corners) {
      double to_one = 0, away = 0;
      for (const Corner* other : corners) {
        to_one = std::max(to_one, distance(other->place, base->nearest.triangle));
        away = std::max(away, (other->place - base->place).norm());
      }
      best = std::min({best, to_one, std::sqrt(base->nearest.squared_distance) + away});
    }
    return best;
  }
  double distance(const Vec3d& p, int triangle) const {
    const Triangle& t = to_.triangles()[static_cast<size_t>(triangle)];
    const Vec3d &a = to_.points()[static_cast<size_t>(t[0])], &b = to_.points()[static_cast<size_t>(t[1])],
                &c = to_.points()[static_cast<size_t>(t[2])];
    const Vec3d w = closest_barycentric(p, a, b, c);
    return (w[0] * a + w[1] * b + w[2] * c - p).norm();
  }

  const TriangleTree& to_;
  double limit_;
};

}  // namespace

DistanceBounds farthest_distance(const TriangleTree& from, const TriangleTree& to, double limit) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  if (from.triangles().empty()) return {};
  if (to.triangles().empty()) return {infinite, infinite};
  std::vector<DistanceBounds> bounds(from.triangles().size());
  tbb::parallel_for(tbb::blocked_range<size_t>(0, bounds.size(), 64), [&](const auto& range) {
    for (size_t i = range.begin(); i != range.end(); ++i) {
      Search search(to, limit);
      const Triangle& t = from.triangles()[i];
      const Corner a = search.corner(from.points()[static_cast<size_t>(t[0])]),
                   b = search.corner(from.points()[static_cast<size_t>(t[1])]),
                   c = search.corner(from.points()[static_cast<size_t>(t[2])]);
      if (t[1] == t[2])
        search.look(a, b, 0);
      else
        search.look(a, b, c, 0);
      bounds[i] = search.bounds;
    }
  });
  DistanceBounds all;
  for (const DistanceBounds& b : bounds) {
    all.at_least = std::max(all.at_least, b.at_least);
    all.at_most = std::max(all.at_most, b.at_most);
  }
  return all;
}

}  // namespace anisomesh::detail
