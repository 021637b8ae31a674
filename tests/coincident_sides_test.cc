// Sides of polygons that lie on each other where vertices of the surface are in one place.
#include "mesher/coincident_sides.hh"

#include "catch.hh"

using namespace anisomesh;
using detail::CoincidentSides;

namespace {

// Nodes 2 and 5 are one place: two fans of polygons touch there.
detail::NetworkGraph two_fans() {
  detail::NetworkGraph network;
  const std::vector<Vec3d> places{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                  {2, 1, 0}, {1, 1, 0}, {2, 2, 0}};
  for (const Vec3d& p : places) {
    network.graph.add_node({p[0], p[1]});
    network.positions.push_back(p);
  }
  return network;
}

}  // namespace

TEST_CASE("polygons that touch in a vertex share no side", "[coincident_sides]") {
  const auto network = two_fans();
  const std::vector<std::vector<int>> polygons{{0, 1, 2, 3}, {5, 4, 6}};
  const CoincidentSides sides(polygons, network);
  for (const auto& polygon : polygons) CHECK_FALSE(sides.has_one(polygon, network));
  CHECK_FALSE(sides.lies_on_another(2, 3));
  CHECK(sides.lies_on_another(5, 3));  // it would
}

TEST_CASE("sides from copies of a vertex to one neighbour lie on each other, unless they must be there",
          "[coincident_sides]") {
  auto network = two_fans();
  const std::vector<std::vector<int>> polygons{{0, 1, 2, 3}, {3, 5, 6}, {5, 4, 6}};
  network.graph.add_edge(2, 3, static_cast<int>(EdgeKind::border), 0);
  const CoincidentSides sides(polygons, network);
  CHECK_FALSE(sides.has_one(polygons[0], network));  // its side is the border
  CHECK(sides.has_one(polygons[1], network));
  CHECK_FALSE(sides.has_one(polygons[2], network));
  network.graph.add_edge(3, 5, static_cast<int>(EdgeKind::feature), 0);
  CHECK_FALSE(sides.has_one(polygons[1], network));
}

TEST_CASE("where every node has a place of its own nothing lies on anything", "[coincident_sides]") {
  auto network = two_fans();
  network.positions[5] = {1, 1, 1e-9};
  const std::vector<std::vector<int>> polygons{{0, 1, 2, 3}, {3, 5, 6}};
  const CoincidentSides sides(polygons, network);
  CHECK_FALSE(sides.lies_on_another(3, 5));
  for (const auto& polygon : polygons) CHECK_FALSE(sides.has_one(polygon, network));
}

TEST_CASE("a side past a node that is beside both its ends lies on theirs", "[coincident_sides]") {
  for (const double off : {0.0, 0.01}) {
    detail::NetworkGraph network;
    for (const Vec3d& p :
         {Vec3d(0, 0, 0), Vec3d(1, off, 0), Vec3d(2, 0, 0), Vec3d(1, 1, 0), Vec3d(1, -1, 0)}) {
      network.graph.add_node({p[0], p[1]});
      network.positions.push_back(p);
    }
    const std::vector<std::vector<int>> polygons{{0, 1, 3}, {1, 2, 3}, {2, 0, 4}};
    CHECK(CoincidentSides(polygons, network).has_one(polygons[2], network) == (off == 0));
    CHECK_FALSE(CoincidentSides(polygons, network).has_one(polygons[0], network));
    network.graph.add_edge(0, 2, static_cast<int>(EdgeKind::feature), 0);  // it must be there
    CHECK_FALSE(CoincidentSides(polygons, network).has_one(polygons[2], network));
  }
}
