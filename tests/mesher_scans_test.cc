// The mesher on networks of real lines: promises that hold for every input.
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "anisomesh/compare.hh"
#include "anisomesh/curvature.hh"
#include "anisomesh/features.hh"
#include "anisomesh/flatten.hh"
#include "anisomesh/io.hh"
#include "anisomesh/lines.hh"
#include "anisomesh/mesher.hh"
#include "anisomesh/properties.hh"
#include "anisomesh/remesh.hh"
#include "anisomesh/shapes.hh"
#include "anisomesh/smoothing.hh"
#include "anisomesh/umbilics.hh"
#include "catch.hh"
#include "data.hh"
#include "sound_result.hh"

using namespace anisomesh;

namespace {

/// With lengths in fractions of the diagonal, so that the lines do not hang on what is chosen by default.
void trace(OpenMesh::TriMesh& mesh, double epsilon) {
  const SurfaceRef surface = mesh;
  const double diagonal = surface.diagonal() / surface.extent();
  CurvatureOptions curvature;
  SmoothingOptions smoothing;
  TraceOptions options;
  curvature.radius_fraction = smoothing.radius_fraction = 0.01 * diagonal;
  options.density.max_spacing_fraction = 0.2 * diagonal;
  options.density.epsilon_fraction = epsilon;
  estimate_curvature(surface, curvature);
  flatten(surface);
  smooth_tensors(surface, smoothing);
  find_umbilics(surface);
  trace_lines(surface, options);
  place_isotropic_samples(surface, options);
}

Comparison compared(OpenMesh::TriMesh& mesh, OpenMesh::PolyMesh& result) {
  CompareOptions options;
  options.samples = 4000;
  return compare(SurfaceRef(mesh), result, options);
}

void check_sound(OpenMesh::TriMesh& mesh, OpenMesh::PolyMesh& result, int max_degree) {
  const Comparison comparison = compared(mesh, result);
  ::check_sound(comparison);
  if (max_degree > 0)
    for (const auto& [degree, count] : comparison.faces_by_degree) CHECK(degree <= max_degree);
}

// Every corner of the border and the features is a vertex of the result, exactly.
void check_corners(OpenMesh::TriMesh& mesh, const OpenMesh::PolyMesh& result) {
  const SurfaceRef surface = mesh;
  std::set<std::array<double, 3>> places;
  for (const auto v : result.vertices())
    places.insert({result.point(v)[0], result.point(v)[1], result.point(v)[2]});
  for (const auto v : feature_skeleton(surface).corners) {
    const Vec3d p = surface.point(v);
    CHECK(places.count({p[0], p[1], p[2]}) == 1);
  }
}

}  // namespace

TEST_CASE("polygons of real scans are sound", "[mesher][scans]") {
  const std::string name = GENERATE(from_range(demo_discs()));
  const auto path = demo_mesh(name);
  if (!path) return skip(name);
  CAPTURE(name);
  OpenMesh::TriMesh mesh = read_surface(*path);
  trace(mesh, 0.002);
  for (const int max_degree : {4, 0, 3, 6}) {
    CAPTURE(max_degree);
    MeshOptions options;
    options.max_degree = max_degree;
    MeshReport report;
    OpenMesh::PolyMesh result = build_polygons(SurfaceRef(mesh), options, &report);
    check_sound(mesh, result, max_degree);
    check_corners(mesh, result);
    if (max_degree == 4) CHECK(report.retries == 0);
  }
}

TEST_CASE("three quarters of the faces of a scan are quads where lines resolve it", "[mesher][scans]") {
  const auto name = GENERATE(as<std::string>{}, "mannequin-devil.off", "lion-head.off");
  const auto path = demo_mesh(name);
  if (!path) return skip(name);
  CAPTURE(name);
  OpenMesh::TriMesh mesh = read_surface(*path);
  trace(mesh, 0.0003);  // 3,000 to 6,000 faces, about as many as the figures of the README have
  MeshReport report;
  OpenMesh::PolyMesh result = build_polygons(SurfaceRef(mesh), {}, &report);
  CHECK(report.faces > 3000);
  CHECK(report.quads > 3 * report.triangles);
  CHECK(report.retries == 0);
  check_sound(mesh, result, 4);
}

