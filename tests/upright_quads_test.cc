// Quads at a rim that the shorter diagonal would draw out of their wall.
#include "mesher/upright_quads.hh"

#include "catch.hh"

using namespace anisomesh;

namespace {

// A quad of the wall of a hole around the z axis: three samples of the upper rim, at -a, 0 and a degrees, and
// one of the lower, a depth below.
struct Wall {
  detail::NetworkGraph network;
  std::vector<std::vector<int>> polygons{{0, 1, 2, 3}};

  Wall(double degrees, double depth, EdgeKind rim) {
    const double a = degrees * 3.14159265358979323846 / 180;
    for (const Vec3d& p : {Vec3d(std::cos(a), -std::sin(a), 0), Vec3d(1, 0, 0),
                           Vec3d(std::cos(a), std::sin(a), 0), Vec3d(1, 0, -depth)}) {
      network.graph.add_node({0, 0});
      network.positions.push_back(p);
    }
    network.graph.add_edge(0, 1, static_cast<int>(rim), 0);
    network.graph.add_edge(1, 2, static_cast<int>(rim), 0);
  }
};

}  // namespace

TEST_CASE("a quad with three corners on a rim is not drawn across the hole", "[upright_quads]") {
  Wall deep(20, 1, EdgeKind::feature);
  CHECK(detail::split_upright_quads(deep.polygons, deep.network) == 1);
  REQUIRE(deep.polygons.size() == 2);
  for (const auto& triangle : deep.polygons) {
    REQUIRE(triangle.size() == 3);
    Vec3d area(0, 0, 0);
    for (size_t i = 1; i + 1 < 3; ++i)
      area += cross(deep.network.positions[static_cast<size_t>(triangle[i])] -
                        deep.network.positions[static_cast<size_t>(triangle[0])],
                    deep.network.positions[static_cast<size_t>(triangle[i + 1])] -
                        deep.network.positions[static_cast<size_t>(triangle[0])]);
    CHECK(std::abs(area[2]) < 1e-12);  // along the wall
  }
}

TEST_CASE("other quads stay whole", "[upright_quads]") {
  Wall along_lines(20, 1, EdgeKind::min);    // no rim: its shape is free
  Wall shallow(20, 0.1, EdgeKind::feature);  // the shorter diagonal is the right one
  Wall taken(20, 1, EdgeKind::feature);      // the other diagonal is a side of another polygon
  taken.network.graph.add_node({0, 0});
  taken.network.positions.push_back(Vec3d(2, 0, 0));
  taken.polygons.push_back({1, 3, 4});
  for (Wall* wall : {&along_lines, &shallow, &taken}) {
    const auto before = wall->polygons;
    CHECK(detail::split_upright_quads(wall->polygons, wall->network) == 0);
    CHECK(wall->polygons == before);
  }
}
