// Which polygon lies beside which, while polygons change.
#include "polygon_adjacency.hh"

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
