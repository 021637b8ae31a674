#include "anisomesh/features.hh"

#include <array>
#include <cmath>
#include <map>

#include "anisomesh/errors.hh"
#include "anisomesh/io.hh"
#include "anisomesh/properties.hh"
#include "anisomesh/shapes.hh"
#include "catch.hh"
#include "data.hh"

using namespace anisomesh;

namespace {

/// A sheet of 2 x n squares folded along its middle line by an angle.
OpenMesh::TriMesh folded_sheet(int n, double fold_degrees) {
  const double fold = fold_degrees * 3.14159265358979323846 / 180;
  OpenMesh::TriMesh mesh;
  for (int j = 0; j <= n; ++j) {
    mesh.add_vertex({-1, static_cast<double>(j), 0});
    mesh.add_vertex({0, static_cast<double>(j), 0});
    mesh.add_vertex({std::cos(fold), static_cast<double>(j), -std::sin(fold)});
  }
  const auto v = [](int i, int j) { return OpenMesh::VertexHandle(3 * j + i); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < 2; ++i) {
      mesh.add_face(v(i, j), v(i + 1, j), v(i + 1, j + 1));
      mesh.add_face(v(i, j), v(i + 1, j + 1), v(i, j + 1));
    }
  return mesh;
}

}  // namespace

TEST_CASE("automatic features are those of parts, and a scan has none", "[features]") {
  FeatureOptions options;
  options.keep_existing = false;  // those that the shape brings along
  auto cube = make_shape("cube", {});
  const auto of_cube = tag_features(cube, options);
  CHECK(of_cube.angle_degrees == 40);
  double length = 0;
  for (const auto e : cube.edges())
    if (cube.status(e).feature()) length += cube.calc_edge_length(e);
  CHECK(length == Approx(12 * 2));
  auto sphere = make_shape("sphere", {});
  const auto of_sphere = tag_features(sphere, options);
  CHECK(of_sphere.angle_degrees == 0);
  CHECK(of_sphere.feature_edges == 0);
}

TEST_CASE("what the user says of features goes before what is found", "[features]") {
  const auto sharp_edges = [](const FeatureOptions& options, auto& mesh) {
    const auto report = tag_features(mesh, options);
    CHECK(!report.automatic);
    CHECK(mesh.property(require_property(mesh, property::feature_tolerance)) == Approx(4.8e-4));
    return report.feature_edges;
  };
  FeatureOptions options;
  auto cube = make_shape("cube", {});
  options.keep_existing = false;  // those that the shape brings along
  CHECK(tag_features(cube, options).automatic);
  CHECK(cube.property(require_property(cube, property::feature_tolerance)) == 1);
  options.keep_existing = true;
  CHECK(!tag_features(cube, options).automatic);  // tags of the mesh are kept, and what was recorded of them
  CHECK(cube.property(require_property(cube, property::feature_tolerance)) == 1);
  options.angle_degrees = 100;
  options.keep_existing = false;
  auto other = make_shape("cube", {});
  CHECK(tag_features(other, options).feature_edges == 0);
  options.angle_degrees = 0;
  const auto first = *other.edges_begin();
  options.edges = {{first.v0().idx(), first.v1().idx()}};
  CHECK(sharp_edges(options, other) == 1);
}

TEST_CASE("a surface of steps is no part", "[features]") {
  // The skin of a ball of boxes: every vertex is a corner.
  const int n = 12;
  const auto inside = [&](int x, int y, int z) {
    const double c = 0.5 * (n - 1);
    return std::hypot(x - c, std::hypot(y - c, z - c)) < 0.45 * n;
  };
  std::map<std::array<int, 3>, OpenMesh::VertexHandle> corners;
  OpenMesh::TriMesh mesh;
  const auto corner = [&](std::array<int, 3> at) {
    const auto found = corners.find(at);
    return found != corners.end() ? found->second
                                  : corners[at] = mesh.add_vertex({1.0 * at[0], 1.0 * at[1], 1.0 * at[2]});
  };
  bool whole = true;
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y)
      for (int z = 0; z < n; ++z)
        for (size_t axis = 0; axis < 3; ++axis)
          for (const int side : {0, 1}) {
            std::array<int, 3> beyond{x, y, z};
            beyond[axis] += side == 1 ? 1 : -1;
            if (!inside(x, y, z) || inside(beyond[0], beyond[1], beyond[2])) continue;
            std::array<OpenMesh::VertexHandle, 4> ring;
            for (size_t k = 0; k < 4; ++k) {
              std::array<int, 3> at{x, y, z};
              at[axis] += side;
              const size_t turn = side == 1 ? k : 3 - k;
              at[(axis + 1) % 3] += turn == 1 || turn == 2;
              at[(axis + 2) % 3] += turn >= 2;
              ring[k] = corner(at);
            }
            whole = whole && mesh.add_face(ring[0], ring[1], ring[2]).is_valid() &&
                    mesh.add_face(ring[0], ring[2], ring[3]).is_valid();
          }
  REQUIRE(whole);
  const auto report = tag_features(mesh, {});
  CHECK(report.sharp > 2 * report.rounded);
  CHECK(report.feature_edges == 0);
}

TEST_CASE("real parts and scans are told apart", "[features][data]") {
  const FeatureOptions options;
  const std::vector<std::pair<std::string, bool>> meshes{
      {"anchor.off", true}, {"couplingdown.off", true}, {"lion-head.off", false}, {"elephant.off", false}};
  for (const auto& [name, is_part] : meshes) {
    const auto path = demo_mesh(name);
    if (!path) return skip(name);
    auto mesh = read_surface(*path);
    INFO(name);
    CHECK((tag_features(mesh, options).by_angle > 0) == is_part);
  }
}

