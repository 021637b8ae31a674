// Which polygon lies beside which, while polygons change.
#include "mesher/polygon_adjacency.hh"

#include <algorithm>

#include "catch.hh"

using namespace anisomesh;

namespace {

using Polygon = std::vector<int>;

// n x n quads on a grid of (n + 1)^2 nodes.
std::vector<Polygon> grid(int n) {
  std::vector<Polygon> result;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const int a = y * (n + 1) + x;
      result.push_back({a, a + 1, a + n + 2, a + n + 1});
    }
  return result;
}

}  // namespace

TEST_CASE("polygons that are taken out and put in are beside what they would be beside from the start",
          "[polygon_adjacency]") {
  constexpr int n = 6, nodes = (n + 1) * (n + 1);
  const auto may_cross = [](int a, int b) { return a % 5 != 0 || b % 5 != 0; };
  auto polygons = grid(n);
  detail::PolygonAdjacency changed(polygons, nodes, may_cross);
  // A quad becomes two triangles, one of them at the end; two quads become a polygon of six corners.
  for (const int p : {7, 14, 15, 35}) changed.take_out(polygons, p);
  const Polygon quad = polygons[7], last = polygons[35];
  polygons[7] = {quad[0], quad[1], quad[2]};
  polygons.push_back({quad[0], quad[2], quad[3]});
  polygons[14] = {polygons[14][0], polygons[14][1], polygons[15][1],
                  polygons[15][2], polygons[15][3], polygons[14][3]};
  polygons[15] = {};
  for (const int p : {7, 14, 15, 35, 36}) changed.put_in(polygons, p);

  const detail::PolygonAdjacency anew(polygons, nodes, may_cross);
  size_t beside = 0;
  for (int p = 0; p < static_cast<int>(polygons.size()); ++p)
    for (size_t i = 0; i < polygons[static_cast<size_t>(p)].size(); ++i) {
      CHECK(changed.neighbor(p, i) == anew.neighbor(p, i));
      beside += changed.neighbor(p, i) >= 0 ? 1 : 0;
    }
  CHECK(beside > 100);
  for (int a = 0; a < nodes; ++a) {
    CHECK(changed.faces_at(a) == anew.faces_at(a));
    for (int b = 0; b < a; ++b) CHECK(changed.are_joined(a, b) == anew.are_joined(a, b));
  }
}

TEST_CASE("what is around polygons of which two lie on each other is enclosed by the others' outline",
          "[polygon_adjacency]") {
  detail::NetworkGraph network;
  const std::vector<Vec3d> places{{0, 0, 0}, {1, 0, 0}, {0.5, 0.1, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  for (const Vec3d& p : places) {
    network.graph.add_node({p[0], p[1]});
    network.positions.push_back(p);
    network.points.emplace_back();
    network.normals.emplace_back(0, 0, 1);
  }
  // 0, the middle of all, and 2, between the first two, are enclosed.
  const std::vector<Polygon> polygons{{0, 1, 2}, {0, 2, 1, 3}, {3, 4, 5, 0}, {0, 5, 1}};
  const detail::PolygonAdjacency adjacency(polygons, places.size(), [](int, int) { return true; });
  auto nodes = adjacency.around(polygons, {0, 1, 2, 3}, network, true).node;
  REQUIRE(nodes.size() == 4);
  std::rotate(nodes.begin(), std::min_element(nodes.begin(), nodes.end()), nodes.end());
  CHECK(nodes == Polygon{1, 3, 4, 5});
  CHECK(adjacency.around(polygons, {0, 1, 2, 3}, network, false).loop == 0);  // none may go
  // A feature that ends within stays.
  const detail::PolygonAdjacency walled(polygons, places.size(), [](int a, int b) { return a + b != 2; });
  CHECK(walled.around(polygons, {1, 2, 3, 0}, network, true).loop == 0);
}
