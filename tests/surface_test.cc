#include "anisomesh/surface.hh"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <limits>

#include "anisomesh/compare.hh"
#include "anisomesh/curvature.hh"
#include "anisomesh/errors.hh"
#include "anisomesh/features.hh"
#include "anisomesh/holes.hh"
#include "anisomesh/refine.hh"
#include "anisomesh/shapes.hh"
#include "catch.hh"

using namespace anisomesh;

namespace {

template <class Mesh>
Mesh one_triangle() {
  Mesh mesh;
  const auto a = mesh.add_vertex({0, 0, 0}), b = mesh.add_vertex({3, 0, 0}), c = mesh.add_vertex({0, 4, 0});
  mesh.add_face(a, b, c);
  return mesh;
}

using FloatMesh = OpenMesh::TriMesh_ArrayKernelT<>;
using DoubleMesh = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

}  // namespace

TEMPLATE_TEST_CASE("a surface reference fits meshes of any traits", "[surface]", FloatMesh, DoubleMesh) {
  auto mesh = one_triangle<TestType>();
  const SurfaceRef surface = mesh;
  CHECK(surface.diagonal() == Approx(5));
  const SurfacePoint centre{OpenMesh::FaceHandle(0), {1.0 / 3, 1.0 / 3, 1.0 / 3}};
  CHECK((position(surface, centre) - Vec3d(1, 4.0 / 3, 0)).norm() < 1e-12);
}

TEST_CASE("barycentric coordinates refer to the corners in the order of the circulator", "[surface]") {
  auto mesh = one_triangle<DoubleMesh>();
  const SurfaceRef surface = mesh;
  const auto face = OpenMesh::FaceHandle(0);
  int i = 0;
  for (const auto vertex : mesh.fv_range(face)) CHECK(surface.corners(face).vertex[i++] == vertex);
}

TEST_CASE("a view of a mesh that has changed since is refused", "[surface]") {
  auto mesh = make_shape("dome", {100});
  auto result = OpenMesh::PolyMesh();
  result.add_face(result.add_vertex({0, 0, 0}), result.add_vertex({1, 0, 0}), result.add_vertex({0, 1, 0}));
  const SurfaceRef surface = mesh;
  SECTION("more vertices") {
    mesh.split(OpenMesh::FaceHandle(0), mesh.calc_face_centroid(OpenMesh::FaceHandle(0)));
  }
  SECTION("deleted faces") { mesh.delete_face(OpenMesh::FaceHandle(0)); }
  CHECK_THROWS_AS(tag_features(surface), InvalidInput);
  CHECK_THROWS_AS(fill_holes(surface, {}), InvalidInput);
  CHECK_THROWS_AS(refine(surface), InvalidInput);
  CHECK_THROWS_AS(estimate_curvature(surface), InvalidInput);
  CHECK_THROWS_AS(compare(surface, result), InvalidInput);
}

TEST_CASE("meshes that no stage can read are refused", "[surface]") {
  SECTION("no faces") {
    DoubleMesh mesh;
    CHECK_THROWS_AS(SurfaceRef(mesh), InvalidInput);
  }
  SECTION("deleted elements") {
    auto mesh = one_triangle<DoubleMesh>();
    mesh.add_face(mesh.vertex_handle(1), mesh.vertex_handle(0), mesh.add_vertex({0, -1, 0}));
    mesh.request_face_status();
    mesh.request_edge_status();
    mesh.request_vertex_status();
    mesh.delete_face(OpenMesh::FaceHandle(1));
    CHECK_THROWS_WITH(SurfaceRef(mesh), Catch::Contains("garbage_collection"));
  }
  SECTION("all points in one place") {
    auto mesh = one_triangle<DoubleMesh>();
    for (const auto v : mesh.vertices()) mesh.set_point(v, {1, 2, 3});
    CHECK_THROWS_WITH(SurfaceRef(mesh), Catch::Contains("in one place"));
  }
  SECTION("a size whose powers are 0 or infinite") {
    for (const double scale : {1e-310, 1e-170, 1e-61, 1e61, 1e200, 1e305}) {
      auto mesh = one_triangle<DoubleMesh>();
      for (const auto v : mesh.vertices()) mesh.set_point(v, scale * mesh.point(v));
      CHECK_THROWS_WITH(SurfaceRef(mesh), Catch::Contains("scale the mesh"));
    }
    for (const double scale : {1e-59, 1e59}) {
      auto mesh = one_triangle<DoubleMesh>();
      for (const auto v : mesh.vertices()) mesh.set_point(v, scale * mesh.point(v));
      CHECK(SurfaceRef(mesh).diagonal() == Approx(5 * scale));
    }
  }
  SECTION("a point that is not finite") {
    auto mesh = one_triangle<DoubleMesh>();
    mesh.set_point(mesh.vertex_handle(1), {std::numeric_limits<double>::quiet_NaN(), 0, 0});
    CHECK_THROWS_WITH(SurfaceRef(mesh), Catch::Contains("vertex 1"));
  }
}
