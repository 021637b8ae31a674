#include "anisomesh/refine.hh"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "anisomesh/compare.hh"
#include "anisomesh/errors.hh"
#include "anisomesh/features.hh"
#include "anisomesh/io.hh"
#include "anisomesh/properties.hh"
#include "anisomesh/remesh.hh"
#include "anisomesh/shapes.hh"
#include "catch.hh"
#include "copies.hh"
#include "data.hh"

using namespace anisomesh;
using OpenMesh::FaceHandle, OpenMesh::VertexHandle;

namespace {

OpenMesh::TriMesh empty() {
  OpenMesh::TriMesh mesh;
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  return mesh;
}

/// A can of `n` sides: walls of two long triangles each, lids fanned from one corner. No symmetry but its
/// axis: sides grow from one to the next.
OpenMesh::TriMesh can(int n, double height, bool lids = true) {
  OpenMesh::TriMesh mesh = empty();
  std::vector<VertexHandle> ring[2];
  for (int top = 0; top < 2; ++top)
    for (int i = 0; i < n; ++i) {
      const double t = static_cast<double>(i) / n, angle = 2 * M_PI * (t + 0.05 * std::sin(M_PI * t));
      ring[top].push_back(mesh.add_vertex({std::cos(angle), std::sin(angle), top * height}));
    }
  const auto at = [&](int top, int i) { return ring[top][static_cast<size_t>(i % n)]; };
  for (int i = 0; i < n; ++i) {
    mesh.add_face(at(0, i), at(0, i + 1), at(1, i + 1));
    mesh.add_face(at(0, i), at(1, i + 1), at(1, i));
    if (i == 0 || i + 1 == n || !lids) continue;
    mesh.add_face(at(0, 0), at(0, i + 1), at(0, i));
    mesh.add_face(at(1, 0), at(1, i), at(1, i + 1));
  }
  return mesh;
}

double area(const OpenMesh::TriMesh& mesh) {
  double sum = 0;
  for (const auto f : mesh.faces()) sum += mesh.calc_face_area(f);
  return sum;
}

double feature_length(const OpenMesh::TriMesh& mesh) {
  double sum = 0;
  for (const auto e : mesh.edges())
    if (mesh.status(e).feature()) sum += mesh.calc_edge_length(e);
  return sum;
}

long euler(const OpenMesh::TriMesh& mesh) {
  return static_cast<long>(mesh.n_vertices()) - static_cast<long>(mesh.n_edges()) +
         static_cast<long>(mesh.n_faces());
}

/// Twice the area of the triangle of a, b and a point, times the side it lies on.
double side(const Vec3d& a, const Vec3d& b, const Vec3d& p, const Vec3d& normal) {
  return ((b - a) % (p - a)) | normal;
}

size_t long_and_thin(const OpenMesh::TriMesh& mesh, double limit, double aspect) {
  return static_cast<size_t>(std::count_if(mesh.faces_begin(), mesh.faces_end(), [&](auto f) {
    double most = 0;
    for (const auto e : f.edges()) most = std::max(most, mesh.calc_edge_length(e));
    return most > limit && most * most > aspect * 2 * mesh.calc_face_area(f);
  }));
}

}  // namespace

TEST_CASE("refined, a surface has the same shape and no long thin triangles", "[refine]") {
  for (const bool lids : {true, false}) {
    auto mesh = can(24, 5, lids);
    REQUIRE(tag_features(mesh, {}).is_mechanical() == lids);
    const double extent = SurfaceRef(mesh).extent();
    RefineReport report;
    const auto fine = refine(mesh, {}, &report);
    CHECK(long_and_thin(mesh, 0.06 * extent, 4) > 40);
    CHECK(long_and_thin(fine, 0.06 * extent * (1 + 1e-9), 4 * (1 + 1e-9)) == 0);
    CHECK(fine.n_vertices() == mesh.n_vertices() + report.divided);
    CHECK(euler(fine) == euler(mesh));
    CHECK(area(fine) == Approx(area(mesh)).epsilon(1e-12));
    CHECK(feature_length(fine) == Approx(feature_length(mesh)).epsilon(1e-12));
    CHECK(has_property(fine, property::feature_tolerance) == lids);
    for (const auto v : mesh.vertices()) CHECK(fine.point(v) == mesh.point(v));
    REQUIRE(report.parent_of.size() == fine.n_faces());
    for (const auto f : fine.faces()) {
      const FaceHandle parent(report.parent_of[static_cast<size_t>(f.idx())]);
      const auto normal = mesh.calc_face_normal(parent);
      CHECK((fine.calc_face_normal(f) | normal) > 1 - 1e-9);
      const auto middle = fine.calc_face_centroid(f);
      for (const auto h : mesh.fh_range(parent))
        CHECK(side(mesh.point(h.from()), mesh.point(h.to()), middle, normal) > 0);
    }
  }
}

TEST_CASE("well-shaped triangles are not divided, however large", "[refine]") {
  RefineReport report;
  auto cube = make_shape("cube");
  refine(cube, {}, &report);
  CHECK(report.divided == 0);
  auto mesh = can(24, 5);
  RefineOptions none;
  none.max_edge_fraction = 0;
  refine(mesh, none, &report);
  CHECK(report.divided == 0);
  none.max_edge_fraction = -1;
  CHECK_THROWS_AS(refine(mesh, none), InvalidOption);
  none = {};
  none.min_aspect = 0.5;
  CHECK_THROWS_AS(refine(mesh, none), InvalidOption);
}

