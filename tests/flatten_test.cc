#include "anisomesh/flatten.hh"

#include <algorithm>
#include <cmath>

#include "anisomesh/shapes.hh"
#include "catch.hh"
#include "exact_curvature.hh"
#include "numerics/tensor2d.hh"

using namespace anisomesh;
using OpenMesh::TriMesh;

namespace {

TriMesh shape(const std::string& name, int vertices, bool irregular) {
  ShapeOptions options;
  options.vertices = vertices;
  options.irregular = irregular;
  auto mesh = make_shape(name, options);
  exact::write_curvature(mesh, exact::plane());  // for tests that look at the map only
  return mesh;
}

std::vector<Vec2d> map_of(const TriMesh& mesh) {
  const auto uv = require_property(mesh, property::uv);
  std::vector<Vec2d> map;
  for (const auto v : mesh.vertices()) map.push_back(mesh.property(uv, v));
  return map;
}

double plane_area(const SurfaceRef& surface, const std::vector<Vec2d>& map, OpenMesh::FaceHandle face) {
  const auto c = surface.corners(face);
  const auto& a = map[c.vertex[0].idx()];
  return 0.5 * detail::cross2(map[c.vertex[1].idx()] - a, map[c.vertex[2].idx()] - a);
}

/// Every pair of border edges without a common vertex, by brute force.
bool border_crosses_itself(const TriMesh& mesh, const std::vector<Vec2d>& map) {
  std::vector<std::pair<int, int>> edges;
  for (const auto e : mesh.edges())
    if (e.is_boundary()) edges.emplace_back(e.v0().idx(), e.v1().idx());
  const auto side = [&](int a, int b, int c) { return detail::cross2(map[b] - map[a], map[c] - map[a]) > 0; };
  for (size_t i = 0; i < edges.size(); ++i)
    for (size_t j = i + 1; j < edges.size(); ++j) {
      const auto [a, b] = edges[i];
      const auto [c, d] = edges[j];
      if (a == c || a == d || b == c || b == d) continue;
      if (side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b)) return true;
    }
  return false;
}

void require_one_to_one(TriMesh& mesh) {
  const SurfaceRef surface = mesh;
  const auto map = map_of(mesh);
  int flipped = 0;
  for (const auto f : mesh.faces()) flipped += plane_area(surface, map, f) > 0 ? 0 : 1;
  CHECK(flipped == 0);
  CHECK_FALSE(border_crosses_itself(mesh, map));
}

double max_edge_error(const TriMesh& mesh) {
  const auto map = map_of(mesh);
  double worst = 0;
  for (const auto e : mesh.edges()) {
    const double length = (mesh.point(e.v1()) - mesh.point(e.v0())).norm();
    worst = std::max(worst, std::abs((map[e.v1().idx()] - map[e.v0().idx()]).norm() / length - 1));
  }
  return worst;
}

}  // namespace

TEST_CASE("every shape is flattened one to one, with its area", "[flatten]") {
  for (const auto& name : shape_names())
    for (const bool irregular : {false, true}) {
      INFO(name << (irregular ? ", irregular" : ""));
      auto mesh = shape(name, 1500, irregular);
      const SurfaceRef surface = mesh;
      const auto report = flatten(surface);
      require_one_to_one(mesh);
      double plane = 0, area = 0;
      const auto map = map_of(mesh);
      for (const auto f : mesh.faces()) {
        const auto c = surface.corners(f);
        area += 0.5 * ((surface.point(c.vertex[1]) - surface.point(c.vertex[0])) %
                       (surface.point(c.vertex[2]) - surface.point(c.vertex[0])))
                          .norm();
        plane += plane_area(surface, map, f);
      }
      CHECK(plane == Approx(area));
      CHECK(report.mean_conformal_distortion < 1.1);
      CHECK(report.min_area_stretch > 0);
    }
}

TEST_CASE("developable surfaces are flattened isometrically", "[flatten]") {
  const std::string name = GENERATE("plane", "cylinder");
  const bool irregular = GENERATE(false, true);
  INFO(name << (irregular ? ", irregular" : ""));
  auto mesh = shape(name, 2000, irregular);
  const auto report = flatten(mesh);
  // The inscribed polyhedron of a regular cylinder grid is itself developable; an irregular one nearly is.
  const double tolerance = name == "cylinder" && irregular ? 0.02 : 1e-9;
  CHECK(max_edge_error(mesh) < tolerance);
  CHECK(report.max_conformal_distortion < 1 + tolerance);
  CHECK(report.free_boundary);
  CHECK(report.repaired_triangles == 0);
}

TEST_CASE("tensors keep their eigenvalues in the plane", "[flatten]") {
  auto mesh = shape("half-torus", 2000, true);
  exact::write_curvature(mesh, exact::torus());
  flatten(mesh);
  const auto tensor2d = require_property(mesh, property::tensor2d);
  double worst = 0;
  for (const auto v : mesh.vertices()) {
    double low = 0, high = 0;
    detail::eigenvalues(mesh.property(tensor2d, v), low, high);
    const double distance = std::hypot(mesh.point(v)[0], mesh.point(v)[1]);
    worst = std::max({worst, std::abs(low - (distance - 1) / 0.4 / distance), std::abs(high - 1 / 0.4)});
  }
  CHECK(worst < 1e-9);
}