TEST_CASE("an edge is a feature where the normals turn by more than the angle", "[features]") {
  for (const double sign : {1.0, -1.0}) {
    auto mesh = folded_sheet(4, sign * 40);
    FeatureOptions options;
    options.angle_degrees = 39.9;
    const auto report = tag_features(mesh, options);
    CHECK(report.feature_edges == 4);
    CHECK(report.by_angle == 4);
    for (const auto e : mesh.edges())
      CHECK(mesh.status(e).feature() == (e.v0().idx() % 3 == 1 && e.v1().idx() % 3 == 1));
    options.angle_degrees = 40.1;
    options.keep_existing = false;
    CHECK(tag_features(mesh, options).feature_edges == 0);
  }
}

TEST_CASE("tags of other tools are kept unless asked otherwise", "[features]") {
  auto mesh = folded_sheet(4, 0);
  FeatureOptions options;
  options.edges = {{1, 4}, {7, 4}};
  CHECK(tag_features(mesh, options).by_list == 2);
  options.edges = {{10, 7}};
  CHECK(tag_features(mesh, options).feature_edges == 3);
  options.keep_existing = false;
  CHECK(tag_features(mesh, options).feature_edges == 1);
}

TEST_CASE("a listed pair that is no edge is refused and nothing is tagged", "[features]") {
  auto mesh = folded_sheet(2, 90);
  FeatureOptions options;
  options.angle_degrees = 30;
  options.edges = {{1, 4}, {0, 8}};
  CHECK_THROWS_WITH(tag_features(mesh, options), Catch::Contains("(0, 8)"));
  options.edges = {{0, 9}};
  CHECK_THROWS_AS(tag_features(mesh, options), InvalidInput);
  CHECK_FALSE(mesh.has_edge_status());
  options.angle_degrees = 180;
  CHECK_THROWS_AS(tag_features(mesh, options), InvalidOption);
}

TEST_CASE("the skeleton of a folded sheet is its crease and its four sides", "[features]") {
  auto mesh = folded_sheet(4, 60);
  FeatureOptions options;
  options.angle_degrees = 30;
  tag_features(mesh, options);
  const auto skeleton = feature_skeleton(mesh);
  // Four corners of the sheet and the two ends of the crease.
  CHECK(skeleton.corners.size() == 6);
  CHECK(skeleton.curves.size() == 7);
  size_t edges = 0, creases = 0;
  for (const auto& curve : skeleton.curves) {
    CHECK_FALSE(curve.closed);
    edges += curve.halfedges.size();
    creases += !curve.border;
    for (size_t i = 1; i < curve.halfedges.size(); ++i)
      CHECK(mesh.to_vertex_handle(curve.halfedges[i - 1]) == mesh.from_vertex_handle(curve.halfedges[i]));
  }
  CHECK(creases == 1);
  CHECK(edges == 4 + 2 * 4 + 4);
}

TEST_CASE("a border without a corner is one closed curve", "[features]") {
  ShapeOptions options;
  options.vertices = 500;
  auto mesh = make_shape("hemisphere", options);
  const auto skeleton = feature_skeleton(mesh);
  CHECK(skeleton.corners.empty());
  REQUIRE(skeleton.curves.size() == 1);
  CHECK(skeleton.curves[0].closed);
  CHECK(skeleton.curves[0].border);
  CHECK(mesh.from_vertex_handle(skeleton.curves[0].halfedges.front()) ==
        mesh.to_vertex_handle(skeleton.curves[0].halfedges.back()));
}

TEST_CASE("border edges count as features also without edge status", "[features]") {
  auto mesh = folded_sheet(1, 0);
  size_t count = 0;
  for (const auto e : mesh.edges()) count += is_feature_or_border(mesh, e);
  CHECK(count == 6);
}

TEST_CASE("a needle on a flat sheet is no feature, a narrow chamfer is two", "[features]") {
  OpenMesh::TriMesh sheet;  // the needle stands upright on the line y = 0
  const auto a = sheet.add_vertex({0, 0, 0}), b = sheet.add_vertex({1, 0, 0}),
             apex = sheet.add_vertex({0.5, 0, 0.001}), below = sheet.add_vertex({0.5, -1, 0}),
             above = sheet.add_vertex({0.5, 1, 0});
  sheet.add_face(a, below, b);
  sheet.add_face(a, b, apex);
  sheet.add_face(apex, b, above);
  sheet.add_face(a, apex, above);
  FeatureOptions options;
  options.angle_degrees = 40;
  CHECK(tag_features(sheet, options).feature_edges == 0);

  const double width = 0.002;
  OpenMesh::TriMesh chamfer;
  std::vector<OpenMesh::VertexHandle> v;
  for (const auto& [y, z] : {std::pair{-1.0, 0.0}, {0.0, 0.0}, {width, -width}, {width, -1.0}})
    for (const double x : {0.0, 1.0}) v.push_back(chamfer.add_vertex({x, y, z}));
  for (size_t i = 0; i + 2 < v.size(); i += 2) {
    chamfer.add_face(v[i], v[i + 1], v[i + 3]);
    chamfer.add_face(v[i], v[i + 3], v[i + 2]);
  }
  CHECK(tag_features(chamfer, options).feature_edges == 2);
}
