// Files that have vertices twice: what is counted, what is joined, what stays apart.
#include <fstream>
#include <iomanip>
#include <sstream>

#include "anisomesh/io.hh"
#include "anisomesh/shapes.hh"
#include "catch.hh"
#include "data.hh"

using namespace anisomesh;

namespace {

/// A torus of loose triangles: every corner written on its own and moved by up to `noise` in each
/// coordinate, every third face turned over.
std::string loose_faces(const OpenMesh::TriMesh& mesh, double noise) {
  std::ostringstream text;
  text << "OFF\n" << 3 * mesh.n_faces() << ' ' << mesh.n_faces() << " 0\n" << std::setprecision(17);
  int sign = 1;
  for (const auto f : mesh.faces())
    for (const auto v : mesh.fv_range(f)) {
      sign = -sign;
      for (int i = 0; i < 3; ++i) text << mesh.point(v)[i] + sign * noise << (i < 2 ? ' ' : '\n');
    }
  for (size_t f = 0; f < mesh.n_faces(); ++f) {
    const bool turned = f % 3 == 0;
    text << "3 " << 3 * f << ' ' << 3 * f + (turned ? 2 : 1) << ' ' << 3 * f + (turned ? 1 : 2) << '\n';
  }
  return text.str();
}

struct Reading {
  ReadReport report;
  OpenMesh::TriMesh mesh;
};

Reading read(const std::string& text, double weld_fraction) {
  const TemporaryFolder folder;
  std::ofstream(folder / "in.off") << text;
  Reading result;
  ReadOptions options;
  options.weld_fraction = weld_fraction;
  result.mesh = read_surface(folder / "in.off", &result.report, options);
  return result;
}

int euler(const OpenMesh::TriMesh& mesh) {
  return static_cast<int>(mesh.n_vertices() + mesh.n_faces()) - static_cast<int>(mesh.n_edges());
}

/// `n` triangles that all have the edge from (0, 0, 0) to (1, 0, 0), with corners of their own.
std::string sheets_at_an_edge(int n) {
  std::ostringstream text;
  text << "OFF\n" << 3 * n << ' ' << n << " 0\n";
  for (int i = 0; i < n; ++i) text << "0 0 0\n1 0 0\n0 " << 1 - i << ' ' << i << '\n';
  for (int i = 0; i < n; ++i) text << "3 " << 3 * i << ' ' << 3 * i + 1 << ' ' << 3 * i + 2 << '\n';
  return text.str();
}

}  // namespace

TEST_CASE("a torus of loose triangles is a torus when it is welded", "[io][weld]") {
  ShapeOptions options;
  options.vertices = 400;
  const auto torus = make_shape("torus", options);
  for (const double noise : {0.0, 1e-8}) {
    INFO(noise);
    const std::string text = loose_faces(torus, noise);
    const auto open = read(text, 0);
    CHECK(open.mesh.n_vertices() == 3 * torus.n_faces());
    CHECK(open.report.coincident_edges == torus.n_edges());
    CHECK(open.report.welded_vertices == 0);
    const auto welded = read(text, 1e-6);
    CHECK(welded.mesh.n_vertices() == torus.n_vertices());
    CHECK(welded.mesh.n_edges() == torus.n_edges());
    CHECK(euler(welded.mesh) == 0);
    CHECK(welded.report.welded_vertices == 3 * torus.n_faces() - torus.n_vertices());
    CHECK(welded.report.isolated_vertices == 0);
    CHECK(welded.report.coincident_edges == 0);
    CHECK(welded.report.reoriented_faces > 0);
    // Every corner of the file is at the vertex that it says it has become.
    REQUIRE(welded.report.vertex_of.size() == 3 * torus.n_faces());
    size_t corner = 0;
    for (const auto f : torus.faces())
      for (const auto v : torus.fv_range(f)) {
        const OpenMesh::VertexHandle became(welded.report.vertex_of[corner++]);
        CHECK((welded.mesh.point(became) - torus.point(v)).norm() <= 4 * noise);
      }
  }
}

TEST_CASE("what is farther apart than asked for is not welded", "[io][weld]") {
  ShapeOptions options;
  options.vertices = 400;
  const auto torus = make_shape("torus", options);
  const auto apart = read(loose_faces(torus, 1e-3), 1e-6);
  CHECK(apart.report.welded_vertices == 0);
  CHECK(apart.report.vertex_of.empty());
  CHECK(euler(read(loose_faces(torus, 1e-3), 5e-3).mesh) == 0);
}

TEST_CASE("sheets are welded along an edge only where two meet", "[io][weld]") {
  const auto two = read(sheets_at_an_edge(2), 1e-6);
  CHECK(two.report.welded_vertices == 2);
  CHECK(two.mesh.n_edges() == 5);
  const auto three = read(sheets_at_an_edge(3), 1e-6);
  CHECK(three.report.welded_vertices == 0);
  CHECK(three.mesh.n_edges() == 9);
  // Two triangles that touch in a corner have no edge to be joined along.
  const auto corner =
      read("OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 0\n-1 0 0\n0 -1 0\n3 0 1 2\n3 3 4 5\n", 1e-6);
  CHECK(corner.report.welded_vertices == 0);
  CHECK(corner.mesh.n_vertices() == 6);
}

TEST_CASE("a distance to weld by is a small fraction", "[io][weld]") {
  for (const double wrong : {-1e-6, 0.2, std::numeric_limits<double>::quiet_NaN()})
    CHECK_THROWS_AS(read(sheets_at_an_edge(2), wrong), InvalidOption);
}
