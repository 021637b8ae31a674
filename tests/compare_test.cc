#include "anisomesh/compare.hh"

#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <cmath>
#include <functional>

#include "anisomesh/properties.hh"
#include "catch.hh"

using namespace anisomesh;
using OpenMesh::PolyMesh;
using OpenMesh::TriMesh;

namespace {

const double pi = std::acos(-1.0);
using Map = std::function<Vec3d(double, double)>;

/// A grid of n x m quads over [0, 1]^2, its corners where `map` says; the last column joins the first if
/// closed.
PolyMesh quad_grid(int n, int m, const Map& map, bool closed = false) {
  PolyMesh mesh;
  std::vector<OpenMesh::VertexHandle> vertices;
  const int columns = closed ? n : n + 1;
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i < columns; ++i)
      vertices.push_back(mesh.add_vertex(map(static_cast<double>(i) / n, static_cast<double>(j) / m)));
  const auto at = [&](int i, int j) { return vertices[static_cast<size_t>(j * columns + i % columns)]; };
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  return mesh;
}

TriMesh triangulated(const PolyMesh& polygons) {
  TriMesh mesh;
  for (const auto v : polygons.vertices()) mesh.add_vertex(polygons.point(v));
  for (const auto f : polygons.faces()) {
    std::vector<OpenMesh::VertexHandle> corners;
    for (const auto v : polygons.fv_range(f)) corners.push_back(v);
    for (size_t i = 1; i + 1 < corners.size(); ++i) mesh.add_face(corners[0], corners[i], corners[i + 1]);
  }
  return mesh;
}

PolyMesh as_polygons(const TriMesh& triangles) {
  PolyMesh mesh;
  for (const auto v : triangles.vertices()) mesh.add_vertex(triangles.point(v));
  for (const auto f : triangles.faces()) {
    std::vector<OpenMesh::VertexHandle> corners;
    for (const auto v : triangles.fv_range(f)) corners.push_back(v);
    mesh.add_face(corners);
  }
  return mesh;
}

PolyMesh polygons(const std::vector<Vec3d>& points, const std::vector<std::vector<int>>& faces) {
  PolyMesh mesh;
  for (const auto& p : points) mesh.add_vertex(p);
  for (const auto& face : faces) {
    std::vector<OpenMesh::VertexHandle> corners;
    for (const int i : face) corners.emplace_back(i);
    mesh.add_face(corners);
  }
  return mesh;
}

Vec3d flat(double u, double v) { return {u, v, 0}; }
Vec3d on_unit_sphere(double u, double v) {
  // A belt that stays away from the poles, so that every face is a quad of the same latitude band.
  const double latitude = (v - 0.5) * 0.9 * pi;
  return {std::cos(latitude) * std::cos(2 * pi * u), std::cos(latitude) * std::sin(2 * pi * u),
          std::sin(latitude)};
}
/// Another belt, whose corners are in no symmetric place of the first: no nearest point is a tie.
Vec3d on_unit_sphere_askew(double u, double v) {
  return on_unit_sphere(u + 0.0123 + 0.03 * v * v, 0.01 + 0.97 * v + 0.01 * std::sin(2 * pi * u));
}
Vec3d on_cylinder(double u, double v) { return {std::cos(2 * pi * u), std::sin(2 * pi * u), 3 * v}; }

/// Curvature of the unit cylinder around z, as estimate_curvature() would leave it.
void put_cylinder_curvature(TriMesh& mesh) {
  const auto k_min = provide_property(mesh, property::k_min), k_max = provide_property(mesh, property::k_max);
  const auto gamma_min = provide_property(mesh, property::gamma_min),
             gamma_max = provide_property(mesh, property::gamma_max);
  for (const auto v : mesh.vertices()) {
    const auto p = mesh.point(v);
    mesh.property(k_min, v) = 0;
    mesh.property(k_max, v) = 1;
    mesh.property(gamma_min, v) = Vec3d(0, 0, 1);
    mesh.property(gamma_max, v) = Vec3d(-p[1], p[0], 0).normalized();
  }
}

