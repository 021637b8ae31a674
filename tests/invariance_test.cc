// The lines and samples of a surface do not depend on where it lies, how large it is and how it is numbered.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "anisomesh/curvature.hh"
#include "anisomesh/features.hh"
#include "anisomesh/flatten.hh"
#include "anisomesh/io.hh"
#include "anisomesh/lines.hh"
#include "anisomesh/properties.hh"
#include "anisomesh/remesh.hh"
#include "anisomesh/shapes.hh"
#include "anisomesh/smoothing.hh"
#include "anisomesh/umbilics.hh"
#include "catch.hh"
#include "copies.hh"
#include "data.hh"

using namespace anisomesh;
using copies::Change;
using copies::changed;
using copies::changes;

namespace {

struct Traced {
  TraceReport trace;
  IsotropicReport isotropic;
  LineNetwork network;
};

/// \param epsilon fraction of the diagonal, which a rotation changes
Traced trace(OpenMesh::TriMesh& mesh, bool plane, double epsilon, double feature_angle) {
  FeatureOptions features;
  features.angle_degrees = feature_angle;
  tag_features(mesh, features);
  estimate_curvature(mesh);
  if (plane) flatten(mesh);
  smooth_tensors(mesh);
  find_umbilics(mesh);
  TraceOptions options;
  options.density.epsilon_fraction = epsilon;
  Traced traced;
  traced.trace = trace_lines(mesh, options);
  traced.isotropic = place_isotropic_samples(mesh, options);
  traced.network = read_lines(mesh);
  return traced;
}

void check_invariance(OpenMesh::TriMesh mesh, bool plane, double epsilon, double feature_angle = 0) {
  mesh = copies::representable(mesh, SurfaceRef(mesh).diagonal());
  const OpenMesh::TriMesh original = mesh;
  const Traced expected = trace(mesh, plane, epsilon, feature_angle);
  const SurfaceRef surface = mesh;
  for (const Change& change : changes(surface.diagonal())) {
    INFO(change.name);
    auto copy = changed(original, change);
    const SurfaceRef other = copy;
    const double box = surface.diagonal() * change.scale / other.diagonal();
    const Traced found = trace(copy, plane, epsilon * box, feature_angle);
    CHECK(found.trace.min_lines == expected.trace.min_lines);
    CHECK(found.trace.max_lines == expected.trace.max_lines);
    CHECK(found.trace.points == expected.trace.points);
    CHECK(found.trace.coverage_seeds == expected.trace.coverage_seeds);
    CHECK(std::equal(std::begin(found.trace.ends), std::end(found.trace.ends),
                     std::begin(expected.trace.ends)));
    CHECK(found.isotropic.from_umbilics == expected.isotropic.from_umbilics);
    CHECK(found.isotropic.random == expected.isotropic.random);
    // The same lines in the same order, point by point.
    double farthest = 0;
    const auto& lines = expected.network.lines;
    REQUIRE(found.network.lines.size() == lines.size());
    for (size_t i = 0; i < lines.size(); ++i) {
      REQUIRE(found.network.lines[i].points.size() == lines[i].points.size());
      for (size_t j = 0; j < lines[i].points.size(); ++j) {
        const Vec3d here = change.apply(position(surface, lines[i].points[j]));
        farthest = std::max(farthest, (position(other, found.network.lines[i].points[j]) - here).norm());
      }
    }
    // 2 % of the spacing at most, where segments or ways are equally near but for rounding; mostly 1e-9.
    CHECK(farthest <= 1e-4 * other.diagonal());
  }
}

}  // namespace

TEST_CASE("lines follow a shape that is moved, turned, scaled or renumbered", "[invariance]") {
  const bool plane = GENERATE(true, false);
  check_invariance(make_shape("ellipsoid-cap", {3000, true}), plane, 0.001);
}

