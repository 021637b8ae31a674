#include "anisomesh/umbilics.hh"

#include <algorithm>
#include <cmath>

#include "anisomesh/curvature.hh"
#include "anisomesh/flatten.hh"
#include "anisomesh/io.hh"
#include "anisomesh/shapes.hh"
#include "anisomesh/smoothing.hh"
#include "catch.hh"
#include "data.hh"
#include "exact_curvature.hh"
#include "field/linear_field.hh"
#include "field/umbilic_analysis.hh"
#include "numerics/tensor2d.hh"

using namespace anisomesh;
using OpenMesh::TriMesh;

namespace {

constexpr double pi = 3.14159265358979323846;

/// The ellipsoid with a small hole around its lower pole.
TriMesh opened_ellipsoid(double a, double b, double c, bool irregular) {
  ParametricPatch patch;
  patch.domain = ParametricPatch::Domain::disc;
  patch.position = [=](double u, double v) {
    const double radius = std::hypot(u, v), polar = radius * 165 * pi / 180;
    const double s = radius > 0 ? std::sin(polar) / radius : 165 * pi / 180;
    return Vec3d(a * s * u, b * s * v, c * std::cos(polar));
  };
  ShapeOptions options;
  options.vertices = 8000;
  options.irregular = irregular;
  auto mesh = mesh_patch(patch, options);
  exact::write_curvature(mesh, exact::ellipsoid(a, b, c));
  return mesh;
}

struct Umbilic {
  int kind;
  Vec3d place;
};

std::vector<Umbilic> umbilics_of(TriMesh& mesh) {
  const SurfaceRef surface = mesh;
  const auto kind = require_property(mesh, property::umbilic);
  const auto place = require_property(mesh, property::umbilic_position);
  std::vector<Umbilic> result;
  for (const auto f : mesh.faces())
    if (mesh.property(kind, f) != 0)
      result.push_back({mesh.property(kind, f), position(surface, {f, mesh.property(place, f)})});
  return result;
}

/// The linear field with deviator (a u + b v, c u + d v), as tensors at the corners of a triangle around 0.
struct LinearField {
  double a, b, c, d;
  Vec3d at(const Vec2d& p) const {
    const double alpha = a * p[0] + b * p[1], beta = c * p[0] + d * p[1];
    return {1 + alpha, beta, 1 - alpha};
  }
};

const std::array<Vec2d, 3> corners{Vec2d(2, -1), Vec2d(0.3, 1.5), Vec2d(-1.7, -0.9)};

}  // namespace

TEST_CASE("an opened ellipsoid has its four umbilics where they are known to be, all wedges", "[umbilics]") {
  const bool irregular = GENERATE(false, true);
  const double a = 1.2, b = 0.9, c = 0.6;
  auto mesh = opened_ellipsoid(a, b, c, irregular);
  flatten(mesh);
  const auto report = find_umbilics(mesh);
  CHECK(report.wedges == 4);
  CHECK(report.trisectors == 0);
  const double x = a * std::sqrt((a * a - b * b) / (a * a - c * c)),
               z = c * std::sqrt((b * b - c * c) / (a * a - c * c));
  for (const double sx : {-1.0, 1.0})
    for (const double sz : {-1.0, 1.0}) {
      double nearest = 10;
      for (const auto& umbilic : umbilics_of(mesh))
        nearest = std::min(nearest, (umbilic.place - Vec3d(sx * x, 0, sz * z)).norm());
      CHECK(nearest < 0.01);
    }
}

TEST_CASE("a monkey saddle has one trisector, at its centre", "[umbilics]") {
  ShapeOptions options;
  options.irregular = GENERATE(false, true);
  auto mesh = make_shape("monkey-saddle", options);
  exact::write_curvature(mesh, exact::monkey_saddle());
  flatten(mesh);
  const auto report = find_umbilics(mesh);
  CHECK(report.wedges == 0);
  CHECK(report.trisectors == 1);
  const auto found = umbilics_of(mesh);
  REQUIRE(found.size() == 1);
  CHECK(found.front().place.norm() < 0.01);
}

TEST_CASE("a saddle, a torus and a cylinder have no umbilics; a plane has none either", "[umbilics]") {
  const std::vector<std::pair<std::string, exact::ImplicitSurface>> shapes{{"saddle", exact::saddle()},
                                                                           {"half-torus", exact::torus()},
                                                                           {"cylinder", exact::cylinder()},
                                                                           {"plane", exact::plane()}};
  for (const auto& [name, surface] : shapes) {
    INFO(name);
    auto mesh = make_shape(name);
    exact::write_curvature(mesh, surface);
    flatten(mesh);
    const auto report = find_umbilics(mesh);
    CHECK(report.wedges + report.trisectors == 0);
    CHECK(report.border_turning == Approx(0).margin(1e-9));
  }
}

