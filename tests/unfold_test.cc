// Folds that moving corners cannot take out: polygons that were put together wrongly.
#include "balance/unfold.hh"

#include "anisomesh/compare.hh"
#include "anisomesh/mesher.hh"
#include "anisomesh/properties.hh"
#include "anisomesh/shapes.hh"
#include "catch.hh"

using namespace anisomesh;
using OpenMesh::PolyMesh;

namespace {

/// The result of a plane, of vertices in the faces that hold them and polygons.
PolyMesh result_on(const SurfaceRef& plane, const std::vector<Vec3d>& places,
                   const std::vector<std::vector<int>>& polygons) {
  PolyMesh result;
  const auto face = provide_property(result, property::source_face);
  const auto barycentric = provide_property(result, property::source_barycentric);
  const auto origin = provide_property(result, property::origin);
  provide_property(result, property::edge_kind);
  for (const Vec3d& p : places) {
    const auto v = result.add_vertex(p);
    result.property(origin, v) = static_cast<int>(Origin::crossing);
    for (const auto f : plane.connectivity().faces()) {
      const auto c = plane.corners(f);
      const Vec3d a = plane.point(c.vertex[0]), b = plane.point(c.vertex[1]), d = plane.point(c.vertex[2]);
      const double area = ((b - a) % (d - a))[2], s = ((d - b) % (p - b))[2] / area,
                   t = ((a - d) % (p - d))[2] / area;
      if (s < -1e-9 || t < -1e-9 || 1 - s - t < -1e-9) continue;
      result.property(face, v) = f.idx();
      result.property(barycentric, v) = Vec3d(s, t, 1 - s - t);
    }
  }
  for (const auto& polygon : polygons) {
    std::vector<OpenMesh::VertexHandle> corners;
    for (const int v : polygon) corners.emplace_back(v);
    result.add_face(corners);
  }
  return result;
}

}  // namespace

