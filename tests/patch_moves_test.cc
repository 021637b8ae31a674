// What may take the place of polygons in a result that is being changed.
#include "balance/patch_changes.hh"

#include <algorithm>

#include "anisomesh/mesher.hh"
#include "anisomesh/properties.hh"
#include "anisomesh/shapes.hh"
#include "catch.hh"

using namespace anisomesh;

namespace {

using Polygons = std::vector<std::vector<int>>;

OpenMesh::PolyMesh result_of(const std::vector<Vec3d>& places, const Polygons& polygons) {
  OpenMesh::PolyMesh mesh;
  for (const Vec3d& p : places) mesh.add_vertex(p);
  for (const auto& polygon : polygons) {
    std::vector<OpenMesh::VertexHandle> corners;
    for (const int v : polygon) corners.emplace_back(v);
    mesh.add_face(corners);
  }
  const auto origin = provide_property(mesh, property::origin);
  const auto face = provide_property(mesh, property::source_face);
  const auto barycentric = provide_property(mesh, property::source_barycentric);
  provide_property(mesh, property::edge_kind);
  for (const auto v : mesh.vertices()) {
    mesh.property(origin, v) = static_cast<int>(Origin::crossing);
    mesh.property(face, v) = 0;
    mesh.property(barycentric, v) = {1, 0, 0};
  }
  return mesh;
}

detail::PatchMesh patch_mesh(const std::vector<Vec3d>& places, const Polygons& polygons) {
  return detail::PatchMesh(result_of(places, polygons));
}

}  // namespace

TEST_CASE("no edge runs past a vertex that is beside both its ends", "[patch_moves]") {
  // Two triangles below a straight line, 0 1 2, and a quad above, which is parted along it.
  for (const double off : {0.0, 0.01}) {
    const auto mesh = patch_mesh({{0, 0, 0}, {1, off, 0}, {2, 0, 0}, {1, -1, 0}, {2, 1, 0}, {0, 1, 0}},
                                 {{0, 3, 1}, {1, 3, 2}, {0, 1, 2, 4, 5}});
    CHECK(mesh.may_replace(mesh.join({2}), {{0, 1, 2}, {0, 2, 4, 5}}) == (off > 0));
    CHECK(mesh.may_replace(mesh.join({2}), {{0, 1, 5}, {1, 2, 4, 5}}));
  }
}

TEST_CASE("no vertex is added where one is", "[patch_moves]") {
  auto mesh = patch_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}},
                         {{0, 1, 2, 3}, {1, 4, 5, 2}});
  detail::PatchChanges changes(mesh);
  const auto addition = [&](int polygon, const Vec3d& place) {
    detail::PatchMove move;
    move.patch = mesh.join({polygon});
    const auto& ring = move.patch.ring;
    for (size_t i = 0; i < ring.size(); ++i)
      move.pieces.push_back({ring[i], ring[(i + 1) % ring.size()], -1});
    move.adds = true;
    move.place = place;
    return move;
  };
  CHECK_FALSE(changes.is_open(addition(0, {1, 1, 0})));
  const Vec3d between(1, 0.5, 0.1);  // off the surface, and as near to both
  const auto first = addition(0, between), second = addition(1, between);
  REQUIRE(changes.is_open(first));
  REQUIRE(changes.is_open(second));
  changes.apply(first);
  CHECK_FALSE(changes.is_open(second));
  CHECK(changes.is_open(addition(1, {1.5, 0.5, 0})));
}

// Four by two quads with a feature along the middle row, 5 to 9: 10, say, is below 5 and 0 above it.
OpenMesh::PolyMesh quads_beside_feature() {
  std::vector<Vec3d> places;
  Polygons quads;
  for (int row = 0; row < 3; ++row)
    for (int i = 0; i < 5; ++i) places.emplace_back(i, 1 - row, 0);
  for (int row = 0; row < 2; ++row)
    for (int i = 0; i < 4; ++i)
      quads.push_back({5 * row + i, 5 * row + i + 5, 5 * row + i + 6, 5 * row + i + 1});
  auto mesh = result_of(places, quads);
  mesh.request_edge_status();
  const auto kind = require_property(mesh, property::edge_kind);
  const auto is_middle = [](OpenMesh::VertexHandle v) { return v.idx() >= 5 && v.idx() < 10; };
  for (const auto e : mesh.edges()) {
    const bool feature = is_middle(e.v0()) && is_middle(e.v1());
    mesh.property(kind, e) = static_cast<int>(feature           ? EdgeKind::feature
                                              : e.is_boundary() ? EdgeKind::border
                                                                : EdgeKind::min);
    mesh.status(e).set_feature(feature);
  }
  return mesh;
}

size_t features_of(const OpenMesh::PolyMesh& mesh) {
  return static_cast<size_t>(
      std::count_if(mesh.edges_begin(), mesh.edges_end(), [&](auto e) { return mesh.status(e).feature(); }));
}