TEST_CASE("the indices add up to the turning of the field along the border", "[umbilics]") {
  std::vector<std::pair<TriMesh, double>> cases;
  cases.emplace_back(opened_ellipsoid(1, 0.8, 0.6, true), 2);
  cases.emplace_back(make_shape("monkey-saddle"), -0.5);
  exact::write_curvature(cases.back().first, exact::monkey_saddle());
  cases.emplace_back(make_shape("dome"), 1);  // a surface of revolution: the directions follow the rings
  exact::write_curvature(cases.back().first, exact::dome());
  for (auto& [mesh, turning] : cases) {
    flatten(mesh);
    const auto report = find_umbilics(mesh);
    CHECK(report.index_sum == turning);
    CHECK(report.border_turning == Approx(turning));
  }
}

TEST_CASE("a degenerate point on an edge or a vertex belongs to exactly one triangle", "[umbilics]") {
  // A fan around the origin, its deviators those of a field with the zero at the hub, or on a spoke.
  const Vec2d shift = GENERATE(Vec2d(0, 0), Vec2d(0.5, 0), Vec2d(0, 0.5), Vec2d(-0.5, 0), Vec2d(0, -0.5),
                               Vec2d(0.25, 0.25), Vec2d(0.1, 0.2));
  const bool trisector = GENERATE(false, true);
  std::vector<Vec2d> rim;
  for (const auto& p : {Vec2d(1, 0), Vec2d(1, 1), Vec2d(0, 1), Vec2d(-1, 1), Vec2d(-1, 0), Vec2d(-1, -1),
                        Vec2d(0, -1), Vec2d(1, -1)})
    rim.push_back(p);
  const auto deviator_at = [&](const Vec2d& p) {
    const Vec2d q = p - shift;
    return trisector ? Vec2d(q[0], -q[1]) : q;
  };
  int sum = 0, count = 0;
  for (size_t i = 0; i < rim.size(); ++i) {
    const int index = detail::doubled_index(
        {deviator_at({0, 0}), deviator_at(rim[i]), deviator_at(rim[(i + 1) % rim.size()])});
    sum += index;
    count += index != 0 ? 1 : 0;
  }
  CHECK(sum == (trisector ? -1 : 1));
  CHECK(count == 1);
}

TEST_CASE("lines of the field leave a degenerate point along its separatrices", "[umbilics]") {
  const auto [field, expected] = GENERATE(
      std::pair<LinearField, int>{{1, 0, 0, 1}, 1}, std::pair<LinearField, int>{{1, 0, 0, -1}, 3},
      std::pair<LinearField, int>{{0.3, 1, 2, -0.4}, 3}, std::pair<LinearField, int>{{0.2, -1, 1, 0.5}, 1},
      std::pair<LinearField, int>{{3, 0, 0, 1}, 1});
  std::array<Vec3d, 3> tensors;
  for (size_t i = 0; i < 3; ++i) tensors[i] = field.at(corners[i]);
  const std::array<Vec2d, 3> deviators{detail::deviator(tensors[0]), detail::deviator(tensors[1]),
                                       detail::deviator(tensors[2])};
  const int index = detail::doubled_index(deviators);
  CHECK(index == (expected == 3 ? -1 : 1));
  const detail::UmbilicPoint umbilic{{OpenMesh::FaceHandle(0), detail::degenerate_point(deviators)}, index};
  for (const auto kind : {LineKind::min, LineKind::max}) {
    const auto rays =
        detail::separatrix_directions({corners, tensors}, umbilic, kind, Follow::curvature, 0.1);
    CHECK(rays.size() == static_cast<size_t>(expected));
    for (const Vec2d& ray : rays) {
      const Vec3d tensor = field.at(ray);
      const Vec2d direction =
          kind == LineKind::max ? detail::max_direction(tensor) : detail::min_direction(tensor);
      CHECK(std::abs(detail::cross2(direction, ray)) < 1e-9);
    }
  }
}

TEST_CASE("with estimated tensors, too, the ellipsoid shows its four wedges", "[umbilics]") {
  auto mesh = opened_ellipsoid(1.2, 0.9, 0.6, false);
  estimate_curvature(mesh);
  flatten(mesh);
  smooth_tensors(mesh);
  const auto report = find_umbilics(mesh);
  CHECK(report.index_sum == 2);
  CHECK(report.wedges == 4);
  CHECK(report.border_turning == Approx(2));
}

TEST_CASE("on features, too, the indices add up to the turning along both sides", "[umbilics]") {
  auto mesh = make_shape("octa-flower");
  estimate_curvature(mesh);
  flatten(mesh);
  const auto report = find_umbilics(mesh);
  CHECK(report.index_sum == Approx(report.border_turning).margin(1e-9));
}

TEST_CASE("on the discs of libcgal-demo the indices add up to the turning along the border",
          "[umbilics][data]") {
  size_t total_before = 0, total_after = 0;
  for (const auto& name : demo_discs()) {
    const auto path = demo_mesh(name);
    if (!path) return skip(name);
    INFO(name);
    auto mesh = read_surface(*path);
    estimate_curvature(mesh);
    flatten(mesh);
    const auto before = find_umbilics(mesh);
    smooth_tensors(mesh);
    const auto after = find_umbilics(mesh);
    CHECK(before.index_sum == Approx(before.border_turning).margin(1e-9));
    CHECK(after.index_sum == Approx(after.border_turning).margin(1e-9));
    total_before += before.wedges + before.trisectors;
    total_after += after.wedges + after.trisectors;
  }
  CHECK(total_after < total_before);
}
