#include "ball_clip.hh"

#include <algorithm>
#include <cmath>

namespace anisomesh::detail {

namespace {

using OpenMesh::Vec2d;

/// The range of t in [0, 1] for which a + t (b - a) lies within the ball; empty where first >= second.
template <class Vector>
std::pair<double, double> range_in_ball(const Vector& a, const Vector& b, double radius_squared) {
  const Vector d = b - a;
  const double dd = d | d, ad = a | d;
  if (!(dd > 0)) return {0, (a | a) < radius_squared ? 1 : 0};
  const double discriminant = ad * ad - dd * ((a | a) - radius_squared);
  if (!(discriminant > 0)) return {0, 0};
  const double root = std::sqrt(discriminant);
  return {std::clamp((-ad - root) / dd, 0.0, 1.0), std::clamp((-ad + root) / dd, 0.0, 1.0)};
}

double cross(const Vec2d& a, const Vec2d& b) { return a[0] * b[1] - a[1] * b[0]; }

/// The area of a polygon within a disc around the origin, edge by edge: chords within the disc and sectors
/// outside of it.
class DiscClip {
 public:
  /// \param may_surround whether the polygon can turn around the origin by more than half a turn; if not, all
  /// sectors together cost one arc tangent instead of one each.
  DiscClip(double radius_squared, bool may_surround)
      : radius_squared_(radius_squared), may_surround_(may_surround) {}

  void add_edge(const Vec2d& a, const Vec2d& b) {
    const auto [first, second] = range_in_ball(a, b, radius_squared_);
    if (!(first < second)) return add_sector(a, b);
    const Vec2d p = a + first * (b - a), q = a + second * (b - a);
    doubled_chords_ += cross(p, q);
    if (first > 0) add_sector(a, p);
    if (second < 1) add_sector(q, b);
  }

  double area() const {
    return 0.5 * (doubled_chords_ + radius_squared_ * (angle_ + std::atan2(sine_, cosine_)));
  }

 private:
  void add_sector(const Vec2d& p, const Vec2d& q) {
    const double x = (p | q) / radius_squared_, y = cross(p, q) / radius_squared_;
    if (may_surround_) {
      angle_ += std::atan2(y, x);
      return;
    }
    const double cosine = cosine_ * x - sine_ * y;
    sine_ = cosine_ * y + sine_ * x;
    cosine_ = cosine;
  }

  double radius_squared_, doubled_chords_ = 0, angle_ = 0;
  double cosine_ = 1, sine_ = 0;  // of the sum of the angles, times a positive factor
  bool may_surround_;
};

}  // namespace

double length_in_ball(const Vec3d& a, const Vec3d& b, double radius) {
  const auto [first, second] = range_in_ball(a, b, radius * radius);
  return std::max(0.0, second - first) * (b - a).norm();
}

double area_in_ball(const Vec3d& a, const Vec3d& b, const Vec3d& c, double radius) {
  const Vec3d ab = b - a, ac = c - a, normal = ab % ac;
  const double length = ab.norm(), doubled = normal.norm();
  if (!(doubled > 0)) return 0;
  // Coordinates in the triangle's plane, around the foot of the perpendicular from the origin.
  const Vec3d x = ab / length, y = (normal / doubled) % x;
  const double height = (a | normal) / doubled, disc = radius * radius - height * height;
  if (!(disc > 0)) return 0;
  const Vec2d p(a | x, a | y), q(b | x, b | y), r(c | x, c | y);
  const bool surrounds = cross(p, q) > 0 && cross(q, r) > 0 && cross(r, p) > 0;
  DiscClip clip(disc, surrounds);
  clip.add_edge(p, q);
  clip.add_edge(q, r);
  clip.add_edge(r, p);
  return std::clamp(clip.area(), 0.0, 0.5 * doubled);
}

bool meets_ball(const Vec3d& a, const Vec3d& b, double radius) {
  const auto [first, second] = range_in_ball(a, b, radius * radius);
  return first < second;
}

}  // namespace anisomesh::detail
