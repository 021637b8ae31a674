#include "anisomesh/smoothing.hh"

#include <algorithm>
#include <cmath>

#include "anisomesh/flatten.hh"
#include "anisomesh/shapes.hh"
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
  SECTION("on a regular mesh to rounding where no group of samples is formed") {
    auto mesh = flat_field(field, 1000);
    smooth_tensors(mesh, options);
    CHECK(max_error(mesh, field, 0.2) < 0.01);
  }
  SECTION("on a fine irregular mesh") {
    auto mesh = flat_field(field, 10000, true);
    smooth_tensors(mesh, options);
    CHECK(max_error(mesh, field, 0.2) < 0.02);
  }
}