TEST_CASE("lines follow a part with flat and round faces that is moved, turned, scaled or renumbered",
          "[invariance]") {
  const auto path = demo_mesh("fandisk.off");
  if (!path) return skip("fandisk.off");
  check_invariance(read_surface(*path), false, 1e-4, 40);
}

TEST_CASE("lines follow a scan that is moved, turned, scaled or renumbered", "[invariance]") {
  const bool plane = GENERATE(true, false);
  const auto path = demo_mesh(plane ? "lion-head.off" : "elephant.off");
  if (!path) return skip(plane ? "lion-head.off" : "elephant.off");
  check_invariance(read_surface(*path), plane, 0.001);
}

namespace {

// The same polygons, made of the same numbers, from the same places of the same faces.
void check_renumbered(OpenMesh::TriMesh mesh, const RemeshOptions& options) {
  auto copy = changed(mesh, changes(1).back());
  RemeshReport expected, found;
  const auto result = remesh(mesh, options, &expected), other = remesh(copy, options, &found);
  CHECK(found.attempts == expected.attempts);
  CHECK(found.epsilon_fraction == expected.epsilon_fraction);
  REQUIRE(other.n_vertices() == result.n_vertices());
  REQUIRE(other.n_faces() == result.n_faces());
  const auto face = require_property(result, property::source_face),
             other_face = require_property(other, property::source_face);
  const auto barycentric = require_property(result, property::source_barycentric),
             other_barycentric = require_property(other, property::source_barycentric);
  const SurfaceRef surface = mesh, renumbered = copy;
  double farthest = 0;
  bool same = true;
  for (const auto v : result.vertices()) {
    const auto w = other.vertex_handle(static_cast<unsigned>(v.idx()));
    same = same && result.point(v) == other.point(w);
    const Vec3d from =
        position(surface, {OpenMesh::FaceHandle(result.property(face, v)), result.property(barycentric, v)});
    const Vec3d there = position(renumbered, {OpenMesh::FaceHandle(other.property(other_face, w)),
                                              other.property(other_barycentric, w)});
    farthest = std::max(farthest, (from - there).norm());
  }
  CHECK(same);
  CHECK(farthest <= 1e-12 * surface.diagonal());
  bool same_corners = true;
  for (const auto f : result.faces()) {
    std::vector<int> here, there;
    for (const auto v : result.fv_range(f)) here.push_back(v.idx());
    for (const auto v : other.fv_range(other.face_handle(static_cast<unsigned>(f.idx()))))
      there.push_back(v.idx());
    same_corners = same_corners && here == there;
  }
  CHECK(same_corners);
  // What the stages have left on the surface lies on the same elements.
  const auto k_max = require_property(mesh, property::k_max),
             other_k_max = require_property(copy, property::k_max);
  std::vector<double> here, there;
  for (const auto v : mesh.vertices()) here.push_back(mesh.property(k_max, v) + surface.point(v)[0]);
  for (const auto v : copy.vertices())
    there.push_back(copy.property(other_k_max, v) + renumbered.point(v)[0]);
  std::sort(here.begin(), here.end());
  std::sort(there.begin(), there.end());
  CHECK(here == there);
  const auto lines = read_lines(surface).lines, other_lines = read_lines(renumbered).lines;
  REQUIRE(other_lines.size() == lines.size());
  for (size_t i = 0; i < lines.size(); ++i) {
    REQUIRE(other_lines[i].points.size() == lines[i].points.size());
    for (size_t j = 0; j < lines[i].points.size(); ++j)
      farthest = std::max(
          farthest,
          (position(surface, lines[i].points[j]) - position(renumbered, other_lines[i].points[j])).norm());
  }
  CHECK(farthest <= 1e-12 * surface.diagonal());
}

}  // namespace

