#include "numerics/arrangement.hh"

#include <algorithm>
#include <cmath>
#include <random>

#include "catch.hh"
#include "numerics/convex_partition.hh"
#include "numerics/point_index.hh"
#include "numerics/small_triangulation.hh"

using anisomesh::detail::Arrangement;
using anisomesh::detail::convex_partition;
using anisomesh::detail::PlanarGraph;
using anisomesh::detail::PointIndex;
using anisomesh::detail::SmallTriangulation;
using OpenMesh::Vec2d;

namespace {

double uniform(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }

double turn(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

bool cross(const Vec2d& a, const Vec2d& b, const Vec2d& c, const Vec2d& d) {
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

size_t edges_of(const PlanarGraph& graph) {
  size_t count = 0;
  for (size_t e = 0; e < graph.n_edges(); ++e) count += graph.edge(static_cast<int>(e)).alive;
  return count;
}

}  // namespace

TEST_CASE("every crossing of random segments becomes a node, and the graph is planar", "[arrangement]") {
  std::mt19937 random(7);
  Arrangement arrangement({0, 0}, {1, 1});
  std::vector<std::pair<Vec2d, Vec2d>> segments;
  size_t crossings = 0;
  for (int i = 0; i < 150; ++i) {
    const Vec2d a(uniform(random), uniform(random)), b(uniform(random), uniform(random));
    for (const auto& [c, d] : segments) crossings += cross(a, b, c, d);
    segments.emplace_back(a, b);
    const int from = arrangement.insert_point(a), to = arrangement.insert_point(b);
    REQUIRE(arrangement.insert_segment(from, to, 0, i));
  }
  CHECK(arrangement.crossings().size() == crossings);
  CHECK(arrangement.graph().n_nodes() == 300 + crossings);
  CHECK(edges_of(arrangement.graph()) == 150 + 2 * crossings);
  for (const auto& t : arrangement.triangles()) {
    if (*std::min_element(t.node.begin(), t.node.end()) < 0) continue;
    const PlanarGraph& graph = arrangement.graph();
    CHECK(turn(graph.uv(t.node[0]), graph.uv(t.node[1]), graph.uv(t.node[2])) > 0);
  }
}

TEST_CASE("chains that were entered sample by sample may cross as often as they like", "[arrangement]") {
  // Entering a constraint removes triangles, among them the one the last point was found in.
  Arrangement arrangement({-1, -1}, {1, 1});
  for (int wave = 0; wave < 12; ++wave) {
    int before = -1;
    for (int i = 0; i <= 300; ++i) {
      const double x = -1 + i / 150.0;
      const int node =
          arrangement.insert_point({x, 0.9 * std::sin(9 * x + 0.5 * wave) * (wave % 2 ? 1 : -0.3)});
      if (before >= 0) REQUIRE(arrangement.insert_segment(before, node, wave % 2, i));
      before = node;
    }
  }
  const PlanarGraph& graph = arrangement.graph();
  for (const auto& crossing : arrangement.crossings()) CHECK(graph.degree(crossing.node) >= 3);
}

TEST_CASE("nearly parallel segments through nearly the same point stay a planar graph", "[arrangement]") {
  Arrangement arrangement({-1, -1}, {1, 1});
  const double tiny = 1e-15;
  for (int i = 0; i < 60; ++i) {
    const double angle = 3.14159265358979 * i / 60, offset = (i % 7 - 3) * tiny;
    const Vec2d direction(std::cos(angle), std::sin(angle)), normal(-direction[1], direction[0]);
    const Vec2d a = -0.9 * direction + offset * normal, b = 0.9 * direction + offset * normal;
    const int from = arrangement.insert_point(a), to = arrangement.insert_point(b);
    CHECK(arrangement.insert_segment(from, to, i % 2, i));
  }
  const PlanarGraph& graph = arrangement.graph();
  // Planar and connected: every triangle of the triangulation was turned the right way when it was made, so
  // the number of edges of a simple planar graph bounds ours.
  CHECK(edges_of(graph) <= 3 * graph.n_nodes() - 6);
  for (const auto& t : arrangement.triangles())
    if (*std::min_element(t.node.begin(), t.node.end()) >= 0)
      CHECK(turn(graph.uv(t.node[0]), graph.uv(t.node[1]), graph.uv(t.node[2])) >= 0);
}

TEST_CASE("segments that overlap share their edges, and the stronger kind stays", "[arrangement]") {
  Arrangement arrangement({0, 0}, {4, 1});
  const int a = arrangement.insert_point({0, 0}), b = arrangement.insert_point({4, 0});
  const int c = arrangement.insert_point({1, 0}), d = arrangement.insert_point({3, 0});
  CHECK(arrangement.insert_segment(c, d, 2, 0));
  CHECK(arrangement.insert_segment(a, b, 1, 1));
  const PlanarGraph& graph = arrangement.graph();
  CHECK(edges_of(graph) == 3);
  CHECK(graph.edge(graph.find_edge(c, d)).kind == 2);
  CHECK(graph.edge(graph.find_edge(a, c)).kind == 1);
  CHECK(graph.find_edge(d, b) >= 0);
}

TEST_CASE("a point on a constraint splits it", "[arrangement]") {
  Arrangement arrangement({0, 0}, {4, 1});
  const int a = arrangement.insert_point({0, 0}), b = arrangement.insert_point({4, 0});
  arrangement.insert_segment(a, b, 1, 5);
  const int c = arrangement.insert_point({1, 0});
  CHECK(arrangement.insert_point({1, 0}) == c);
  const PlanarGraph& graph = arrangement.graph();
  CHECK(graph.find_edge(a, b) == -1);
  REQUIRE(graph.find_edge(a, c) >= 0);
  CHECK(graph.edge(graph.find_edge(c, b)).tag == 5);
}

TEST_CASE("the point index agrees with looking at every point", "[arrangement]") {
  std::mt19937 random(3);
  std::vector<Vec2d> points;
  for (int i = 0; i < 400; ++i)  // dense in one corner, as a conformal map has it
    points.emplace_back(std::pow(uniform(random), 6), std::pow(uniform(random), 6));
  std::vector<char> alive(points.size(), 1);
  PointIndex index(points, alive);
  size_t empty = 0;
  for (int round = 0; round < 6000; ++round) {
    const auto pick = [&] { return static_cast<int>(random() % points.size()); };
    const int a = pick(), b = pick(), c = pick();
    if (a == b || b == c || c == a) continue;
    bool expected = true;
    const auto& pa = points[static_cast<size_t>(a)];
    const auto& pb = points[static_cast<size_t>(b)];
    const auto& pc = points[static_cast<size_t>(c)];
    for (size_t p = 0; p < points.size(); ++p) {
      if (!alive[p] || static_cast<int>(p) == a || static_cast<int>(p) == b || static_cast<int>(p) == c)
        continue;
      const double s = turn(pa, pb, points[p]), t = turn(pb, pc, points[p]), u = turn(pc, pa, points[p]);
      if ((s >= 0 && t >= 0 && u >= 0) || (s <= 0 && t <= 0 && u <= 0)) expected = false;
    }
    CHECK(index.triangle_is_empty(a, b, c) == expected);
    empty += expected;
    if (round % 20 == 0) {
      index.remove(a);
      alive[static_cast<size_t>(a)] = 0;
    }
  }
  CHECK(empty > 100);  // both answers are there
}

TEST_CASE("the convex partition covers a star with convex pieces", "[arrangement]") {
  std::vector<Vec2d> star;
  for (int i = 0; i < 10; ++i) {
    const double angle = 0.1 + 3.14159265358979 * i / 5, radius = i % 2 ? 0.5 : 1.2;
    star.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  double whole = 0, sum = 0;
  const auto area = [](const std::vector<Vec2d>& p) {
    double a = 0;
    for (size_t i = 0; i < p.size(); ++i) a += 0.5 * turn({0, 0}, p[i], p[(i + 1) % p.size()]);
    return a;
  };
  whole = area(star);
  const size_t limit = GENERATE(0, 30);
  const auto pieces = convex_partition(star, limit);
  REQUIRE(!pieces.empty());
  if (limit > 0) CHECK(pieces.size() == 4);  // five reflex corners, two of them served by one cut
  for (const auto& piece : pieces) {
    std::vector<Vec2d> corners;
    for (const int i : piece) corners.push_back(star[static_cast<size_t>(i)]);
    for (size_t i = 0; i < corners.size(); ++i)
      CHECK(turn(corners[i], corners[(i + 1) % corners.size()], corners[(i + 2) % corners.size()]) > 0);
    sum += area(corners);
  }
  CHECK(sum == Approx(whole));
}

TEST_CASE("points put into a small triangulation leave it Delaunay and its outline as it was",
          "[arrangement]") {
  // An L, which is not convex, so that a walk to a point may leave it.
  std::vector<Vec2d> points{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  const std::vector<std::array<int, 3>> triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {3, 4, 5}};
  SmallTriangulation triangulation(points, triangles);
  std::mt19937 random(5);
  size_t inside = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec2d p = i == 0 ? Vec2d(0.5, 0.5) : Vec2d(2 * uniform(random), 2 * uniform(random));
    points.push_back(p);  // the first lies on an edge
    const bool in_shape = p[0] < 1 || p[1] < 1;
    const bool inserted = triangulation.insert(static_cast<int>(points.size()) - 1);
    CHECK(inserted == in_shape);
    if (!inserted) points.pop_back();
    inside += inserted;
  }
  CHECK(triangulation.triangles().size() == 4 + 2 * inside);
  double area = 0;
  for (int t = 0; t < static_cast<int>(triangulation.triangles().size()); ++t) {
    const auto& c = triangulation.triangles()[static_cast<size_t>(t)];
    const auto at = [&](int corner) { return points[static_cast<size_t>(corner)]; };
    CHECK(turn(at(c[0]), at(c[1]), at(c[2])) > 0);
    area += 0.5 * turn(at(c[0]), at(c[1]), at(c[2]));
    for (size_t k = 0; k < 3; ++k) {
      if (triangulation.neighbor(t, k) < 0 || !triangulation.can_flip(t, k)) continue;
      const auto angle = [&](const Vec2d& apex, const Vec2d& a, const Vec2d& b) {
        return std::atan2(std::abs(turn(apex, a, b)), (a - apex) | (b - apex));
      };
      const Vec2d a = at(c[(k + 1) % 3]), b = at(c[(k + 2) % 3]);
      CHECK(angle(at(c[k]), a, b) + angle(at(triangulation.across(t, k)), a, b) < 3.14159265358979 + 1e-6);
    }
  }
  CHECK(area == Approx(3));
}
