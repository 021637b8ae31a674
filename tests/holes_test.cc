#include "anisomesh/holes.hh"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "anisomesh/errors.hh"
#include "anisomesh/io.hh"
#include "anisomesh/shapes.hh"
#include "catch.hh"
#include "data.hh"

using namespace anisomesh;

namespace {

/// The mesh without these faces, cut open where the rest is not manifold, as read_surface() would do it.
OpenMesh::TriMesh without(const OpenMesh::TriMesh& mesh, const std::vector<int>& faces) {
  OpenMesh::TriMesh rest;
  rest.request_vertex_status();
  rest.request_edge_status();
  rest.request_face_status();
  for (const auto v : mesh.vertices()) rest.add_vertex(mesh.point(v));
  for (const auto f : mesh.faces()) {
    if (std::find(faces.begin(), faces.end(), f.idx()) != faces.end()) continue;
    std::vector<OpenMesh::VertexHandle> corners;
    for (const auto v : f.vertices()) corners.push_back(v);
    rest.add_face(corners);
  }
  return rest;
}

long euler(const OpenMesh::TriMesh& mesh) {
  return static_cast<long>(mesh.n_vertices()) - static_cast<long>(mesh.n_edges()) +
         static_cast<long>(mesh.n_faces());
}

size_t border_edges(const OpenMesh::TriMesh& mesh) {
  return static_cast<size_t>(
      std::count_if(mesh.edges_begin(), mesh.edges_end(), [](auto e) { return e.is_boundary(); }));
}

double area(const OpenMesh::TriMesh& mesh) {
  double sum = 0;
  for (const auto f : mesh.faces()) {
    const auto h = f.halfedge();
    const auto a = mesh.point(h.from()), b = mesh.point(h.to()), c = mesh.point(h.next().to());
    sum += 0.5 * ((b - a) % (c - a)).norm();
  }
  return sum;
}

/// Three faces, no two beside each other, around each of some vertices: holes that meet there.
std::vector<int> touching_faces(const OpenMesh::TriMesh& mesh) {
  std::vector<int> faces;
  for (int v = 0; v < static_cast<int>(mesh.n_vertices()); v += 40) {
    const OpenMesh::VertexHandle centre(v);
    if (mesh.valence(centre) < 6) continue;
    int i = 0;
    for (const auto f : mesh.vf_range(centre))
      if (i++ % 2 == 0 && i < 6) faces.push_back(f.idx());
  }
  return faces;
}

OpenMesh::TriMesh filled(OpenMesh::TriMesh mesh, size_t max_edges, FillReport& report) {
  FillOptions options;
  options.max_edges = max_edges;
  return fill_holes(mesh, options, &report);
}

}  // namespace

TEST_CASE("triangles that are missing come back, also where they touch", "[holes]") {
  for (const std::string name : {"sphere", "torus"}) {
    auto whole = make_shape(name, {2000, true});
    const auto missing = touching_faces(whole);
    REQUIRE(missing.size() > 50);
    FillReport report;
    const auto mesh = filled(without(whole, missing), 3, report);
    CHECK(report.closed == missing.size());
    CHECK(report.triangles == missing.size());
    CHECK(border_edges(mesh) == 0);
    CHECK(euler(mesh) == euler(whole));
    CHECK(area(mesh) == Approx(area(whole)).epsilon(1e-12));
    CHECK(report.left_long + report.left_folding + report.left_non_manifold == 0);
  }
}

TEST_CASE("a larger hole is closed with the triangles that its rim asks for", "[holes]") {
  auto whole = make_shape("sphere", {2000, true});
  std::vector<int> star;
  for (const auto f : whole.vf_range(OpenMesh::VertexHandle(100))) star.push_back(f.idx());
  auto holed = without(whole, star);
  holed.delete_isolated_vertices();
  holed.garbage_collection();
  FillReport report;
  auto left = filled(holed, star.size() - 1, report);
  CHECK(report.closed == 0);
  CHECK(report.left_long == 1);
  CHECK(border_edges(left) == star.size());
  left = filled(holed, star.size(), report);
  CHECK(report.closed == 1);
  CHECK(report.triangles == star.size() - 2);
  CHECK(border_edges(left) == 0);
  CHECK(euler(left) == 2);
  CHECK(area(left) < area(whole));
  CHECK(area(left) > 0.999 * area(whole));
}