TEST_CASE("a vertex goes from a feature, whose neighbours there come to be joined", "[patch_moves]") {
  const auto before = quads_beside_feature();
  detail::PatchMesh mesh(before);
  for (const int end : {5, 9}) CHECK(mesh.curve_star(end).sides.empty());  // features meet the border there
  CHECK(mesh.curve_star(0).sides.size() == 1);
  const auto star = mesh.curve_star(7);
  REQUIRE(star.sides.size() == 2);
  CHECK(star.whole.polygons.size() == 4);
  CHECK(star.whole.ring.size() == 8);
  std::vector<std::vector<int>> pieces;
  for (const auto& side : star.sides) {
    CHECK(side.polygons.size() == 2);
    CHECK(side.ring.size() == 5);
    pieces.push_back({side.ring[0], side.ring[1], side.ring[2], side.ring[3]});
    pieces.push_back({side.ring[0], side.ring[3], side.ring[4]});
  }
  REQUIRE(mesh.may_replace(star.whole, pieces));
  mesh.replace(star.whole, pieces, 2);
  const auto after = mesh.mesh();
  CHECK(after.n_vertices() == before.n_vertices() - 1);
  CHECK(features_of(after) == features_of(before) - 1);
  const auto heirs = mesh.heirs();
  CHECK(heirs[static_cast<size_t>(star.sides[0].polygons[0])].end == 6);
  CHECK(heirs[static_cast<size_t>(star.sides[1].polygons[0])].begin == 6);
}

TEST_CASE("a corner stays on its feature", "[patch_moves]") {
  auto before = quads_beside_feature();
  before.property(require_property(before, property::origin), OpenMesh::VertexHandle(7)) =
      static_cast<int>(Origin::corner);
  const detail::PatchMesh mesh(before);
  CHECK(mesh.curve_star(7).sides.empty());
  CHECK(mesh.curve_star(6).sides.size() == 2);
}

TEST_CASE("a vertex comes to a side of a feature", "[patch_moves]") {
  const auto before = quads_beside_feature();
  detail::PatchMesh mesh(before);
  const auto beside = mesh.curve_side(6, 7);
  REQUIRE(beside.sides.size() == 2);
  CHECK(beside.whole.ring.size() == 6);
  detail::PatchMove move;
  move.patch = beside.whole;
  move.adds = true;
  move.place = {1.5, 0, 0.1};
  move.between = {6, 7};
  move.on_first_side = 2;
  for (const auto& side : beside.sides) {
    REQUIRE(side.ring.size() == 5);
    REQUIRE(side.ring.back() == -1);
    move.pieces.push_back({side.ring[4], side.ring[0], side.ring[1]});
    move.pieces.push_back({side.ring[4], side.ring[1], side.ring[2], side.ring[3]});
  }
  detail::PatchChanges changes(mesh);
  REQUIRE(changes.is_open(move));
  changes.apply(move);
  const auto after = mesh.mesh();
  CHECK(after.n_vertices() == before.n_vertices() + 1);
  CHECK(features_of(after) == features_of(before) + 1);
  CHECK(after.property(require_property(after, property::origin), OpenMesh::VertexHandle(15)) ==
        static_cast<int>(Origin::feature));
  CHECK(mesh.curve_side(0, 1).sides.size() == 1);
}

// Two triangles of a quad that is concave at 2, and the other way to part it, which turns one over; and a
// quad beside, parted at will.
TEST_CASE("a move that folds a polygon is told from one that does not", "[patch_moves]") {
  const std::vector<Vec3d> places{{0, 0, 0}, {1, 0, 0}, {0.3, 0.3, 0}, {0, 1, 0}, {1, -1, 0}, {0, -1, 0}};
  const auto before = result_of(places, {{0, 1, 2}, {0, 2, 3}, {0, 5, 4, 1}});
  auto plane = make_shape("plane", {100, false});
  const detail::ReferenceSurface reference{SurfaceRef(plane)};
  const detail::FaceJudge judge(reference, before);
  detail::PatchMesh mesh(before);
  detail::PatchMove folding, fair;
  folding.patch = mesh.join({0, 1});
  folding.pieces = {{0, 1, 3}, {1, 2, 3}};
  fair.patch = mesh.join({2});
  fair.pieces = {{0, 5, 4}, {0, 4, 1}};
  detail::PatchChanges changes(mesh);
  for (const auto* move : {&folding, &fair}) {
    REQUIRE(changes.is_open(*move));
    changes.apply(*move);
  }
  CHECK(changes.breaking(judge, before) == detail::PatchChanges::Moves{&folding});
  detail::PatchMesh again(before);
  const detail::PatchChanges::Moves refused{&folding};
  CHECK_FALSE(detail::PatchChanges(again, refused).is_open(folding));
  CHECK(detail::PatchChanges(again, refused).is_open(fair));
}
