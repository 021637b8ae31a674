#include "numerics/proximity.hh"

#include <cmath>
#include <random>

#include "catch.hh"

using anisomesh::detail::Ignore;
using anisomesh::detail::Proximity;
using OpenMesh::Vec2d;

namespace {

std::vector<Proximity::Fence> unit_square() {
  return {{{0, 0}, {1, 0}, 1, 1}, {{1, 0}, {1, 1}, 1, 1}, {{1, 1}, {0, 1}, 1, 1}, {{0, 1}, {0, 0}, 1, 1}};
}

double to_segment(const Vec2d& p, const Vec2d& a, const Vec2d& b) {
  const double t = std::min(1.0, std::max(0.0, ((p - a) | (b - a)) / (b - a).sqrnorm()));
  return (a + t * (b - a) - p).norm();
}

}  // namespace

TEST_CASE("the nearest line is that of a search through all of them", "[proximity]") {
  // Wavy lines that do not cross: no fence stands between a point and its nearest segment.
  Proximity proximity;
  proximity.enter_fences(unit_square());
  std::vector<std::vector<Proximity::Vertex>> lines;
  for (int i = 0; i < 9; ++i) {
    std::vector<Proximity::Vertex> line;
    for (int j = 0; j <= 40; ++j) {
      const double x = 0.05 + 0.9 * j / 40;
      line.push_back({{x, 0.1 * (i + 1) + 0.04 * std::sin(9 * x)}, x, 1});
    }
    proximity.enter_line(i, line);
    lines.push_back(line);
  }
  std::mt19937 random(7);
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
  for (int n = 0; n < 2000; ++n) {
    const Vec2d p(uniform(), uniform());
    double expected = 1e9;
    int nearest = -1;
    for (size_t i = 0; i < lines.size(); ++i)
      for (size_t j = 1; j < lines[i].size(); ++j) {
        const double d = to_segment(p, lines[i][j - 1].point, lines[i][j].point);
        if (d < expected) expected = d, nearest = static_cast<int>(i);
      }
    const auto found = proximity.nearest(p, 0.5);
    REQUIRE(found.line.distance == Approx(expected).margin(1e-14));
    REQUIRE(found.line.line == nearest);
    REQUIRE((found.line.point - p).norm() == Approx(expected).margin(1e-14));
    REQUIRE(found.line.arc == Approx(found.line.point[0]).margin(0.01));
  }
}

TEST_CASE("a fence hides what is behind it", "[proximity]") {
  Proximity proximity;
  auto fences = unit_square();
  fences.push_back({{0.5, 0}, {0.5, 1}, 1, 1});
  proximity.enter_fences(fences);
  proximity.enter_line(3, {{{0.6, 0.1}, 0, 1}, {{0.6, 0.9}, 1, 1}});
  CHECK(proximity.nearest({0.7, 0.5}, 1).line.distance == Approx(0.1));
  const auto hidden = proximity.nearest({0.45, 0.5}, 1);
  CHECK(std::isinf(hidden.line.distance));
  CHECK(hidden.fence.distance == Approx(0.05));
  CHECK(std::abs(hidden.fence.direction[1]) == Approx(1));
}

TEST_CASE("a line does not see the part of itself that is left out", "[proximity]") {
  Proximity proximity;
  proximity.enter_fences(unit_square());
  proximity.enter_line(0, {{{0.2, 0.2}, 0, 1}, {{0.5, 0.2}, 0.3, 1}, {{0.8, 0.2}, 0.6, 1}});
  CHECK(proximity.nearest({0.7, 0.3}, 0.15, {0, 0.3, 0.6}).line.line == -1);
  CHECK(proximity.nearest({0.7, 0.3}, 0.15, {1, 0.3, 0.6}).line.distance == Approx(0.1));
  const auto end = proximity.nearest({0.9, 0.2}, 0.2);
  CHECK(end.line.distance == Approx(0.1));
  CHECK(end.line.arc == Approx(0.6));
}

TEST_CASE("a bound hides what is farther", "[proximity]") {
  Proximity proximity;
  proximity.enter_fences(unit_square());
  proximity.enter_point(5, {0.5, 0.5}, 1);
  CHECK(std::isinf(proximity.nearest({0.5, 0.8}, 0.29).line.distance));
  CHECK(proximity.nearest({0.5, 0.8}, 0.31).line.distance == Approx(0.3));
  CHECK(proximity.nearest({0.5, 0.8}, 0.31).line.line == 5);
}