template <class Mesh>
void transform(Mesh& mesh, double scale, double angle, const Vec3d& shift) {
  for (const auto v : mesh.vertices()) {
    const auto p = mesh.point(v);
    const double c = std::cos(angle), s = std::sin(angle);
    mesh.set_point(v, scale * Vec3d(c * p[0] - s * p[2], p[1], s * p[0] + c * p[2]) + shift);
  }
}

}  // namespace

TEST_CASE("a mesh lies on itself and is whole", "[compare]") {
  auto reference = triangulated(quad_grid(48, 24, on_unit_sphere, true));
  auto result = as_polygons(reference);
  const Comparison c = compare(reference, result);
  CHECK(c.two_sided.hausdorff < 1e-12);
  CHECK(c.two_sided.rms < 1e-12);
  CHECK(c.mean_normal_deviation_degrees < 1e-6);
  CHECK(c.same_topology);
  CHECK(c.components == 1);
  CHECK(c.euler_characteristic == 0);  // an annulus
  CHECK(c.border_loops == 2);
  CHECK(c.folded_faces == 0);
  CHECK(c.t_junctions == 0);
  CHECK(c.non_manifold_edges + c.non_manifold_vertices + c.degenerate_faces + c.concave_faces == 0);
  CHECK(c.quad_fraction == 0);
  CHECK(c.faces_by_degree == std::map<int, size_t>{{3, reference.n_faces()}});
}

TEST_CASE("a bent quad has one normal, and its surface those of the two triangles it is split into",
          "[compare]") {
  // Folded along its shorter diagonal, each half 20 degrees off the mean plane.
  const double along = std::cos(20 * pi / 180), down = -std::sin(20 * pi / 180);
  const std::vector<Vec3d> folded{{-0.6, 0, 0}, {0, -along, down}, {0.6, 0, 0}, {0, along, down}};
  PolyMesh quad = polygons(folded, {{0, 1, 2, 3}});
  auto reference = triangulated(polygons(folded, {{0, 1, 2}, {0, 2, 3}}));
  const Comparison c = compare(reference, quad);
  CHECK(c.two_sided.hausdorff < 1e-12);
  CHECK(c.mean_surface_normal_deviation_degrees < 1e-6);
  CHECK(c.mean_normal_deviation_degrees == Approx(20).epsilon(0.01));
}

TEST_CASE("a lifted plane is as far away as it was lifted", "[compare]") {
  auto reference = triangulated(quad_grid(7, 5, flat));
  const double height = 0.03;
  auto result = quad_grid(3, 4, [&](double u, double v) { return Vec3d(u, v, height); });
  const Comparison c = compare(reference, result);
  const double expected = height / std::sqrt(2.0);
  for (const Distances& d : {c.to_reference, c.from_reference, c.two_sided}) {
    CHECK(d.mean == Approx(expected).epsilon(1e-12));
    CHECK(d.rms == Approx(expected).epsilon(1e-12));
    CHECK(d.hausdorff == Approx(expected).epsilon(1e-12));
  }
  CHECK(c.p99_fraction == Approx(expected).epsilon(1e-12));
  CHECK(c.quad_fraction == 1);
  CHECK(c.max_planarity < 1e-12);
  PolyMesh& measured = result;
  const auto error = require_property(measured, property::error);
  for (const auto v : measured.vertices()) CHECK(measured.property(error, v) == Approx(height));
}

TEST_CASE("a prism in a cylinder has the distances of its chords", "[compare]") {
  // A chord over the angle 2a of the unit circle, at t in [-sin a, sin a]: nearest point of the circle at
  // 1 - sqrt(cos^2 a + t^2).
  const int sides = 12;
  const double a = pi / sides;
  auto reference = triangulated(quad_grid(2400, 30, on_cylinder, true));
  auto result = quad_grid(sides, 1, on_cylinder, true);
  const Comparison c = compare(reference, result);
  double mean = 0, square = 0;
  const int steps = 100000;
  for (int i = 0; i < steps; ++i) {
    const double t = (i + 0.5) / steps * std::sin(a), d = 1 - std::hypot(std::cos(a), t);
    mean += d / steps;
    square += d * d / steps;
  }
  const double diagonal = std::sqrt(4 + 4 + 9.0);
  CHECK(c.to_reference.mean == Approx(mean / diagonal).epsilon(0.005));
  CHECK(c.to_reference.rms == Approx(std::sqrt(square) / diagonal).epsilon(0.005));
  CHECK(c.two_sided.hausdorff == Approx((1 - std::cos(a)) / diagonal).epsilon(0.005));
  // The normal of a chord differs from the circle's by the angle along it: on average half of a, in the angle
  // asin(t), which is even closer to uniform.
  CHECK(c.mean_normal_deviation_degrees == Approx(a / 2 * 180 / pi).epsilon(0.01));
}

