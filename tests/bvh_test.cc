#include "numerics/bvh.hh"
#include "numerics/self_intersections.hh"

#include <cmath>
#include <random>
#include <set>

#include "catch.hh"
#include "numerics/sampling.hh"

using namespace anisomesh::detail;

namespace {

class Numbers {
 public:
  double operator()() { return (static_cast<double>(generator_()) + 0.5) / 4294967296.0; }
  Vec3d point() { return {(*this)(), (*this)(), (*this)()}; }

 private:
  std::mt19937 generator_{7};
};

}  // namespace

TEST_CASE("the tree finds what a look at every triangle finds", "[bvh]") {
  Numbers random;
  std::vector<Vec3d> points;
  std::vector<Triangle> triangles;
  for (int i = 0; i < 300; ++i) {
    const Vec3d centre = random.point();
    for (int k = 0; k < 3; ++k) points.push_back(centre + 0.1 * random.point());
    if (i % 10 == 0) points.back() = points[points.size() - 2];  // some without area
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const TriangleTree tree(points, triangles);
  for (int i = 0; i < 500; ++i) {
    const Vec3d p = 2.0 * random.point() - Vec3d(0.5, 0.5, 0.5);
    const auto even = [](int t) { return t % 2 == 0; };
    double nearest = 1e300, nearest_even = 1e300;
    for (size_t t = 0; t < triangles.size(); ++t) {
      const Vec3d &a = points[3 * t], &b = points[3 * t + 1], &c = points[3 * t + 2];
      const Vec3d w = closest_barycentric(p, a, b, c);
      const double distance = (w[0] * a + w[1] * b + w[2] * c - p).norm();
      nearest = std::min(nearest, distance);
      if (even(static_cast<int>(t))) nearest_even = std::min(nearest_even, distance);
    }
    CHECK(std::sqrt(tree.closest(p).squared_distance) == Approx(nearest).epsilon(1e-12));
    const double unbounded = std::numeric_limits<double>::infinity();
    CHECK(std::sqrt(tree.closest_if(p, unbounded, even).squared_distance) ==
          Approx(nearest_even).epsilon(1e-12));
    CHECK(tree.closest_if(p, 0.99 * nearest * nearest, even).triangle == -1);
  }
}

TEST_CASE("of triangles that are as near the first is taken, wherever they lie", "[bvh]") {
  // A fan: all are as near to what is above its tip, but for rounding.
  Numbers random;
  for (int i = 0; i < 50; ++i) {
    const Vec3d axis = (random.point() - Vec3d(0.5, 0.5, 0.5)).normalized(), place = random.point();
    const double angle = 6 * random();
    const auto turned = [&](const Vec3d& p) {
      return place + std::cos(angle) * p + std::sin(angle) * (axis % p) +
             (1 - std::cos(angle)) * (axis | p) * axis;
    };
    std::vector<Vec3d> points{turned({0, 0, 0})};
    std::vector<Triangle> triangles;
    for (int k = 0; k < 24; ++k) {
      points.push_back(turned({std::cos(0.7 * k), std::sin(0.7 * k), -0.5}));
      if (k > 0) triangles.push_back({0, k, k + 1});
    }
    const auto found = TriangleTree(points, triangles).closest(turned({0, 0, 0.3}));
    CHECK(found.triangle == 0);
    CHECK(std::sqrt(found.squared_distance) == Approx(0.3).epsilon(1e-12));
  }
}

TEST_CASE("no point of a triangle is nearer than the closest one", "[bvh]") {
  Numbers random;
  for (int i = 0; i < 2000; ++i) {
    const Vec3d a = random.point(), b = random.point();
    const Vec3d c = i % 5 == 0 ? a + 0.3 * (b - a) : random.point();  // some without area
    const Vec3d p = 3.0 * random.point() - Vec3d(1, 1, 1);
    const Vec3d w = closest_barycentric(p, a, b, c);
    CHECK(w[0] + w[1] + w[2] == Approx(1));
    CHECK(std::min({w[0], w[1], w[2]}) >= 0);
    const double distance = (w[0] * a + w[1] * b + w[2] * c - p).norm();
    for (int k = 0; k < 20; ++k) {
      const double r = std::sqrt(random()), s = random();
      const Vec3d q = a + r * (1 - s) * (b - a) + r * s * (c - a);
      CHECK((q - p).norm() >= distance - 1e-12);
    }
  }
}

TEST_CASE("the tree finds the triangles that cross one as a look at every triangle does", "[bvh]") {
  Numbers random;
  std::vector<Vec3d> points;
  std::vector<Triangle> triangles;
  for (int t = 0; t < 300; ++t) {
    const Vec3d middle = random.point();
    for (int i = 0; i < 3; ++i) points.push_back(middle + 0.2 * random.point());
    triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  // One shares a corner by its number, one by its place, one is folded onto another across a side.
  triangles.push_back({0, 3, 4});
  points.push_back(points[0]);
  triangles.push_back({static_cast<int>(points.size()) - 1, 6, 7});
  points.push_back(points[0] + 0.5 * (points[1] - points[0]) + 0.4 * (points[2] - points[0]));
  triangles.push_back({0, 1, static_cast<int>(points.size()) - 1});
  const TriangleTree tree(points, triangles);
  size_t crossings = 0;
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
    std::set<int> found, wanted;
    tree.any_near(tree.box_of(t), [&](int u) {
      if (u != t && do_cross(tree.corners_of(t), tree.corners_of(u))) found.insert(u);
      return false;
    });
    for (int u = 0; u < static_cast<int>(triangles.size()); ++u)
      if (u != t && do_cross(tree.corners_of(t), tree.corners_of(u))) wanted.insert(u);
    CHECK(found == wanted);
    crossings += found.size();
  }
  // By place, as the one whose corner is there twice has it.
  std::vector<Triangle> by_place = triangles;
  by_place[301][0] = 0;
  CHECK(crossings == 2 * self_intersections(points, by_place).size());
  CHECK(crossings > 20);
}

TEST_CASE("samples are spread by area and repeat with the seed", "[bvh]") {
  // Two right triangles, the second of 9 times the area.
  const std::vector<Vec3d> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {8, 0, 0}, {5, 3, 0}};
  const std::vector<Triangle> triangles{{0, 1, 2}, {3, 4, 5}};
  const auto samples = sample_by_area(points, triangles, 10000, 1);
  REQUIRE(samples.size() == 10000);
  size_t small = 0;
  Vec3d mean(0, 0, 0);
  for (const auto& sample : samples) {
    if (sample.triangle == 0)
      ++small;
    else
      mean += sample.point / 9000.0;
  }
  CHECK(small == 1000);
  CHECK(mean[0] == Approx(6).margin(0.02));
  CHECK(mean[1] == Approx(1).margin(0.02));
  const auto again = sample_by_area(points, triangles, 10000, 1);
  const auto other = sample_by_area(points, triangles, 10000, 2);
  bool same = true, all_other = true;
  for (size_t i = 0; i < samples.size(); ++i) {
    same = same && again[i].point == samples[i].point;
    all_other = all_other && !(other[i].point == samples[i].point);
  }
  CHECK(same);
  CHECK(all_other);
}
