// The tensor field on the surface itself: its domain, smoothing and umbilics.
#include <cmath>
#include <set>

#include "anisomesh/domain.hh"
#include "anisomesh/io.hh"
#include "anisomesh/lines.hh"
#include "anisomesh/properties.hh"
#include "catch.hh"
#include "data.hh"
#include "surface_stages.hh"

using namespace anisomesh;
using on_surface::euler;
using on_surface::prepare;
using on_surface::shape;

TEST_CASE("an ellipsoid has its four umbilics where they are known to be, all wedges", "[surface-domain]") {
  const bool irregular = GENERATE(false, true);
  auto mesh = shape("ellipsoid", 12000, irregular);
  const SurfaceRef surface = mesh;
  const auto report = find_umbilics(mesh);
  CHECK(report.wedges == 4);
  CHECK(report.trisectors == 0);
  CHECK(report.index_sum == 2);
  CHECK(report.border_turning == Approx(2));
  const double a = 1, b = 0.6, c = 0.35;
  const double x = a * std::sqrt((a * a - b * b) / (a * a - c * c)),
               z = c * std::sqrt((b * b - c * c) / (a * a - c * c));
  std::set<std::pair<bool, bool>> found;
  const auto kind = require_property(mesh, property::umbilic);
  const auto where = require_property(mesh, property::umbilic_position);
  for (const auto f : mesh.faces()) {
    if (mesh.property(kind, f) == 0) continue;
    const Vec3d p = position(surface, {f, mesh.property(where, f)});
    CHECK((Vec3d(std::abs(p[0]), p[1], std::abs(p[2])) - Vec3d(x, 0, z)).norm() < 0.015 * surface.diagonal());
    found.insert({p[0] > 0, p[2] > 0});
  }
  CHECK(found.size() == 4);
}

TEST_CASE("the indices of a closed surface add up to its Euler characteristic, noise or not",
          "[surface-domain]") {
  for (const auto& name : closed_shape_names())
    for (const double noise : {0.0, 0.003}) {
      INFO(name << ", noise " << noise);
      ShapeOptions options;
      options.vertices = 2000;
      options.irregular = true;
      options.noise = noise;
      auto mesh = make_shape(name, options);
      for (const auto e : mesh.edges()) mesh.status(e).set_feature(false);
      estimate_curvature(mesh);
      smooth_tensors(mesh, {0});
      const auto report = find_umbilics(mesh);
      CHECK(report.index_sum == static_cast<double>(euler(mesh)));
      CHECK(report.border_turning == Approx(static_cast<double>(euler(mesh))).margin(1e-9));
    }
}

TEST_CASE("on real closed surfaces of any genus, too, the indices add up to the Euler characteristic",
          "[surface-domain][data]") {
  for (const char* name : {"refined_elephant.off", "cow.off", "hand.off", "3torus.off", "cheese.off",
                           "knot1.off", "bones.off", "turbine.off", "anchor_dense.off"}) {
    const auto path = demo_mesh(name);
    if (!path) return skip(name);
    INFO(name);
    auto mesh = read_surface(*path);
    prepare(mesh);
    const auto report = find_umbilics(mesh);
    CHECK(report.index_sum == static_cast<double>(euler(mesh)));
  }
}

TEST_CASE("with borders and features the indices add up to the turning along them", "[surface-domain]") {
  for (const char* name : {"octa-flower", "half-torus", "monkey-saddle", "cube"}) {
    INFO(name);
    auto mesh = shape(name, 3000);
    const auto report = find_umbilics(mesh);
    CHECK(report.index_sum == Approx(report.border_turning).margin(1e-9));
  }
}