TEST_CASE("polygons of shapes are sound with any options", "[mesher]") {
  const std::string name = GENERATE(as<std::string>{}, "octa-flower", "hemisphere", "saddle", "wave");
  CAPTURE(name);
  ShapeOptions shape;
  shape.vertices = 4000;
  shape.irregular = true;
  OpenMesh::TriMesh mesh = make_shape(name, shape);
  trace(mesh, 0.003);
  std::vector<MeshOptions> variants(6);
  variants[1].chain_tolerance = variants[1].cell_tolerance = std::numeric_limits<double>::infinity();
  variants[2].merge_fraction = 0;
  variants[3].flip_edges = variants[3].join_lines = false;
  variants[4].max_degree = 0;
  variants[4].convex = false;
  variants[5].max_bend_degrees = 5;
  for (size_t i = 0; i < variants.size(); ++i) {
    CAPTURE(i);
    OpenMesh::PolyMesh result = build_polygons(SurfaceRef(mesh), variants[i]);
    check_corners(mesh, result);
    if (variants[i].convex) check_sound(mesh, result, variants[i].max_degree);
  }
}

TEST_CASE("the result is the same with one thread and with several", "[mesher]") {
  ShapeOptions shape;
  shape.vertices = 4000;
  OpenMesh::TriMesh mesh = make_shape("squeezed-dome", shape);
  trace(mesh, 0.001);
  std::vector<OpenMesh::PolyMesh> results;
  for (const size_t threads : {1, 4}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(build_polygons(SurfaceRef(mesh)));
  }
  REQUIRE(results[0].n_vertices() == results[1].n_vertices());
  REQUIRE(results[0].n_faces() == results[1].n_faces());
  for (const auto v : results[0].vertices()) CHECK(results[0].point(v) == results[1].point(v));
  for (const auto f : results[0].faces()) {
    std::vector<int> first, second;
    for (const auto v : results[0].fv_range(f)) first.push_back(v.idx());
    for (const auto v : results[1].fv_range(f)) second.push_back(v.idx());
    CHECK(first == second);
  }
}

TEST_CASE("a smaller cell tolerance brings the result nearer to the surface", "[mesher]") {
  ShapeOptions shape;
  shape.vertices = 6000;
  OpenMesh::TriMesh mesh = make_shape("monkey-saddle", shape);
  trace(mesh, 0.004);
  double before = std::numeric_limits<double>::infinity();
  size_t vertices = 0;
  for (const double tolerance : {8.0, 0.7, 0.2}) {
    MeshOptions options;
    options.cell_tolerance = options.chain_tolerance = tolerance;
    OpenMesh::PolyMesh result = build_polygons(SurfaceRef(mesh), options);
    const double error = compared(mesh, result).two_sided.rms;
    CHECK(error < before);
    CHECK(result.n_vertices() > vertices);
    before = error;
    vertices = result.n_vertices();
  }
}

// Beside a thin sheet the place that is found from a polygon's corners is farther off than the nearest one,
// and what is far may face any way.
TEST_CASE("without the fit no polygon is folded as the ruler sees it", "[mesher][scans]") {
  for (const auto& [name, epsilon] : {std::pair{"lion-head.off", 0.001}, {"mannequin-devil.off", 0.0008}}) {
    const auto path = demo_mesh(name);
    if (!path) return skip(name);
    auto mesh = read_surface(*path);
    RemeshOptions options;
    options.fit.enabled = false;
    options.trace.density.epsilon_fraction = epsilon;
    auto result = remesh(mesh, options);
    INFO(name);
    CHECK(compared(mesh, result).folded_faces == 0);
  }
}
