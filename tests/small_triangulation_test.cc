// Small triangulations, of which some edges must stay.
#include "numerics/small_triangulation.hh"

#include <algorithm>

#include "catch.hh"

using namespace anisomesh;
using OpenMesh::Vec2d;

namespace {

bool has_edge(const detail::SmallTriangulation& triangulation, int a, int b) {
  const auto& all = triangulation.triangles();
  return std::any_of(all.begin(), all.end(), [&](const std::array<int, 3>& t) {
    return std::count(t.begin(), t.end(), a) + std::count(t.begin(), t.end(), b) == 2;
  });
}

}  // namespace

TEST_CASE("a wall stays where a flip would make it Delaunay", "[small_triangulation]") {
  // The longer diagonal of a rhombus, and a point beside it.
  std::vector<Vec2d> points{{-3, 0}, {0, -1}, {3, 0}, {0, 1}};
  const std::vector<std::array<int, 3>> triangles{{0, 1, 2}, {0, 2, 3}};
  detail::SmallTriangulation free(points, triangles), walled(points, triangles, {{2, 0}});
  CHECK(free.can_flip(0, 1));
  for (size_t k = 0; k < 3; ++k) CHECK_FALSE(walled.can_flip(0, k));
  points.emplace_back(0.1, 0.3);
  REQUIRE(free.insert(4));
  REQUIRE(walled.insert(4));
  CHECK_FALSE(has_edge(free, 0, 2));
  CHECK(has_edge(walled, 0, 2));
  CHECK(walled.triangles().size() == 4);
}
