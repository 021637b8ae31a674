#include "numerics/ball_clip.hh"

#include <cmath>
#include <random>

#include "catch.hh"
#include "shapes/planar_sampling.hh"

using namespace anisomesh::detail;

namespace {

/// The area inside the ball by cutting the triangle into n * n equal ones and asking for their centres.
double sampled_area(const Vec3d& a, const Vec3d& b, const Vec3d& c, double radius, int n) {
  int inside = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j)
      for (const double third : {1.0 / 3, 2.0 / 3}) {
        const double s = (i + third) / n, t = (j + third) / n;
        if (s + t < 1 && (a + s * (b - a) + t * (c - a)).norm() < radius) ++inside;
      }
  return 0.5 * ((b - a) % (c - a)).norm() * inside / (n * n);
}

}  // namespace

TEST_CASE("the area of a triangle in a ball agrees with sampling", "[ball_clip]") {
  std::mt19937 generator(7);
  const auto coordinate = [&] { return 2 * uniform(generator) - 1; };
  for (int i = 0; i < 60; ++i) {
    Vec3d p[3];
    for (auto& x : p) x = Vec3d(coordinate(), coordinate(), coordinate());
    const double radius = 0.2 + 0.8 * uniform(generator), area = 0.5 * ((p[1] - p[0]) % (p[2] - p[0])).norm();
    CHECK(area_in_ball(p[0], p[1], p[2], radius) ==
          Approx(sampled_area(p[0], p[1], p[2], radius, 300)).margin(0.01 * area));
  }
}

TEST_CASE("clips have their closed forms", "[ball_clip]") {
  const double pi = std::acos(-1.0);
  const Vec3d a(-9, -9, 0.3), b(9, -9, 0.3), c(0, 9, 0.3);
  CHECK(area_in_ball(a, b, c, 0.5) == Approx(pi * 0.16));  // the whole disc
  CHECK(area_in_ball(a, b, c, 0.29) == 0);                 // the plane passes by
  CHECK(area_in_ball(a, b, c, 100) == Approx(162));        // the whole triangle
  CHECK(area_in_ball({0, 0, 0}, {9, 0, 0}, {0, 9, 0}, 2) == Approx(pi));
  CHECK(area_in_ball({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, 5) == 0);
  CHECK(length_in_ball({-3, 0.6, 0}, {3, 0.6, 0}, 1) == Approx(1.6));
  CHECK(length_in_ball({0, 0, 0}, {0, 3, 0}, 1) == Approx(1));
  CHECK(length_in_ball({-3, 1.1, 0}, {3, 1.1, 0}, 1) == 0);
  CHECK(meets_ball({-3, 0.9, 0}, {3, 0.9, 0}, 1));
  CHECK_FALSE(meets_ball({2, 0, 0}, {3, 0, 0}, 1));
}
