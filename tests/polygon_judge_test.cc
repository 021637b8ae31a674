// What polygons must not be.
#include "mesher/polygon_judge.hh"

#include "catch.hh"

using namespace anisomesh;

namespace {

std::vector<Vec3d> scaled(std::vector<Vec3d> points, double factor) {
  for (Vec3d& p : points) p *= factor;
  return points;
}

}  // namespace

TEST_CASE("a quad that leaves a corner by two sides the same way touches itself, whatever its size",
          "[polygon_judge]") {
  // From the second corner back along the first side; on a rim the turns beside it are too small to tell.
  const std::vector<Vec3d> spike{{0, 0, 0}, {3, 0, 0}, {1, 0, 0}, {0.5, 1, 0}};
  const std::vector<Vec3d> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<Vec3d> with_straight_corner{{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<Vec3d> thin{{0, 0, 0}, {1, 0, 0}, {1, 1e-4, 0}, {0, 1e-4, 0}};
  for (const double factor : {1.0, 1e-6, 1e6}) {
    CHECK(detail::PolygonJudge::touches_itself(scaled(spike, factor)));
    CHECK_FALSE(detail::PolygonJudge::touches_itself(scaled(square, factor)));
    CHECK_FALSE(detail::PolygonJudge::touches_itself(scaled(with_straight_corner, factor)));
    CHECK_FALSE(detail::PolygonJudge::touches_itself(scaled(thin, factor)));
  }
}
