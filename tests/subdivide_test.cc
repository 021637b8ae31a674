#include "anisomesh/subdivide.hh"

#include <cmath>

#include "anisomesh/errors.hh"
#include "anisomesh/mesher.hh"
#include "anisomesh/properties.hh"
#include "catch.hh"

using namespace anisomesh;

namespace {

OpenMesh::PolyMesh grid(int n, bool triangles) {
  OpenMesh::PolyMesh mesh;
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.add_vertex(OpenMesh::Vec3d(i, j, 0));
  const auto at = [n](int i, int j) { return OpenMesh::VertexHandle(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      if (!triangles) {
        mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        continue;
      }
      mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.add_face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  return mesh;
}

OpenMesh::PolyMesh cube() {
  OpenMesh::PolyMesh mesh;
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  for (int i = 0; i < 8; ++i) mesh.add_vertex(OpenMesh::Vec3d(i & 1, (i >> 1) & 1, i >> 2));
  const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : faces) {
    std::vector<OpenMesh::VertexHandle> corners;
    for (const int v : f) corners.emplace_back(v);
    mesh.add_face(corners);
  }
  return mesh;
}

double height_after(OpenMesh::PolyMesh mesh, OpenMesh::VertexHandle raised, OpenMesh::VertexHandle asked) {
  mesh.point(raised)[2] = 1;
  return subdivide(mesh, 1).point(asked)[2];
}

}  // namespace

TEST_CASE("regular quads and triangles subdivide by the known masks", "[subdivide]") {
  const OpenMesh::VertexHandle middle(12), beside(13), diagonal(18);  // of a grid of 5 x 5 vertices
  // Bicubic B-splines: (1, 6, 1) / 8 both ways.
  const auto quads = grid(4, false);
  CHECK(height_after(quads, middle, middle) == Approx(36.0 / 64));
  CHECK(height_after(quads, beside, middle) == Approx(6.0 / 64));
  CHECK(height_after(quads, diagonal, middle) == Approx(1.0 / 64));
  // Loop: five eighths of the vertex, a sixteenth of each of the six around it.
  const auto triangles = grid(4, true);
  CHECK(height_after(triangles, middle, middle) == Approx(10.0 / 16));
  CHECK(height_after(triangles, beside, middle) == Approx(1.0 / 16));
  CHECK(height_after(triangles, diagonal, middle) == Approx(1.0 / 16));
}

TEST_CASE("every level has four times the faces, and quads remain quads", "[subdivide]") {
  const auto quads = subdivide(grid(3, false), 2);
  CHECK(quads.n_faces() == 9 * 16);
  const auto triangles = subdivide(grid(3, true), 2);
  CHECK(triangles.n_faces() == 18 * 16);
  for (const auto f : quads.faces()) CHECK(quads.valence(f) == 4);
  for (const auto f : triangles.faces()) CHECK(triangles.valence(f) == 3);
  OpenMesh::PolyMesh pentagon;
  std::vector<OpenMesh::VertexHandle> ring;
  for (int i = 0; i < 5; ++i)
    ring.push_back(pentagon.add_vertex({std::cos(0.4 * M_PI * i), std::sin(0.4 * M_PI * i), 0}));
  pentagon.add_face(ring);
  CHECK(subdivide(pentagon, 1).n_faces() == 5);
}

TEST_CASE("a cube becomes round, and keeps its features when they are tagged", "[subdivide]") {
  auto mesh = cube();
  const auto round = subdivide(mesh, 4);
  double least = 9, most = 0;
  for (const auto v : round.vertices()) {
    const double r = (round.point(v) - OpenMesh::Vec3d(0.5, 0.5, 0.5)).norm();
    least = std::min(least, r), most = std::max(most, r);
  }
  CHECK(most < 0.6);  // half a diagonal is 0.87
  CHECK(most / least < 1.25);
  for (const auto e : mesh.edges()) mesh.status(e).set_feature(true);
  const auto sharp = subdivide(mesh, 3);
  for (const auto v : sharp.vertices()) {
    const OpenMesh::Vec3d p = sharp.point(v) - OpenMesh::Vec3d(0.5, 0.5, 0.5);
    CHECK(std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}) == Approx(0.5));
  }
  size_t features = 0;
  for (const auto e : sharp.edges()) features += sharp.status(e).feature();
  CHECK(features == 12 * 8);
}

TEST_CASE("a border is a B-spline, and what build_polygons() calls a corner stays", "[subdivide]") {
  auto mesh = grid(2, false);
  CHECK(subdivide(mesh, 1).point(OpenMesh::VertexHandle(0))[0] == Approx(0.125));
  const auto origin = provide_property(mesh, property::origin);
  for (const auto v : mesh.vertices()) mesh.property(origin, v) = static_cast<int>(Origin::border);
  mesh.property(origin, OpenMesh::VertexHandle(0)) = static_cast<int>(Origin::corner);
  const auto fine = subdivide(mesh, 3);
  CHECK(fine.point(OpenMesh::VertexHandle(0)).norm() == 0);
  for (const auto v : fine.vertices()) CHECK(fine.point(v)[2] == 0);
  CHECK_THROWS_AS(subdivide(mesh, 9), InvalidOption);
  CHECK_THROWS_AS(subdivide(OpenMesh::PolyMesh(), 1), InvalidInput);
  CHECK_THROWS_AS(subdivide(grid(60, false), 8), InvalidOption);  // 200,000,000 faces
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  mesh.delete_face(OpenMesh::FaceHandle(0));
  CHECK_THROWS_WITH(subdivide(mesh, 1), Catch::Contains("garbage_collection"));
}
