#include "anisomesh/smoothing.hh"

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "anisomesh/errors.hh"
#include "anisomesh/flatten.hh"
#include "anisomesh/shapes.hh"
#include "anisomesh/umbilics.hh"
#include "catch.hh"
#include "exact_curvature.hh"
#include "numerics/tensor2d.hh"

using namespace anisomesh;
using OpenMesh::TriMesh;

namespace {

/// A flat square of side 2, flattened (onto itself, moved and turned), its tensors set by a function of (u,
/// v).
template <class Field>
TriMesh flat_field(Field&& field, int vertices = 4000, bool irregular = false) {
  ShapeOptions options;
  options.vertices = vertices;
  options.irregular = irregular;
  auto mesh = make_shape("plane", options);
  exact::write_curvature(mesh, exact::plane());
  flatten(mesh);
  const auto uv = require_property(mesh, property::uv);
  const auto tensor2d = require_property(mesh, property::tensor2d);
  for (const auto v : mesh.vertices()) mesh.property(tensor2d, v) = field(mesh.property(uv, v));
  return mesh;
}

std::vector<Vec3d> tensors_of(const TriMesh& mesh) {
  const auto tensor2d = require_property(mesh, property::tensor2d);
  std::vector<Vec3d> result;
  for (const auto v : mesh.vertices()) result.push_back(mesh.property(tensor2d, v));
  return result;
}

/// Largest difference from `expected` over the vertices whose distance to the border is at least `margin`.
template <class Field>
double max_error(const TriMesh& mesh, Field&& expected, double margin) {
  const auto uv = require_property(mesh, property::uv);
  const auto tensors = tensors_of(mesh);
  double worst = 0;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    if (1 - std::max(std::abs(p[0]), std::abs(p[1])) < margin) continue;
    worst = std::max(worst, detail::frobenius_norm(tensors[v.idx()] - expected(mesh.property(uv, v))));
  }
  return worst;
}

/// A flat square with one tensor left of x = 0, another right of it and their mean on it.
const Vec3d left_tensor(1, 0, 3), right_tensor(-2, 1, 0);
Vec3d step(double x) {
  return std::abs(x) < 1e-9 ? 0.5 * (left_tensor + right_tensor) : x < 0 ? left_tensor : right_tensor;
}

TriMesh step_field(bool tag_the_step) {
  // A regular grid over [-1, 1]^2 with a column of vertices at x = 0.
  constexpr int cells = 30;
  TriMesh mesh;
  mesh.request_edge_status();
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) mesh.add_vertex({2.0 * i / cells - 1, 2.0 * j / cells - 1, 0});
  const auto at = [](int i, int j) { return OpenMesh::VertexHandle(j * (cells + 1) + i); };
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.add_face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  if (tag_the_step)
    for (int j = 0; j < cells; ++j)
      mesh.status(mesh.edge_handle(mesh.find_halfedge(at(cells / 2, j), at(cells / 2, j + 1))))
          .set_feature(true);
  exact::write_curvature(mesh, exact::plane());
  flatten(mesh);
  const auto tensor2d = require_property(mesh, property::tensor2d);
  for (const auto v : mesh.vertices()) mesh.property(tensor2d, v) = step(mesh.point(v)[0]);
  return mesh;
}

double max_error_of_step(const TriMesh& mesh) {
  const auto tensors = tensors_of(mesh);
  double worst = 0;
  for (const auto v : mesh.vertices())
    if (std::abs(mesh.point(v)[0]) > 1e-9)  // on the step itself there is no one right value
      worst = std::max(worst, detail::frobenius_norm(tensors[v.idx()] - step(mesh.point(v)[0])));
  return worst;
}

/// A half torus with exact tensors, then noise on each coefficient.
TriMesh noisy_torus() {
  ShapeOptions shape;
  shape.vertices = 8000;
  shape.irregular = true;
  auto mesh = make_shape("half-torus", shape);
  exact::write_curvature(mesh, exact::torus());
  flatten(mesh);
  std::mt19937 generator(7);
  const auto tensor2d = require_property(mesh, property::tensor2d);
  for (const auto v : mesh.vertices())
    for (int k = 0; k < 3; ++k)
      mesh.property(tensor2d, v)[k] += 6.0 * (static_cast<double>(generator()) / 4294967296.0 - 0.5);
  return mesh;
}

