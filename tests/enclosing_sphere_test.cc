#include "numerics/enclosing_sphere.hh"

#include <algorithm>
#include <cmath>
#include <random>

#include "anisomesh/shapes.hh"
#include "anisomesh/surface.hh"
#include "catch.hh"
#include "copies.hh"

using namespace anisomesh;
using detail::enclosing_diameter;

namespace {

std::vector<Vec3d> cloud(size_t count, unsigned seed) {
  std::mt19937 generator(seed);
  const auto one = [&] { return static_cast<double>(generator()) / 4294967296.0; };
  std::vector<Vec3d> points;
  for (size_t i = 0; i < count; ++i) points.emplace_back(one(), 0.5 * one(), 0.1 * one());
  return points;
}

}  // namespace

TEST_CASE("the smallest sphere around simple shapes", "[extent]") {
  CHECK(enclosing_diameter({{1, 2, 3}, {1, 2, 7}}) == Approx(4));
  CHECK(enclosing_diameter({{0, 0, 0}, {1, 0, 0}, {4, 0, 0}}) == Approx(4));
  CHECK(enclosing_diameter({{0, 0, 0}, {10, 0, 0}, {5, 1, 0}}) == Approx(10));  // an obtuse triangle
  const double h = std::sqrt(3.0) / 2;
  CHECK(enclosing_diameter({{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}}) == Approx(2 / std::sqrt(3.0)));
  CHECK(enclosing_diameter({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}) == Approx(2 * std::sqrt(3.0)));
  std::vector<Vec3d> box;
  for (const double x : {0.0, 3.0})
    for (const double y : {0.0, 4.0})
      for (const double z : {0.0, 12.0}) box.emplace_back(x, y, z);
  CHECK(enclosing_diameter(box) == Approx(13).epsilon(1e-14));
  auto sphere = make_shape("sphere", {4000, true});
  CHECK(SurfaceRef(sphere).extent() == Approx(2).epsilon(1e-12));
}

TEST_CASE("no smaller sphere encloses the points", "[extent]") {
  // The smallest one is that through some two, three or four of them: bounded from below by each of theirs
  // alone, and from above by the distance that all keep to a centre.
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto points = cloud(9, seed);
    const double all = enclosing_diameter(points);
    double most = 0;
    for (size_t i = 0; i < points.size(); ++i)
      for (size_t j = i; j < points.size(); ++j)
        for (size_t k = j; k < points.size(); ++k)
          for (size_t l = k; l < points.size(); ++l)
            if (i < l)
              most = std::max(most, enclosing_diameter({points[i], points[j], points[k], points[l]}));
    CHECK(all == Approx(most).epsilon(1e-12));
  }
}

TEST_CASE("the extent follows a surface that is turned or scaled, and no order of its vertices changes a bit",
          "[extent]") {
  auto points = cloud(2000, 5);
  const double size = enclosing_diameter(points);
  for (const auto& change : copies::changes(1)) {
    if (change.renumbers || std::string(change.name).rfind("moved", 0) == 0) continue;
    INFO(change.name);
    std::vector<Vec3d> there;
    for (const Vec3d& p : points) there.push_back(change.apply(p));
    CHECK(enclosing_diameter(there) == Approx(size * change.scale).epsilon(1e-12));
  }
  for (int i = 0; i < 5; ++i) {
    std::rotate(points.begin(), points.begin() + 317, points.end());
    CHECK(enclosing_diameter(points) == size);
    std::reverse(points.begin(), points.end());
    CHECK(enclosing_diameter(points) == size);
  }
}

TEST_CASE("tiny and huge surfaces have an extent", "[extent]") {
  const auto points = cloud(100, 3);
  const double size = enclosing_diameter(points);
  for (const int exponent : {-190, 190}) {
    std::vector<Vec3d> scaled;
    for (const Vec3d& p : points) scaled.push_back(std::ldexp(1.0, exponent) * p);
    CHECK(enclosing_diameter(scaled) == std::ldexp(size, exponent));
  }
}