TEST_CASE("distances both ways see what is missing", "[compare]") {
  auto reference = triangulated(quad_grid(20, 20, flat));
  auto result = quad_grid(5, 10, [](double u, double v) { return Vec3d(u / 2, v, 0); });
  const Comparison c = compare(reference, result);
  CHECK(c.to_reference.hausdorff < 1e-12);
  CHECK(c.from_reference.hausdorff == Approx(0.5 / std::sqrt(2.0)));
  CHECK(c.from_reference.mean == Approx(0.125 / std::sqrt(2.0)).epsilon(0.01));
  CHECK(c.from_reference.rms == Approx(std::sqrt(1 / 24.0) / std::sqrt(2.0)).epsilon(0.01));
  CHECK(c.two_sided.hausdorff == c.from_reference.hausdorff);
}

TEST_CASE("the longer diagonal of a saddle quad is another surface", "[compare]") {
  // Corners of z = x y h on a rectangle of 2 x 1 are coplanar with neither diagonal; both are equally long, a
  // sheared one is not.
  auto result = polygons({{0, 0, 0}, {1, 0, 0}, {1.5, 1, 0.2}, {0.5, 1, 0}}, {{0, 1, 2, 3}});
  auto shorter =
      triangulated(polygons({{0, 0, 0}, {1, 0, 0}, {1.5, 1, 0.2}, {0.5, 1, 0}}, {{0, 1, 3}, {1, 2, 3}}));
  CompareOptions options;
  CHECK(compare(shorter, result, options).two_sided.hausdorff < 1e-12);
  options.diagonal = FaceDiagonal::longer;
  CHECK(compare(shorter, result, options).two_sided.hausdorff > 0.01);
}

TEST_CASE("edges along a cylinder's axis and circles are aligned, diagonal ones by 45 degrees", "[compare]") {
  auto reference = triangulated(quad_grid(240, 60, on_cylinder, true));
  put_cylinder_curvature(reference);
  auto along = quad_grid(60, 20, on_cylinder, true);
  CHECK(compare(reference, along).mean_alignment_degrees < 1e-6);
  // Quads turned by 45 degrees: corners advance by the same length around and along.
  const double step = 2 * pi / 120;
  auto across = quad_grid(120, 40, [&](double u, double v) {
    const double s = 2 * pi * u, t = 40 * v * step;
    return Vec3d(std::cos((s + t) / 2 / 2), std::sin((s + t) / 2 / 2), 1.5 + (s - t) / 2 / 2);
  });
  CHECK(compare(reference, across).mean_alignment_degrees == Approx(45).margin(0.3));
  auto bare = triangulated(quad_grid(240, 60, on_cylinder, true));
  CHECK(compare(bare, along).mean_alignment_degrees == 0);
}

TEST_CASE("edges in every direction are 22.5 degrees off by chance", "[compare]") {
  auto reference = triangulated(quad_grid(240, 60, on_cylinder, true));
  put_cylinder_curvature(reference);
  PolyMesh fans;  // small triangles, each turned by another angle
  const int count = 360;
  for (int i = 0; i < count; ++i) {
    const double turn = 2 * pi * i / count, centre = 2 * pi * i / count;
    std::vector<OpenMesh::VertexHandle> corners;
    for (int k = 0; k < 3; ++k) {
      const double angle = turn + 2 * pi * k / 3;
      corners.push_back(
          fans.add_vertex(Vec3d(std::cos(centre + 0.005 * std::cos(angle)),
                                std::sin(centre + 0.005 * std::cos(angle)), 1.5 + 0.005 * std::sin(angle))));
    }
    fans.add_face(corners);
  }
  CHECK(compare(reference, fans).mean_alignment_degrees == Approx(22.5).margin(0.3));
}