/// Mean angle between the directions of two fields on the same vertices, degrees.
double mean_angle(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i)
    sum += std::asin(
        std::min(1.0, std::abs(detail::cross2(detail::max_direction(a[i]), detail::max_direction(b[i])))));
  return sum / static_cast<double>(a.size()) * 180 / 3.14159265358979323846;
}

}  // namespace

TEST_CASE("smoothing keeps a constant field", "[smoothing]") {
  const bool anisotropic = GENERATE(false, true);
  const auto field = [](const Vec2d&) { return Vec3d(3, 1, -2); };
  auto mesh = flat_field(field, 2000, true);
  SmoothingOptions options;
  options.radius_fraction = 0.05;
  options.anisotropic = anisotropic;
  const auto report = smooth_tensors(mesh, options);
  CHECK(max_error(mesh, field, 0) < 1e-12);
  CHECK(report.mean_change < 1e-12);
}

TEST_CASE("smoothing nearly keeps a linear field away from the border", "[smoothing]") {
  const auto field = [](const Vec2d& p) { return Vec3d(p[0], 0.5 * p[1], 1 - p[0]); };
  SmoothingOptions options;
  options.radius_fraction = 0.05;  // 0.14 in a square of side 2
  options.iterations = 1;
  const bool irregular = GENERATE(false, true);
  auto mesh = flat_field(field, irregular ? 10000 : 1000, irregular);
  smooth_tensors(mesh, options);
  CHECK(max_error(mesh, field, 0.2) < (irregular ? 0.02 : 0.01));
}

TEST_CASE("smoothing raises a paraboloid by the second moment of its kernel", "[smoothing]") {
  // The mean of r^2 under exp(-2 q^2) - exp(-2), q = r / R, over the disc.
  double moment = 0, mass = 0;
  for (int i = 0; i < 2000; ++i) {
    const double q = (i + 0.5) / 2000, weight = q * (std::exp(-2 * q * q) - std::exp(-2.0));
    moment += weight * q * q;
    mass += weight;
  }
  SmoothingOptions options;
  options.radius_fraction = 0.08;
  options.iterations = GENERATE(1, 3);
  const double radius = options.radius_fraction * std::sqrt(8.0);  // of a square, as long as its diagonal
  const double rise = options.iterations * moment / mass * radius * radius;
  auto mesh = flat_field([](const Vec2d& p) { return Vec3d(p.sqrnorm(), 0, 0); }, 20000, true);
  smooth_tensors(mesh, options);
  const auto uv = require_property(mesh, property::uv);
  const auto tensors = tensors_of(mesh);
  double sum = 0;
  int count = 0;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    if (1 - std::max(std::abs(p[0]), std::abs(p[1])) < options.iterations * radius) continue;
    sum += tensors[v.idx()][0] - mesh.property(uv, v).sqrnorm();
    ++count;
  }
  REQUIRE(count > 100);
  CHECK(sum / count == Approx(rise).epsilon(0.1));  // groups of samples widen the kernel a little
}

TEST_CASE("smoothing does not cross a feature", "[smoothing]") {
  SmoothingOptions options;
  options.radius_fraction = 0.1;
  auto open = step_field(false), cut = step_field(true);
  smooth_tensors(open, options);
  smooth_tensors(cut, options);
  CHECK(max_error_of_step(open) > 0.5);
  CHECK(max_error_of_step(cut) < 1e-12);
  const SurfaceRef surface = cut;
  const auto corners = corner_tensors(surface);
  double worst = 0;
  for (const auto f : cut.faces()) {
    const auto c = surface.corners(f);
    const double x =
        (surface.point(c.vertex[0])[0] + surface.point(c.vertex[1])[0] + surface.point(c.vertex[2])[0]);
    for (size_t i = 0; i < 3; ++i)
      worst = std::max(worst, detail::frobenius_norm(corners[f.idx()][i] - step(x)));
  }
  CHECK(worst < 1e-12);  // at the feature's own vertices, too: one-sided
}

