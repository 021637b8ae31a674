#include "anisomesh/compare.hh"
#include "anisomesh/features.hh"
#include "anisomesh/mesher.hh"
#include "anisomesh/properties.hh"
#include "anisomesh/remesh.hh"
#include "anisomesh/shapes.hh"
#include "catch.hh"
#include "sound_result.hh"

using namespace anisomesh;

namespace {

struct Made {
  Comparison compared;
  OpenMesh::PolyMesh result;
  RemeshReport report;
};

Made remeshed(const std::string& shape, const RemeshOptions& options) {
  auto mesh = make_shape(shape, {600});
  Made made;
  made.result = remesh(mesh, options, &made.report);
  made.compared = compare(mesh, made.result);
  return made;
}

double length_of(const OpenMesh::PolyMesh& mesh, EdgeKind kind) {
  const auto of = require_property(mesh, property::edge_kind);
  double sum = 0;
  for (const auto e : mesh.edges())
    if (mesh.property(of, e) == static_cast<int>(kind)) sum += mesh.calc_edge_length(e);
  return sum;
}

}  // namespace

// One quad is all that a flat face needs: 6 for 600 was what came out.
TEST_CASE("a flat surface gets the number of faces that was asked for, as a grid", "[target]") {
  RemeshOptions options;
  options.target_faces = 600;
  const std::string shape = GENERATE("plane", "cube");
  options.fit.enabled = GENERATE(true, false);
  CAPTURE(shape, options.fit.enabled);
  const auto made = remeshed(shape, options);
  CHECK(made.report.target_met);
  CHECK(made.report.mesh.faces == made.result.n_faces());
  CHECK(made.report.mesh.quads == made.result.n_faces());
  CHECK(made.result.n_faces() > 540);
  CHECK(made.result.n_faces() < 660);
  check_sound(made.compared);
  CHECK(made.compared.two_sided.rms < 1e-9);
  CHECK(length_of(made.result, EdgeKind::border) == Approx(shape == "plane" ? 8 : 0).margin(1e-9));
  for (const auto f : made.result.faces()) REQUIRE(f.valence() == 4);
}

TEST_CASE("a grid keeps features and has sources on the surface", "[target]") {
  auto mesh = make_shape("cube", {600});
  RemeshOptions options;
  options.features.angle_degrees = 40;
  options.target_vertices = 500;
  auto result = remesh(mesh, options);
  CHECK(result.n_vertices() > 450);
  CHECK(result.n_vertices() < 550);
  double tagged = 0;
  for (const auto e : mesh.edges())
    if (mesh.status(e).feature()) tagged += mesh.calc_edge_length(e);
  CHECK(length_of(result, EdgeKind::feature) == Approx(tagged));
  const auto face = require_property(result, property::source_face);
  const auto barycentric = require_property(result, property::source_barycentric);
  const SurfaceRef surface(mesh);
  for (const auto v : result.vertices()) {
    const SurfacePoint point{OpenMesh::FaceHandle(result.property(face, v)), result.property(barycentric, v)};
    REQUIRE((position(surface, point) - result.point(v)).norm() < 1e-9);
  }
}

// Whose faces are triangles, or have a corner in a side.
TEST_CASE("polygons that are no quads are divided too", "[target]") {
  OpenMesh::TriMesh mesh;
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  const std::vector<Vec3d> corners = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  std::vector<OpenMesh::VertexHandle> v;
  for (const auto& p : corners) v.push_back(mesh.add_vertex(p));
  mesh.add_face(v[0], v[1], v[2]);
  mesh.add_face(v[0], v[2], v[3]);
  mesh.add_face(v[0], v[3], v[1]);
  mesh.add_face(v[1], v[3], v[2]);
  RemeshOptions options;
  options.target_faces = GENERATE(as<size_t>(), 6, 9, 12, 40, 1000);
  CAPTURE(options.target_faces);
  RemeshReport report;
  auto result = remesh(mesh, options, &report);
  CHECK(report.target_met);
  const auto c = compare(mesh, result);
  check_sound(c);
  CHECK(c.two_sided.rms < 1e-9);
  for (const auto f : result.faces()) REQUIRE(f.valence() <= 4);
}

// Convex but for three degrees at one corner, which a single polygon may have: the rows of its grid would
// cross there.
TEST_CASE("a quad that turns in at a corner is cut there before it is divided", "[target]") {
  OpenMesh::TriMesh mesh;
  const auto a = mesh.add_vertex({0, 0, 0}), b = mesh.add_vertex({0.5, 0.012, 0}),
             c = mesh.add_vertex({1, 0, 0}), d = mesh.add_vertex({0.5, 1, 0});
  mesh.add_face(a, b, d);
  mesh.add_face(b, c, d);
  RemeshOptions options;
  options.target_faces = 1000;
  auto result = remesh(mesh, options);
  const Comparison compared = compare(mesh, result);
  check_sound(compared);
  CHECK(compared.self_intersecting_faces == 0);
  CHECK(std::abs(static_cast<double>(compared.faces) / 1000 - 1) < 0.1);
  CHECK(compared.two_sided.hausdorff < 1e-9);
}

TEST_CASE("where triangles are asked for, no quads come of it", "[target]") {
  RemeshOptions options;
  options.target_faces = 300;
  options.mesh.max_degree = 3;
  const auto made = remeshed("cube", options);
  for (const auto f : made.result.faces()) REQUIRE(f.valence() == 3);
}

// A face of a box is divided along and across: three vertices in one corner, and sides that lie on one
// another.
TEST_CASE("faces of a box that only touch are divided alike where they do", "[target]") {
  OpenMesh::TriMesh box;
  const auto square = [&](const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
    const auto v = box.add_vertex(a), w = box.add_vertex(b), x = box.add_vertex(c), y = box.add_vertex(d);
    box.add_face(v, w, x);
    box.add_face(v, x, y);
  };
  const auto at = [](int i) { return Vec3d(i & 1, (i & 2) ? 1.7 : 0, (i & 4) ? 2.9 : 0); };
  square(at(0), at(2), at(3), at(1));
  square(at(4), at(5), at(7), at(6));
  square(at(0), at(1), at(5), at(4));
  square(at(2), at(6), at(7), at(3));
  square(at(0), at(4), at(6), at(2));
  square(at(1), at(3), at(7), at(5));
  RemeshOptions options;
  options.target_faces = 500;
  auto result = remesh(box, options);
  const Comparison c = compare(box, result);
  CHECK(std::abs(static_cast<double>(c.faces) / 500 - 1) < 0.1);
  CHECK(c.t_junctions == 0);
  CHECK(c.quad_fraction == 1);
}