TEST_CASE("no more triangles than are allowed, the longest divided first", "[refine]") {
  auto mesh = can(24, 5);
  RefineOptions options;
  options.max_triangles = 400;
  const auto fine = refine(mesh, options);
  CHECK(fine.n_faces() <= 400);
  CHECK(fine.n_faces() > 2 * mesh.n_faces());
  const auto longest = [](const OpenMesh::TriMesh& m) {
    double most = 0;
    for (const auto e : m.edges()) most = std::max(most, m.calc_edge_length(e));
    return most;
  };
  CHECK(longest(fine) < 0.6 * longest(mesh));
}

namespace {

struct StatusTraits : OpenMesh::DefaultTraits {
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::Color);
};
using StatusMesh = OpenMesh::TriMesh_ArrayKernelT<StatusTraits>;

}  // namespace

TEST_CASE("a mesh of the caller's own traits and properties is refined alike", "[refine]") {
  const auto plain = can(24, 5);
  OpenMesh::EPropHandleT<double> weight;
  StatusMesh mesh;
  mesh.add_property(weight);
  for (const auto v : plain.vertices()) mesh.add_vertex(OpenMesh::Vec3f(plain.point(v)));
  for (const auto f : plain.faces()) {
    std::vector<VertexHandle> corners;
    for (const auto v : f.vertices()) corners.push_back(v);
    mesh.add_face(corners);
  }
  OpenMesh::TriMesh same = empty();
  for (const auto v : mesh.vertices()) same.add_vertex(Vec3d(mesh.point(v)));
  for (const auto f : mesh.faces()) {
    std::vector<VertexHandle> corners;
    for (const auto v : f.vertices()) corners.push_back(v);
    same.add_face(corners);
  }
  tag_features(mesh);
  tag_features(same);
  const auto fine = refine(mesh), expected = refine(same);
  REQUIRE(fine.n_vertices() == expected.n_vertices());
  for (const auto v : fine.vertices()) CHECK(fine.point(v) == expected.point(v));
  CHECK(feature_length(fine) == feature_length(expected));
  CHECK(feature_length(fine) > 0);
}

TEST_CASE("parts that meet in a vertex only are refined as they are", "[refine]") {
  OpenMesh::TriMesh mesh = empty();
  const auto middle = mesh.add_vertex({0, 0, 0});
  const auto a = mesh.add_vertex({9, 0, 0}), b = mesh.add_vertex({9, 1, 0});
  const auto c = mesh.add_vertex({-9, 0, 0}), d = mesh.add_vertex({-9, -1, 0});
  mesh.add_face(middle, a, b);
  mesh.add_face(middle, c, d);
  const auto fine = refine(mesh);
  CHECK(fine.n_faces() > 10);
  CHECK(fine.n_vertices() - fine.n_edges() + fine.n_faces() == 1);
  CHECK(!fine.is_manifold(middle));
}

TEST_CASE("copies of a surface are refined alike", "[refine][invariance]") {
  auto mesh = can(24, 5);
  mesh = copies::representable(mesh, SurfaceRef(mesh).diagonal());
  const double diagonal = SurfaceRef(mesh).diagonal();
  RefineOptions options;
  options.max_edge_fraction = 0.15;
  const auto fine = refine(mesh, options);
  REQUIRE(fine.n_faces() > 2 * mesh.n_faces());
  for (const auto& change : copies::changes(diagonal)) {
    INFO(change.name);
    auto copy = copies::changed(mesh, change);
    const auto other = refine(copy, options);
    REQUIRE(other.n_vertices() == fine.n_vertices());
    REQUIRE(other.n_faces() == fine.n_faces());
    // Each triangle is there: the middles of all of them.
    double farthest = 0;
    for (const auto f : fine.faces()) {
      const Vec3d middle = change.apply(fine.calc_face_centroid(f));
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto g : other.faces())
        nearest = std::min(nearest, (other.calc_face_centroid(g) - middle).norm());
      farthest = std::max(farthest, nearest);
    }
    // Far off a middle is rounded to what there is beside it.
    CHECK(farthest <= 4e-16 * copies::far_off(diagonal) * change.scale);
  }
}

TEST_CASE("parts of long triangles have less error when they are refined", "[refine]") {
  double product = 1;
  for (const char* name : {"dragknob.off", "oblong.off"}) {
    const auto path = demo_mesh(name);
    if (!path) return skip(name);
    INFO(name);
    auto mesh = read_surface(*path);
    REQUIRE(tag_features(mesh).is_mechanical());
    auto fine = refine(mesh);
    RemeshOptions options;
    options.target_faces = 1500;
    auto plain = remesh(mesh, options), refined = remesh(fine, options);
    const Comparison before = compare(mesh, plain), after = compare(mesh, refined);
    product *= after.two_sided.rms * static_cast<double>(after.vertices) / before.two_sided.rms /
               static_cast<double>(before.vertices);
    CHECK(after.two_sided.hausdorff < before.two_sided.hausdorff);
    CHECK(after.folded_faces == 0);
    CHECK(after.same_topology);
    CHECK(std::abs(static_cast<double>(after.faces) / 1500 - 1) <= 0.1);
  }
  CHECK(std::sqrt(product) < 0.85);
}