TEST_CASE("the anisotropic filter keeps a step that the Gaussian blurs", "[smoothing]") {
  SmoothingOptions options;
  options.radius_fraction = 0.1;
  auto gaussian = step_field(false), anisotropic = step_field(false);
  smooth_tensors(gaussian, options);
  options.anisotropic = true;
  smooth_tensors(anisotropic, options);
  const auto mean_error = [](const TriMesh& mesh) {
    double sum = 0;
    const auto tensors = tensors_of(mesh);
    for (const auto v : mesh.vertices())
      sum += detail::frobenius_norm(tensors[v.idx()] - step(mesh.point(v)[0]));
    return sum;
  };
  CHECK(mean_error(anisotropic) < 0.5 * mean_error(gaussian));
}

TEST_CASE("smoothing takes noise off the directions and umbilics with it", "[smoothing]") {
  ShapeOptions shape;
  shape.vertices = 8000;
  shape.irregular = true;
  auto clean = make_shape("half-torus", shape);
  exact::write_curvature(clean, exact::torus());
  flatten(clean);
  auto mesh = noisy_torus();
  const auto truth = tensors_of(clean);
  const double before = mean_angle(tensors_of(mesh), truth);
  const auto umbilics_before = find_umbilics(mesh);
  SmoothingOptions options;
  options.radius_fraction = 0.1 / SurfaceRef(mesh).extent();
  options.anisotropic = GENERATE(false, true);
  smooth_tensors(mesh, options);
  const auto umbilics_after = find_umbilics(mesh);
  CHECK(before > 10);
  CHECK(mean_angle(tensors_of(mesh), truth) < (options.anisotropic ? 0.5 : 0.25) * before);
  CHECK(umbilics_before.wedges + umbilics_before.trisectors > 100);
  CHECK(umbilics_after.wedges + umbilics_after.trisectors <
        (umbilics_before.wedges + umbilics_before.trisectors) / 10);
  CHECK(umbilics_after.index_sum == Approx(umbilics_after.border_turning).margin(1e-9));
}

TEST_CASE("smoothing does not depend on the number of threads", "[smoothing]") {
  auto one = noisy_torus(), many = noisy_torus();
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    smooth_tensors(one);
  }
  smooth_tensors(many);
  CHECK(tensors_of(one) == tensors_of(many));
}

TEST_CASE("smoothing follows the scale of the surface", "[smoothing]") {
  const double scale = GENERATE(1e-6, 1e6);
  auto mesh = noisy_torus(), scaled = noisy_torus();
  for (const auto v : scaled.vertices()) scaled.set_point(v, scale * mesh.point(v));
  const auto uv = require_property(scaled, property::uv);
  const auto tensor2d = require_property(scaled, property::tensor2d);
  for (const auto v : scaled.vertices()) {
    scaled.property(uv, v) *= scale;
    scaled.property(tensor2d, v) /= scale;
  }
  smooth_tensors(mesh);
  smooth_tensors(scaled);
  const auto a = tensors_of(mesh), b = tensors_of(scaled);
  double worst = 0;
  for (size_t i = 0; i < a.size(); ++i) worst = std::max(worst, detail::frobenius_norm(a[i] - scale * b[i]));
  CHECK(worst < 1e-9);
}

TEST_CASE("smoothing checks its options, and changes nothing when it fails or has nothing to do",
          "[smoothing]") {
  auto mesh = noisy_torus();
  const auto before = tensors_of(mesh);
  SmoothingOptions options;
  options.iterations = -1;
  CHECK_THROWS_AS(smooth_tensors(mesh, options), InvalidOption);
  options.iterations = 3;
  options.radius_fraction = 0;
  CHECK_THROWS_AS(smooth_tensors(mesh, options), InvalidOption);
  options.radius_fraction = 0.01;
  CHECK_THROWS_AS(smooth_tensors(mesh, options, [](double done) { return done < 0.3; }), Cancelled);
  options.iterations = 0;
  CHECK(smooth_tensors(mesh, options).mean_change == 0);
  CHECK(tensors_of(mesh) == before);
  auto bare = make_shape("dome");
  CHECK_THROWS_WITH(smooth_tensors(bare), Catch::Contains("run estimate_curvature() first"));
}