TEST_CASE("a disc that flattens goes to the plane, everything else to the surface", "[surface-domain]") {
  auto dome = make_shape("dome", {800});
  estimate_curvature(dome);
  CHECK(choose_domain(dome).used == Domain::plane);
  CHECK(has_property(dome, property::uv));
  const auto to_surface = choose_domain(dome, Domain::surface);
  CHECK(to_surface.used == Domain::surface);
  CHECK(to_surface.reason.empty());
  CHECK(!has_property(dome, property::uv));
  CHECK(!has_property(dome, property::tensor2d));
  auto torus = make_shape("torus", {800});
  estimate_curvature(torus);
  const auto chosen = choose_domain(torus);
  CHECK(chosen.used == Domain::surface);
  CHECK_THAT(chosen.reason, Catch::Contains("not a disc"));
  CHECK_THROWS_AS(choose_domain(torus, Domain::plane), CannotProcess);
  auto bare = make_shape("torus", {800});
  CHECK_THROWS_AS(choose_domain(bare), InvalidInput);
}

TEST_CASE("stages on the surface say what is missing", "[surface-domain]") {
  auto mesh = make_shape("sphere", {500});
  CHECK_THROWS_WITH(smooth_tensors(mesh), Catch::Contains("estimate_curvature"));
  estimate_curvature(mesh);
  CHECK_THROWS_WITH(find_umbilics(mesh), Catch::Contains("smooth_tensors"));
  CHECK_THROWS_AS(smooth_tensors(mesh, {}, [](double done) { return done < 0.3; }), Cancelled);
  CHECK(!has_property(mesh, property::surface_tensor));
  smooth_tensors(mesh);
  CHECK_THROWS_WITH(trace_lines(mesh), Catch::Contains("find_umbilics"));
}

TEST_CASE("smoothing on the surface lowers the noise and keeps what is smooth", "[surface-domain]") {
  ShapeOptions options;
  options.vertices = 8000;
  options.irregular = true;
  const auto error_of = [](OpenMesh::TriMesh& mesh, int iterations) {
    SmoothingOptions smoothing;
    smoothing.iterations = iterations;
    smoothing.radius_fraction = 0.03;
    smooth_tensors(mesh, smoothing);
    const auto tensor = require_property(mesh, property::surface_tensor);
    double sum = 0;
    for (const auto v : mesh.vertices()) {
      const Vec3d p = mesh.point(v);
      const double axis = std::hypot(p[0], p[1]);
      const Vec3d around(-p[1] / axis, p[0] / axis, 0);
      // The curvature along the ring: cos(tube angle) / distance from the axis.
      const auto& t = mesh.property(tensor, v);
      const double k = around[0] * (t[0] * around[0] + 2 * t[1] * around[1]) + t[3] * around[1] * around[1];
      sum += std::abs(k - (axis - 1) / 0.4 / axis);
    }
    return sum / static_cast<double>(mesh.n_vertices());
  };
  auto clean = make_shape("torus", options);
  estimate_curvature(clean);
  CHECK(error_of(clean, 3) < 0.05);
  options.noise = 0.001;
  auto noisy = make_shape("torus", options);
  estimate_curvature(noisy);
  const double before = error_of(noisy, 0);
  CHECK(error_of(noisy, 3) < 0.6 * before);
}

TEST_CASE("faces without area do no harm", "[surface-domain]") {
  auto mesh = make_shape("torus", {3000, true});
  // Each hundredth edge is split at one of its ends: faces without area, edges without length.
  std::vector<OpenMesh::EdgeHandle> edges;
  for (const auto e : mesh.edges())
    if (e.idx() % 100 == 0) edges.push_back(e);
  for (const auto e : edges) {
    const Vec3d end = mesh.point(mesh.from_vertex_handle(mesh.halfedge_handle(e, 0)));
    mesh.split(e, end);  // no reference: the points move when there is one more
  }
  prepare(mesh);
  CHECK(find_umbilics(mesh).index_sum == 0);
  const auto report = trace_lines(mesh);
  place_isotropic_samples(mesh);
  CHECK(report.min_lines > 10);
  CHECK(report.max_lines > 10);
  for (const Line& line : read_lines(mesh).lines)
    for (const auto& p : line.points) {
      CHECK(std::isfinite(p.barycentric[0] + p.barycentric[1] + p.barycentric[2]));
      CHECK(p.barycentric.min() >= 0);
    }
}
