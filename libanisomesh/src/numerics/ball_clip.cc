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

/// Signed area of the triangle (origin, a, b) within the disc around the origin.
double wedge_in_disc(const Vec2d& a, const Vec2d& b, double radius_squared) {
  const auto sector = [&](const Vec2d& p, const Vec2d& q) {
    return 0.5 * radius_squared * std::atan2(cross(p, q), p | q);
  };
  const auto [first, second] = range_in_ball(a, b, radius_squared);
  if (!(first < second)) return sector(a, b);
  const Vec2d p = a + first * (b - a), q = a + second * (b - a);
  double area = 0.5 * cross(p, q);
  if (first > 0) area += sector(a, p);
  if (second < 1) area += sector(q, b);
  return area;
}

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
  const double area = wedge_in_disc(p, q, disc) + wedge_in_disc(q, r, disc) + wedge_in_disc(r, p, disc);
  return std::clamp(area, 0.0, 0.5 * doubled);
}

bool meets_ball(const Vec3d& a, const Vec3d& b, double radius) {
  const auto [first, second] = range_in_ball(a, b, radius * radius);
  return first < second;
}

}  // namespace anisomesh::detail