TEST_CASE("a fold that stays wherever its corners go is parted anew", "[unfold]") {
  auto plane = make_shape("plane", {900, false});
  const SurfaceRef surface = plane;
  // A square and, on top of it, a triangle that faces down: what lies around both is concave at 3.
  const std::vector<Vec3d> places{
      {-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {0, -0.2, 0}, {-0.5, 0.5, 0}};
  const PolyMesh sound = result_on(surface, places, {{0, 1, 3}, {1, 2, 3}, {0, 3, 4}});
  std::vector<PolyMesh> candidates{sound, result_on(surface, places, {{0, 1, 2, 4}, {2, 3, 4}})};
  REQUIRE(candidates[1].n_faces() == 2);
  REQUIRE(compare(plane, candidates[1]).folded_faces > 0);
  CHECK(detail::choose_unfolded(surface, detail::ReferenceSurface(surface), candidates) == 1);
  PolyMesh& mended = candidates[1];
  CHECK(compare(plane, mended).folded_faces == 0);
  CHECK(mended.n_vertices() == 5);
  double area = 0;
  for (const auto f : mended.faces()) {
    const auto corners = f.vertices().to_array<3>();
    area += 0.5 * ((mended.point(corners[1]) - mended.point(corners[0])) %
                   (mended.point(corners[2]) - mended.point(corners[0])))[2];
  }
  CHECK(area == Approx(1 - 0.5 * 0.7));
}

TEST_CASE("folds that were there before the fit are no reason to keep any", "[unfold]") {
  auto plane = make_shape("plane", {900, false});
  const SurfaceRef surface = plane;
  const std::vector<Vec3d> places{
      {-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {0, -0.2, 0}, {-0.5, 0.5, 0}};
  const PolyMesh folded = result_on(surface, places, {{0, 1, 2, 4}, {2, 3, 4}});
  std::vector<PolyMesh> candidates{folded, folded};
  const int taken = detail::choose_unfolded(surface, detail::ReferenceSurface(surface), candidates);
  CHECK(compare(plane, candidates[static_cast<size_t>(taken)]).folded_faces == 0);
}

TEST_CASE("without folds the last candidate is taken as it is", "[unfold]") {
  auto plane = make_shape("plane", {900, false});
  const SurfaceRef surface = plane;
  const std::vector<Vec3d> places{{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}};
  const PolyMesh quad = result_on(surface, places, {{0, 1, 2, 3}});
  std::vector<PolyMesh> candidates{quad, result_on(surface, places, {{0, 1, 2}, {0, 2, 3}})};
  CHECK(detail::choose_unfolded(surface, detail::ReferenceSurface(surface), candidates) == 1);
  CHECK(candidates[1].n_faces() == 2);
}

TEST_CASE("a concave quad is parted in two, where concave ones were not asked for", "[unfold]") {
  auto plane = make_shape("plane", {900, false});
  const SurfaceRef surface = plane;
  const std::vector<Vec3d> places{{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {-0.2, -0.2, 0}, {-0.5, 0.5, 0}};
  const PolyMesh triangles = result_on(surface, places, {{0, 1, 2}, {0, 2, 3}});
  PolyMesh quad = result_on(surface, places, {{0, 1, 2, 3}});
  REQUIRE(compare(plane, quad).concave_faces == 1);
  std::vector<PolyMesh> candidates{triangles, quad};
  CHECK(detail::choose_unfolded(surface, detail::ReferenceSurface(surface), candidates) == 1);
  CHECK(candidates[1].n_faces() == 2);
  CHECK(compare(plane, candidates[1]).concave_faces == 0);
  std::vector<PolyMesh> asked_for{quad, quad};
  CHECK(detail::choose_unfolded(surface, detail::ReferenceSurface(surface), asked_for) == 1);
  CHECK(asked_for[1].n_faces() == 1);
}

namespace {

/// Two squares, one above the other, both facing up.
OpenMesh::TriMesh two_sheets() {
  OpenMesh::TriMesh mesh;
  for (const double z : {0.0, 0.1}) {
    std::vector<OpenMesh::VertexHandle> v;
    for (const Vec3d& p : {Vec3d(-1, -1, z), Vec3d(1, -1, z), Vec3d(1, 1, z), Vec3d(-1, 1, z)})
      v.push_back(mesh.add_vertex(p));
    mesh.add_face(v[0], v[1], v[2]);
    mesh.add_face(v[0], v[2], v[3]);
  }
  return mesh;
}

/// The same as fans around their middles, the lower of which stands `high`.
PolyMesh fans_over(double high) {
  PolyMesh result;
  const auto face = provide_property(result, property::source_face);
  const auto barycentric = provide_property(result, property::source_barycentric);
  const auto origin = provide_property(result, property::origin);
  provide_property(result, property::edge_kind);
  for (const int sheet : {0, 1}) {
    const double z = 0.1 * sheet;
    std::vector<OpenMesh::VertexHandle> v;
    const auto add = [&](const Vec3d& p, int f, const Vec3d& b) {
      v.push_back(result.add_vertex(p));
      result.property(face, v.back()) = 2 * sheet + f;
      result.property(barycentric, v.back()) = b;
      result.property(origin, v.back()) = static_cast<int>(Origin::crossing);
    };
    add({-1, -1, z}, 0, {1, 0, 0});
    add({1, -1, z}, 0, {0, 1, 0});
    add({1, 1, z}, 0, {0, 0, 1});
    add({-1, 1, z}, 1, {0, 0, 1});
    add({0, 0, sheet == 0 ? high : z}, 0, {0.5, 0, 0.5});
    for (size_t i = 0; i < 4; ++i) result.add_face(v[i], v[(i + 1) % 4], v[4]);
  }
  return result;
}

}  // namespace

TEST_CASE("a corner that went through another sheet goes back", "[unfold]") {
  auto sheets = two_sheets();
  for (const double high : {0.15, 0.3}) {  // half way back is enough, and is not
    std::vector<PolyMesh> candidates{fans_over(0), fans_over(high)};
    REQUIRE(compare(sheets, candidates[1]).self_intersecting_faces > 0);
    CHECK(detail::choose_unfolded(sheets, detail::ReferenceSurface(SurfaceRef(sheets)), candidates) == 1);
    CHECK(compare(sheets, candidates[1]).self_intersecting_faces == 0);
    CHECK(compare(sheets, candidates[1]).folded_faces == 0);
    CHECK(candidates[1].n_faces() == 8);
  }
}

TEST_CASE("no corner goes back to where another is, and crosses no more for being one with it", "[unfold]") {
  auto sheets = two_sheets();
  PolyMesh up = fans_over(0.3);
  up.set_point(OpenMesh::VertexHandle(9), {0, 0, 0});  // where the lower one was built
  std::vector<PolyMesh> candidates{up};
  REQUIRE(compare(sheets, up).self_intersecting_faces > 0);
  detail::choose_unfolded(sheets, detail::ReferenceSurface(SurfaceRef(sheets)), candidates);
  const PolyMesh& result = candidates[0];
  for (const auto v : result.vertices())
    for (const auto w : result.vertices())
      if (v.idx() < w.idx()) CHECK(result.point(v) != result.point(w));
}

TEST_CASE("a pyramid through another sheet is parted anew", "[unfold]") {
  auto sheets = two_sheets();  // built from where it stands, so that it has nowhere to go back to
  PolyMesh up = fans_over(0.1);
  const auto face = require_property(up, property::source_face);
  const auto barycentric = require_property(up, property::source_barycentric);
  up.property(face, OpenMesh::VertexHandle(4)) = 2;
  up.set_point(OpenMesh::VertexHandle(9), {0.3, 0, 0.1});
  up.property(barycentric, OpenMesh::VertexHandle(9)) = {0.35, 0.15, 0.5};
  std::vector<PolyMesh> candidates{up};
  REQUIRE(compare(sheets, up).self_intersecting_faces > 0);
  CHECK(detail::choose_unfolded(sheets, detail::ReferenceSurface(SurfaceRef(sheets)), candidates) == 0);
  CHECK(compare(sheets, candidates[0]).self_intersecting_faces == 0);
  CHECK(candidates[0].n_faces() == 5);
}

// A tent whose tip a corner of another sheet has gone through: flat, it would cross nothing, and be far off.
TEST_CASE("nothing is parted so that it leaves the surface, for crossing no more", "[unfold]") {
  OpenMesh::TriMesh tent;
  std::vector<OpenMesh::VertexHandle> t;
  for (const Vec3d& p : {Vec3d(-1, -1, 0), Vec3d(1, -1, 0), Vec3d(1, 1, 0), Vec3d(-1, 1, 0), Vec3d(0, 0, 1)})
    t.push_back(tent.add_vertex(p));
  for (size_t i = 0; i < 4; ++i) tent.add_face(t[i], t[(i + 1) % 4], t[4]);
  std::vector<OpenMesh::VertexHandle> s;
  for (const Vec3d& p : {Vec3d(-3, -3, 1.1), Vec3d(3, -3, 1.1), Vec3d(3, 3, 1.1), Vec3d(-3, 3, 1.1)})
    s.push_back(tent.add_vertex(p));
  tent.add_face(s[0], s[1], s[2]);
  tent.add_face(s[0], s[2], s[3]);

  PolyMesh result;
  const auto face = provide_property(result, property::source_face);
  const auto barycentric = provide_property(result, property::source_barycentric);
  const auto origin = provide_property(result, property::origin);
  provide_property(result, property::edge_kind);
  std::vector<OpenMesh::VertexHandle> v;
  const auto add = [&](const Vec3d& p, int f, const Vec3d& b) {
    v.push_back(result.add_vertex(p));
    result.property(face, v.back()) = f;
    result.property(barycentric, v.back()) = b;
    result.property(origin, v.back()) = static_cast<int>(Origin::crossing);
  };
  for (int i = 0; i < 4; ++i) add(tent.point(t[static_cast<size_t>(i)]), i, {1, 0, 0});
  add({0, 0, 1}, 0, {0, 0, 1});
  add({-3, -3, 1.1}, 4, {1, 0, 0});
  add({3, -3, 1.1}, 4, {0, 1, 0});
  add({3, 3, 1.1}, 4, {0, 0, 1});
  add({-3, 3, 1.1}, 5, {0, 0, 1});
  add({0.05, 0, 0.8}, 0, {0, 0, 1});  // built where the tip is, so that it cannot go back
  for (size_t i = 0; i < 4; ++i) result.add_face(v[i], v[(i + 1) % 4], v[4]);
  for (size_t i = 0; i < 4; ++i) result.add_face(v[5 + i], v[5 + (i + 1) % 4], v[9]);
  REQUIRE(compare(tent, result).self_intersecting_faces > 0);
  std::vector<PolyMesh> candidates{result};
  detail::choose_unfolded(tent, detail::ReferenceSurface(SurfaceRef(tent)), candidates);
  const Comparison after = compare(tent, candidates[0]);
  CHECK(after.two_sided.hausdorff < 0.06);
}
