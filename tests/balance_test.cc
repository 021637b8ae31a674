// Vertices where they buy most: less error than the fit alone with as many of them, and everything else as
// before.
#include "anisomesh/balance.hh"

#include <tbb/global_control.h>

#include <cmath>

#include "anisomesh/compare.hh"
#include "anisomesh/io.hh"
#include "anisomesh/properties.hh"
#include "catch.hh"
#include "data.hh"
#include "fitted.hh"
#include "sound_result.hh"

using namespace anisomesh;
using fitted::faces_of;
using fitted::feature_distance;
using fitted::points_of;
using fitted::remeshed;
using fitted::shape;
using OpenMesh::PolyMesh;

TEST_CASE("a balanced result has less error than a fitted one, with as many vertices, and is sound",
          "[balance]") {
  const std::string name = GENERATE("torus", "ellipsoid", "octa-flower", "cube");
  INFO(name);
  auto mesh = shape(name);
  auto result = remeshed(mesh, 300);
  const double farthest = feature_distance(mesh, result);
  const auto vertices = static_cast<double>(result.n_vertices());
  PolyMesh fitted = result;
  fit_vertices(mesh, fitted);
  const BalanceReport report = balance_vertices(mesh, result);
  const Comparison fit = compare(mesh, fitted), balanced = compare(mesh, result);
  CHECK(balanced.two_sided.rms < 1.02 * fit.two_sided.rms);
  CHECK(std::abs(report.fit.rms_after - balanced.two_sided.rms) < 0.2 * balanced.two_sided.rms + 1e-6);
  CHECK(std::abs(static_cast<double>(result.n_vertices()) - vertices) <= 2);
  CHECK(feature_distance(mesh, result) <= std::max(farthest, 5e-4 * SurfaceRef(mesh).diagonal()));
  check_sound(balanced);
  for (const auto v : result.vertices()) {
    const int face = result.property(require_property(result, property::source_face), v);
    CHECK((face >= 0 && face < static_cast<int>(mesh.n_faces())));
  }
}

TEST_CASE("a bump that the lines have missed gets vertices from the flat rest", "[balance]") {
  // A net of equal squares does not see the bump, whose error is most of what there is.
  const auto height = [](double x, double y) {
    return 0.05 * std::exp(-200 * ((x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5)));
  };
  ParametricPatch patch;
  patch.position = [&](double u, double v) { return Vec3d(u, v, height(u, v)); };
  ShapeOptions shape_options;
  shape_options.vertices = 10000;
  auto mesh = mesh_patch(patch, shape_options);
  RemeshOptions options;
  options.trace.density.adaptation = 0;
  options.target_vertices = 150;
  options.fit.enabled = false;
  auto result = remesh(mesh, options);
  PolyMesh fitted = result;
  fit_vertices(mesh, fitted);
  BalanceOptions often;  // a polygon is changed once a round, and the bump lies in few of them
  often.rounds = 5;
  balance_vertices(mesh, result, often);
  const Comparison fit = compare(mesh, fitted), balanced = compare(mesh, result);
  CHECK(balanced.two_sided.rms < 0.85 * fit.two_sided.rms);
  check_sound(balanced);
}

TEST_CASE(
    "the balance meets a number of vertices, makes no quads where none are wanted, and leaves polygons alone",
    "[balance]") {
  auto mesh = shape("wave", 3000);
  auto result = remeshed(mesh, 300);
  BalanceOptions options;
  options.target_vertices = 280;
  balance_vertices(mesh, result, options);
  CHECK(result.n_vertices() >= 279);
  CHECK(result.n_vertices() <= 281);

  RemeshOptions triangles;
  triangles.target_vertices = 200;
  triangles.mesh.max_degree = 3;
  triangles.fit.enabled = true;
  const auto without_quads = remesh(mesh, triangles);
  for (const auto f : without_quads.faces()) CHECK(f.valence() == 3);

  triangles.mesh.max_degree = 0;
  triangles.fit.enabled = false;
  auto polygons = remesh(mesh, triangles);
  const auto faces = faces_of(polygons);
  BalanceOptions any;
  any.max_degree = 0;
  balance_vertices(mesh, polygons, any);
  CHECK(faces_of(polygons) == faces);
}

TEST_CASE("no number of threads changes a bit of the balance, and a cancel leaves the result as it was",
          "[balance]") {
  auto mesh = shape("wave", 3000);
  auto result = remeshed(mesh, 300);
  PolyMesh alone = result;
  const auto before = points_of(result);
  CHECK_THROWS_AS(balance_vertices(mesh, result, {}, {}, [](double done) { return done < 0.5; }), Cancelled);
  CHECK(points_of(result) == before);
  balance_vertices(mesh, result);
  {
    tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    balance_vertices(mesh, alone);
  }
  CHECK(points_of(alone) == points_of(result));
  CHECK(faces_of(alone) == faces_of(result));
  BalanceOptions wrong;
  wrong.rounds = -1;
  CHECK_THROWS_AS(balance_vertices(mesh, result, wrong), InvalidOption);
}

TEST_CASE("balanced scans have less error than decimation by quadrics reaches", "[balance]") {
  const auto path = demo_mesh("lion-head.off");
  if (!path) return skip("lion-head.off");
  auto mesh = read_surface(*path);
  auto result = remeshed(mesh, 1000);
  balance_vertices(mesh, result);
  const Comparison c = compare(mesh, result);
  CHECK(c.two_sided.rms < 0.00060);  // OpenMesh-commandlineDecimater -M Q: 0.00062
  CHECK(c.quad_fraction > 0.75);
  check_sound(c);
}

TEST_CASE("the balance folds nothing where the input is folded as finely as the polygons are large",
          "[balance]") {
  const auto path = demo_mesh("man.off");
  if (!path) return skip("man.off");
  auto mesh = read_surface(*path);
  auto result = remeshed(mesh, 1000);
  PolyMesh fitted = result;
  fit_vertices(mesh, fitted);
  balance_vertices(mesh, result);
  const Comparison fit = compare(mesh, fitted), balanced = compare(mesh, result);
  CHECK(balanced.two_sided.rms < 0.9 * fit.two_sided.rms);
  CHECK(balanced.two_sided.hausdorff < 1.05 * fit.two_sided.hausdorff);
  check_sound(balanced);
}