TEST_CASE("a renumbered surface gives the same polygons to the last bit", "[invariance]") {
  RemeshOptions options;
  options.target_faces = 500;
  SECTION("in the plane") { check_renumbered(make_shape("ellipsoid-cap", {3000, true}), options); }
  SECTION("on the surface, fitted") {
    options.fit.enabled = true;
    check_renumbered(make_shape("ellipsoid", {3000, true}), options);
  }
  SECTION("in charts") {
    options.domain = Domain::charts;
    check_renumbered(make_shape("torus", {3000, true}), options);
  }
  SECTION("a part with features") {
    const auto path = demo_mesh("fandisk.off");
    if (!path) return skip("fandisk.off");
    options.target_faces = 0;
    options.trace.density.epsilon_fraction = 2e-4;
    check_renumbered(read_surface(*path), options);
  }
}

namespace {

// As many polygons of the same corners, each where the change takes it.
/// \param epsilon fraction of the diagonal, which a rotation changes; 0: as by default
void check_polygons(const OpenMesh::TriMesh& given, double epsilon, size_t faces, bool fit,
                    bool symmetric = false) {
  OpenMesh::TriMesh original = given;
  original = copies::representable(original, SurfaceRef(original).diagonal());
  const double size = SurfaceRef(original).diagonal();
  const auto made = [&](OpenMesh::TriMesh& mesh, double box) {
    RemeshOptions options;
    options.fit.enabled = fit;
    options.target_faces = faces;
    options.trace.density.epsilon_fraction = epsilon * box;
    return remesh(mesh, options);
  };
  auto mesh = original;
  const auto expected = made(mesh, 1);
  for (const Change& change : changes(size)) {
    INFO(change.name);
    auto copy = changed(original, change);
    const auto found = made(copy, size * change.scale / SurfaceRef(copy).diagonal());
    REQUIRE(found.n_vertices() == expected.n_vertices());
    REQUIRE(found.n_faces() == expected.n_faces());
    double farthest = 0;
    for (const auto v : expected.vertices()) {
      const auto there = found.point(found.vertex_handle(static_cast<unsigned>(v.idx())));
      farthest = std::max(farthest, (there - change.apply(expected.point(v))).norm());
    }
    // One half of the ellipsoid is as the other: where it is renumbered the result may begin there.
    if (symmetric && change.renumbers) continue;
    CHECK(farthest <= 1e-6 * size * change.scale);
    bool same = true;
    for (const auto f : expected.faces())
      same = same && copies::corners(expected, f) ==
                         copies::corners(found, found.face_handle(static_cast<unsigned>(f.idx())));
    CHECK(same);
  }
}

}  // namespace

TEST_CASE("polygons follow a shape that is moved, turned, scaled or renumbered", "[invariance]") {
  SECTION("a closed surface, at a number of faces") {
    for (const bool fit : {false, true})
      check_polygons(make_shape("ellipsoid", {3000, true}), 0, 500, fit, true);
  }
  SECTION("scans") {
    const std::string name = GENERATE("elephant.off", "lion-head.off", "bull.off");
    const auto path = demo_mesh(name);
    if (!path) return skip(name);
    check_polygons(read_surface(*path), 0.001, 0, false);
  }
  SECTION("a scan, fitted and balanced") {
    const auto path = demo_mesh("elephant.off");
    if (!path) return skip("elephant.off");
    check_polygons(read_surface(*path), 0.001, 0, true);
  }
  SECTION("a scan with triangles that lie on one another, fitted and balanced at a number of faces") {
    const auto path = demo_mesh("hand.off");
    if (!path) return skip("hand.off");
    check_polygons(read_surface(*path), 0, 1000, true);
  }
  SECTION("scans with nothing said but how many faces there are to be") {
    const std::string name = GENERATE("elephant.off", "dino.off", "homer.off");
    const auto path = demo_mesh(name);
    if (!path) return skip(name);
    check_polygons(read_surface(*path), 0, 700, true);
  }
  SECTION("a scan in the plane with nothing said at all") {
    const auto path = demo_mesh("lion-head.off");
    if (!path) return skip("lion-head.off");
    check_polygons(read_surface(*path), 0, 0, true);
  }
}