TEST_CASE("quads with the aspect of equation 7 have no aspect error", "[compare]") {
  // A flat grid with made-up curvature k = (1, 4): aspect sqrt(4 / 1) = 2 along gamma_min = x.
  auto reference = triangulated(quad_grid(4, 4, flat));
  const auto k_min = provide_property(reference, property::k_min),
             k_max = provide_property(reference, property::k_max);
  const auto gamma_min = provide_property(reference, property::gamma_min),
             gamma_max = provide_property(reference, property::gamma_max);
  for (const auto v : reference.vertices()) {
    reference.property(k_min, v) = 1;
    reference.property(k_max, v) = 4;
    reference.property(gamma_min, v) = Vec3d(1, 0, 0);
    reference.property(gamma_max, v) = Vec3d(0, 1, 0);
  }
  auto fitting = quad_grid(5, 10, flat), square = quad_grid(5, 5, flat), across = quad_grid(10, 5, flat);
  CHECK(compare(reference, fitting).aspect_ratio_error < 1e-9);
  CHECK(compare(reference, square).aspect_ratio_error == Approx(1));
  CHECK(compare(reference, across).aspect_ratio_error == Approx(2));
}

TEST_CASE("folded faces are counted", "[compare]") {
  auto reference = triangulated(quad_grid(10, 10, flat));
  SECTION("an upside-down sheet is folded everywhere") {
    auto result = quad_grid(4, 4, [](double u, double v) { return Vec3d(v, u, 0); });
    CHECK(compare(reference, result).folded_faces == 16);
  }
  SECTION("one quad drawn over its neighbour") {
    // The middle column of corners is moved past the right one: the quads on its right lie upside down.
    auto result = quad_grid(4, 1, [](double u, double v) { return Vec3d(u == 0.5 ? 0.8 : u, v, 0); });
    CHECK(compare(reference, result).folded_faces == 1);
  }
  SECTION("one quad drawn over its neighbour on a plate whose other side is near") {
    const auto plate = [](int n, double middle) {
      auto mesh = quad_grid(n, 1, [&](double u, double v) { return Vec3d(u == 0.5 ? middle : u, v, 0); });
      const auto below = quad_grid(n, 1, [](double u, double v) { return Vec3d(v, u, -0.02); });
      std::vector<OpenMesh::VertexHandle> there;
      for (const auto v : below.vertices()) there.push_back(mesh.add_vertex(below.point(v)));
      for (const auto f : below.faces()) {
        std::vector<OpenMesh::VertexHandle> corners;
        for (const auto v : f.vertices()) corners.push_back(there[static_cast<size_t>(v.idx())]);
        mesh.add_face(corners);
      }
      return mesh;
    };
    auto sides = triangulated(plate(10, 0.5));
    auto right = plate(4, 0.5), wrong = plate(4, 0.8);
    CHECK(compare(sides, right).folded_faces == 0);
    CHECK(compare(sides, wrong).folded_faces == 1);
  }
}

TEST_CASE("faces that cross or overlap others are counted", "[compare]") {
  auto reference = triangulated(quad_grid(10, 10, flat));
  auto clean = quad_grid(4, 4, flat);
  CHECK(compare(reference, clean).self_intersecting_faces == 0);
  SECTION("a flat sheet that lies over itself in part") {
    // Three quads on the left, the last column of corners moved back over the third.
    auto result = quad_grid(4, 1, [](double u, double v) { return Vec3d(u == 1 ? 0.6 : u, v, 0); });
    const auto c = compare(reference, result);
    CHECK(c.self_intersecting_faces == 2);
    CHECK(c.to_reference.hausdorff < 1e-12);
  }
  SECTION("two squares that cross, and one apart") {
    auto result = polygons({{0, 0, 0},
                            {1, 0, 0},
                            {1, 1, 0},
                            {0, 1, 0},
                            {0.5, 0.2, -1},
                            {0.5, 0.8, -1},
                            {0.5, 0.8, 1},
                            {0.5, 0.2, 1},
                            {2, 0, 0},
                            {3, 0, 0},
                            {3, 1, 0}},
                           {{0, 1, 2, 3}, {4, 5, 6, 7}, {8, 9, 10}});
    CHECK(compare(reference, result).self_intersecting_faces == 2);
  }
  SECTION("faces that only share corners at the same place do not count") {
    auto result = polygons({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0}},
                           {{0, 1, 2}, {3, 4, 5}});
    CHECK(compare(reference, result).self_intersecting_faces == 0);
  }
}

