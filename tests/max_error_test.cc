// A bound on the error that holds for all points, with no more vertices than it takes.
#include "anisomesh/max_error.hh"

#include <cmath>

#include "anisomesh/compare.hh"
#include "anisomesh/properties.hh"
#include "catch.hh"
#include "fitted.hh"
#include "numerics/hausdorff.hh"
#include "sound_result.hh"

using namespace anisomesh;
using detail::Triangle;
using detail::TriangleTree;
using fitted::remeshed;
using fitted::shape;
using OpenMesh::PolyMesh;

namespace {

TriangleTree square(double height, double bump = 0) {
  return {{{0, 0, height}, {1, 0, height}, {1, 1, height}, {0, 1, height}, {0.5, 0.5, height + bump}},
          {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
}

}  // namespace

TEST_CASE("the bound between two parallel squares is their distance, and a peak is its height",
          "[max-error]") {
  const auto flat = square(0);
  const auto apart = detail::farthest_distance(square(0.25), flat, 0.2501);
  CHECK(std::abs(apart.at_least - 0.25) < 1e-12);
  CHECK(apart.at_most >= 0.25);
  CHECK(apart.at_most <= 0.2501);
  const auto peak = detail::farthest_distance(square(0, 0.1), flat, 0.1001);
  CHECK(std::abs(peak.at_least - 0.1) < 1e-12);
  CHECK(peak.at_most >= 0.1);
  CHECK(peak.at_most <= 0.1001);
  // beyond the limit it is enough to know that it is beyond
  CHECK(detail::farthest_distance(square(0, 0.1), flat, 0.05).at_least > 0.05);
}

TEST_CASE("no point that is only inside a triangle is overlooked", "[max-error]") {
  // The middle of the large triangle hangs over the gap between two others; its corners and sides do not.
  const TriangleTree plate({{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}, {{0, 1, 2}});
  const TriangleTree frame({{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0.3, 0.3, 0}, {2.3, 0.3, 0}, {0.3, 2.3, 0}},
                           {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}});
  const double inradius = (2 + 2 - std::sqrt(8)) / 2;
  const auto found = detail::farthest_distance(plate, frame, 1.01 * inradius);
  CHECK(found.at_most >= inradius);
  CHECK(found.at_most <= 1.01 * inradius);
  CHECK(detail::farthest_distance(plate, frame, 0.9 * inradius).at_least > 0.9 * inradius);
}

TEST_CASE("the distance of curves is that of their edges, whatever lies between them", "[max-error]") {
  // An edge over a bent one: the bend is 0.25 away, the ends are on it.
  const TriangleTree straight({{0, 0, 0}, {2, 0, 0}}, {{0, 1, 1}}),
      bent({{0, 0, 0}, {1, 0.25, 0}, {2, 0, 0}}, {{0, 1, 1}, {1, 2, 2}}), none({}, {});
  for (const auto& found : {detail::farthest_distance(bent, straight, 0.2501),
                            detail::farthest_distance(straight, bent, 0.2501)}) {
    CHECK(found.at_least <= found.at_most);
    CHECK(found.at_most <= 0.2501);
  }
  CHECK(std::abs(detail::farthest_distance(bent, straight, 0.2501).at_least - 0.25) < 1e-12);
  // The middle of the straight edge is nearest to where a normal of the bent one meets it.
  const double away = 0.25 / std::sqrt(1 + 0.25 * 0.25);
  CHECK(detail::farthest_distance(straight, bent, 1.01 * away).at_most >= away * (1 - 1e-12));
  CHECK(detail::farthest_distance(straight, bent, 1.01 * away).at_most <= 1.01 * away);
  CHECK(std::isinf(detail::farthest_distance(straight, none, 1).at_least));
  CHECK(detail::farthest_distance(none, straight, 1).at_most == 0);
}

TEST_CASE("a bound holds for borders and features too, and a feature that is gone misses it", "[max-error]") {
  const std::string name = GENERATE("half-torus", "octa-flower");
  INFO(name);
  auto mesh = shape(name);
  const SurfaceRef surface = mesh;
  MaxErrorOptions options;
  options.max_error_fraction = 0.01;
  const PolyMesh start = remeshed(mesh, 400);
  PolyMesh result = start;
  const MaxErrorReport report = bound_error(surface, result, options);
  REQUIRE(report.met);
  for (const auto& found : {report.border, report.features}) {
    CHECK(found.at_least <= found.at_most);
    CHECK(found.at_most <= options.max_error_fraction);
  }
  CHECK((name == "half-torus" ? report.border : report.features).at_most > 0);
  // by samples of the input's curves
  CHECK(fitted::feature_distance(surface, result) <=
        std::max(report.border.at_most, report.features.at_most) * surface.diagonal() * (1 + 1e-9));
  if (name == "half-torus") return;
  PolyMesh bare = start;
  const auto kind = require_property(bare, property::edge_kind);
  for (const auto e : bare.edges()) {
    bare.status(e).set_feature(false);
    bare.property(kind, e) = static_cast<int>(EdgeKind::conforming);
  }
  const MaxErrorReport missed = bound_error(surface, bare, options);
  CHECK(!missed.met);
  CHECK(missed.at_most <= options.max_error_fraction);
  CHECK(std::isinf(missed.features.at_least));
}

TEST_CASE("a bound is met, verified, and takes fewer vertices where it is looser", "[max-error]") {
  auto mesh = shape("torus", 3000);
  const auto start = remeshed(mesh, 300);
  size_t fewer = start.n_vertices() * 100;
  for (const double bound : {0.006, 0.015}) {
    INFO(bound);
    PolyMesh result = start;
    MaxErrorOptions options;
    options.max_error_fraction = bound;
    const MaxErrorReport report = bound_error(mesh, result, options);
    const Comparison c = compare(mesh, result);
    CHECK(report.met);
    CHECK(report.at_least <= report.at_most);
    CHECK(report.at_most <= bound);
    CHECK(c.two_sided.hausdorff <= bound);
    CHECK(c.two_sided.hausdorff <= report.at_most * (1 + 1e-9));
    CHECK(result.n_vertices() < fewer);
    fewer = result.n_vertices();
    check_sound(c);
  }
}

TEST_CASE("remesh() traces as finely as a bound needs, and takes no target beside it", "[max-error]") {
  auto mesh = shape("wave", 1000);
  RemeshOptions options;
  options.max_error.max_error_fraction = 0.002;
  RemeshReport report;
  auto result = remesh(mesh, options, &report);
  CHECK(report.max_error.met);
  CHECK(compare(mesh, result).two_sided.hausdorff <= 0.002);
  options.target_vertices = 100;
  CHECK_THROWS_AS(remesh(mesh, options), InvalidOption);
}