TEST_CASE("a flat hole with a bay is filled without leaving it", "[holes]") {
  // The border of a plane is a rim too: what lies in it already covers it.
  auto plane = make_shape("plane", {400});
  std::vector<int> hole;
  for (const auto f : plane.faces()) {
    const auto h = f.halfedge();
    const Vec3d c = (plane.point(h.from()) + plane.point(h.to()) + plane.point(h.next().to())) / 3;
    Vec3d low(1e9, 1e9, 1e9), high(-1e9, -1e9, -1e9);
    for (const auto v : plane.vertices()) {
      low.minimize(plane.point(v));
      high.maximize(plane.point(v));
    }
    const double x = (c[0] - low[0]) / (high[0] - low[0]), y = (c[1] - low[1]) / (high[1] - low[1]);
    const bool box = x > 0.3 && x < 0.7 && y > 0.3 && y<0.7, bay = x> 0.5 && y > 0.5;
    if (box && !bay) hole.push_back(f.idx());
  }
  auto holed = without(plane, hole);
  holed.delete_isolated_vertices();
  holed.garbage_collection();
  FillReport report;
  const auto mesh = filled(holed, 60, report);
  CHECK(report.closed == 1);
  CHECK(area(mesh) == Approx(area(plane)).epsilon(1e-12));
  CHECK(euler(mesh) == 1);
}

TEST_CASE("what would fold or be no manifold is left and told", "[holes]") {
  OpenMesh::TriMesh triangle;
  for (const Vec3d& p : {Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0, 1, 0)}) triangle.add_vertex(p);
  triangle.add_face(OpenMesh::VertexHandle(0), OpenMesh::VertexHandle(1), OpenMesh::VertexHandle(2));
  FillReport report;
  const auto mesh = filled(triangle, 10, report);
  CHECK(mesh.n_faces() == 1);
  CHECK(report.closed == 0);
  CHECK(report.left_folding == 1);
}

TEST_CASE("features, and the numbers of faces and vertices, are kept", "[holes]") {
  auto cube = make_shape("cube", {600});
  auto holed = without(cube, {10, 200, 300});
  for (const auto e : holed.edges()) {
    const auto h = cube.find_halfedge(e.v0(), e.v1());
    holed.status(e).set_feature(cube.status(cube.edge_handle(h)).feature());
  }
  FillReport report;
  const auto mesh = filled(holed, 3, report);
  REQUIRE(report.closed == 3);
  REQUIRE(mesh.n_vertices() == cube.n_vertices());
  for (const auto v : cube.vertices()) CHECK(report.vertex_of[static_cast<size_t>(v.idx())] == v.idx());
  size_t features = 0;
  for (const auto e : mesh.edges()) {
    const auto h = cube.find_halfedge(e.v0(), e.v1());
    REQUIRE(h.is_valid());
    CHECK(mesh.status(e).feature() == cube.status(cube.edge_handle(h)).feature());
    features += mesh.status(e).feature();
  }
  CHECK(features > 20);
  const SurfaceRef before = holed;
  auto copy = mesh;
  const SurfaceRef after = copy;
  for (int f = 0; f < static_cast<int>(holed.n_faces()); ++f)
    for (int i = 0; i < 3; ++i)
      CHECK(before.corners(OpenMesh::FaceHandle(f)).vertex[i] ==
            after.corners(OpenMesh::FaceHandle(f)).vertex[i]);
}

TEST_CASE("a number of edges out of range is refused", "[holes]") {
  auto mesh = make_shape("dome", {100});
  for (const size_t edges : {size_t(1), size_t(2), size_t(1001)}) {
    FillOptions options;
    options.max_edges = edges;
    CHECK_THROWS_AS(fill_holes(mesh, options), InvalidOption);
  }
}

TEST_CASE("the pig gets its 432 triangles back", "[holes]") {
  const auto path = demo_mesh("pig.stl");
  if (!path) return skip("pig.stl");
  FillReport report;
  const auto mesh = filled(read_surface(*path), 3, report);
  CHECK(report.closed == 432);
  CHECK(border_edges(mesh) == 0);
  CHECK(mesh.n_faces() == 16848 + 432);
  CHECK(mesh.n_vertices() == 8642);
  CHECK(euler(mesh) == 2);
}