TEST_CASE("both sides of a thin sheet are right, wherever the nearest point lies", "[compare]") {
  // A sheet as thin as 1/200 of its width, closed over its upper rim; the result is coarser and off by more
  // than the sheet is thick, so that nearest points are on the wrong side.
  const auto sheet = [](double bulge) {
    return [bulge](double u, double v) {
      const double side = u < 0.5 ? -1 : 1, x = std::abs(u - 0.5) * 2;
      return Vec3d(side * 0.0025 + side * bulge * std::sin(pi * x), x, v);
    };
  };
  auto reference = triangulated(quad_grid(81, 40, sheet(0)));
  auto result = quad_grid(21, 10, sheet(-0.006));
  CHECK(compare(reference, result).folded_faces == 0);
}

TEST_CASE("concave, star-shaped and degenerate faces are counted", "[compare]") {
  auto reference = triangulated(quad_grid(2, 2, flat));
  auto dart = polygons({{0, 0, 0}, {1, 0, 0}, {0.2, 0.2, 0}, {0, 1, 0}}, {{0, 1, 2, 3}});
  CHECK(compare(reference, dart).concave_faces == 1);
  CHECK(compare(reference, dart).to_reference.hausdorff < 1e-12);
  // A corner that turns back by 4 degrees is within the tolerance, by 6 degrees not.
  const auto bent = [](double degrees) {
    const double dip = 0.5 * std::tan(degrees / 2 * pi / 180);
    return polygons({{0, 0, 0}, {0.5, dip, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3, 4}});
  };
  auto four = bent(4), six = bent(6);
  CHECK(compare(reference, four).concave_faces == 0);
  CHECK(compare(reference, six).concave_faces == 1);
  std::vector<Vec3d> star;
  for (int i = 0; i < 5; ++i) star.emplace_back(std::cos(0.8 * pi * i), std::sin(0.8 * pi * i), 0);
  auto pentagram = polygons(star, {{0, 1, 2, 3, 4}});
  CHECK(compare(reference, pentagram).concave_faces == 1);
  auto needle = polygons({{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  CHECK(compare(reference, needle).degenerate_faces == 1);
}

TEST_CASE("a vertex on the edge of another face is a T-junction", "[compare]") {
  auto reference = triangulated(quad_grid(2, 2, flat));
  auto result = polygons(
      {{0, 0, 0}, {0.5, 0, 0}, {0.5, 1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 0.5, 0}, {0.5, 0.5, 0}, {1, 1, 0}},
      {{0, 1, 2, 3}, {1, 4, 5, 6}, {6, 5, 7, 2}});
  const Comparison c = compare(reference, result);
  CHECK(c.t_junctions == 1);
  CHECK(c.border_loops == 2);  // the slit beside the long edge is a border of its own
  CHECK_FALSE(c.same_topology);
  auto conforming = quad_grid(4, 3, flat);
  CHECK(compare(reference, conforming).t_junctions == 0);
}

TEST_CASE("non-manifold elements are found although OpenMesh has split them", "[compare]") {
  auto reference = triangulated(quad_grid(2, 2, flat));
  SECTION("three faces at an edge") {
    auto fin = polygons({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, 0}, {0, 1, 0}},
                        {{0, 2, 1}, {0, 1, 3}, {5, 6, 4}});
    CHECK(compare(reference, fin).non_manifold_edges == 1);
  }
  SECTION("two fans at a vertex") {
    auto bow_tie =
        polygons({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
    CHECK(compare(reference, bow_tie).non_manifold_vertices == 1);
    auto split = polygons({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {-1, 0, 0}, {0, -1, 0}},
                          {{0, 1, 2}, {3, 4, 5}});
    const Comparison c = compare(reference, split);
    CHECK(c.non_manifold_vertices == 1);
    CHECK(c.components == 2);
    CHECK_FALSE(c.same_topology);
  }
}

TEST_CASE("figures do not depend on size, place or direction", "[compare]") {
  auto reference = triangulated(quad_grid(60, 30, on_unit_sphere, true));
  put_cylinder_curvature(reference);
  auto result = quad_grid(17, 9, on_unit_sphere_askew, true);
  const Comparison a = compare(reference, result);
  const double scale = GENERATE(1e-6, 1e6);
  transform(reference, scale, 0, Vec3d(0, 0, 0));
  transform(result, scale, 0, Vec3d(0, 0, 0));
  const Comparison b = compare(reference, result);
  CHECK(b.two_sided.rms == Approx(a.two_sided.rms).epsilon(1e-9));
  CHECK(b.two_sided.hausdorff == Approx(a.two_sided.hausdorff).epsilon(1e-9));
  CHECK(b.mean_alignment_degrees == Approx(a.mean_alignment_degrees).epsilon(1e-9));
  CHECK(b.folded_faces == a.folded_faces);
  CHECK(b.concave_faces == a.concave_faces);
}

TEST_CASE("turning both meshes turns nothing else", "[compare]") {
  auto reference = triangulated(quad_grid(60, 30, on_unit_sphere, true));
  auto result = quad_grid(17, 9, on_unit_sphere_askew, true);
  const Comparison a = compare(reference, result);
  const double diagonal = SurfaceRef(reference).diagonal();
  transform(reference, 1, 0.7, Vec3d(10, -20, 30));
  transform(result, 1, 0.7, Vec3d(10, -20, 30));
  const Comparison b = compare(reference, result);
  const double turned = SurfaceRef(reference).diagonal();
  CHECK(b.two_sided.rms * turned == Approx(a.two_sided.rms * diagonal).epsilon(1e-6));
  CHECK(b.two_sided.hausdorff * turned == Approx(a.two_sided.hausdorff * diagonal).epsilon(1e-6));
  CHECK(b.mean_normal_deviation_degrees == Approx(a.mean_normal_deviation_degrees).epsilon(1e-6));
}

TEST_CASE("what cannot be compared is refused", "[compare]") {
  auto reference = triangulated(quad_grid(2, 2, flat));
  PolyMesh empty;
  CHECK_THROWS_AS(compare(reference, empty), InvalidInput);
  auto result = quad_grid(1, 1, flat);
  result.set_point(OpenMesh::VertexHandle(2), {std::nan(""), 0, 0});
  CHECK_THROWS_WITH(compare(reference, result), Catch::Contains("vertex 2"));
  auto good = quad_grid(1, 1, flat);
  CompareOptions options;
  options.samples = 10;
  CHECK_THROWS_AS(compare(reference, good, options), InvalidOption);
  CHECK_THROWS_AS(compare(reference, good, {}, [](double) { return false; }), Cancelled);
  CHECK_FALSE(has_property(good, property::error));
}

TEST_CASE("a wall beside a flat face does not make right what is turned over there", "[compare]") {
  // A tall box, a little narrower below: its walls face down by half a degree.
  const auto box = [](auto& mesh) {
    std::vector<OpenMesh::VertexHandle> v;
    for (const double z : {0.0, 2.0})
      for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
        const double wide = z > 0 ? 1 : 0.98;
        v.push_back(mesh.add_vertex(Vec3d(0.5 + wide * (x - 0.5), 0.5 + wide * (y - 0.5), z)));
      }
    mesh.add_face(std::vector<OpenMesh::VertexHandle>{v[3], v[2], v[1], v[0]});
    for (size_t i = 0; i < 4; ++i)
      mesh.add_face(std::vector<OpenMesh::VertexHandle>{v[i], v[(i + 1) % 4], v[4 + (i + 1) % 4], v[4 + i]});
    return v;
  };
  OpenMesh::TriMesh reference;
  const auto r = box(reference);
  reference.add_face(std::vector<OpenMesh::VertexHandle>{r[4], r[5], r[6], r[7]});
  OpenMesh::PolyMesh result;
  const auto v = box(result);
  const auto beyond = result.add_vertex(Vec3d(1.3, 0.5, 2));
  result.add_face(std::vector<OpenMesh::VertexHandle>{v[4], v[5], beyond, v[6], v[7]});
  result.add_face(std::vector<OpenMesh::VertexHandle>{v[5], v[6], beyond});
  CHECK(compare(reference, result).folded_faces == 1);
}
