// What may take the place of polygons in a result that is being changed.
#include "balance/patch_changes.hh"

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
