// Lines that follow the direction of minimum absolute curvature, against asymptotic lines in closed form.
#include <algorithm>
#include <cmath>

#include "anisomesh/remesh.hh"
#include "catch.hh"
#include "hyperboloid.hh"
#include "sound_result.hh"
#include "traced_surface.hh"

using namespace anisomesh;

namespace {

constexpr double degrees = 180 / M_PI;

TraceOptions min_abs(double epsilon_fraction) {
  TraceOptions options;
  options.density.epsilon_fraction = epsilon_fraction;
  options.follow = Follow::min_abs;
  return options;
}

double along(const Vec3d& tensor, const Vec2d& d) {
  return tensor[0] * d[0] * d[0] + 2 * tensor[1] * d[0] * d[1] + tensor[2] * d[1] * d[1];
}

/// In the plane or on the surface, as far as trace_lines() needs it.
void prepare(OpenMesh::TriMesh& mesh, bool plane) {
  estimate_curvature(mesh);
  if (plane) flatten(mesh);
  smooth_tensors(mesh);
  find_umbilics(mesh);
}

/// Of each piece of the lines of a kind, away from their ends and the border: its angle to the nearer of the
/// wanted directions where it is.
std::vector<double> off(const SurfaceRef& surface, LineKind kind,
                        const std::function<std::vector<Vec3d>(const Vec3d&)>& wanted) {
  std::vector<double> angles;
  for (const Line& line : read_lines(surface).lines) {
    if (line.kind != kind) continue;
    for (size_t i = 2; i + 2 < line.points.size(); ++i) {
      const Vec3d a = position(surface, line.points[i - 1]), b = position(surface, line.points[i]);
      double least = 90;
      for (const Vec3d& w : wanted(0.5 * (a + b)))
        least = std::min(least, std::atan2(cross(b - a, w).norm(), std::abs((b - a) | w)) * degrees);
      angles.push_back(least);
    }
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

double at_share(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<size_t>(share * static_cast<double>(sorted.size() - 1))];
}

}  // namespace

TEST_CASE("the turned tensor has what was nearer to 0 where there is no curvature, and turns continuously",
          "[follow]") {
  const Vec2d axis(std::cos(0.7), std::sin(0.7));
  for (const double other : {-3.0, -1.5, -1.01, -1.0, -0.99, -0.3, -1e-3}) {
    const Vec3d tensor = detail::tensor_from(other, 1, axis);
    const Vec3d turned = detail::turned_to_asymptotic(tensor);
    double k_min = 0, k_max = 0;
    detail::eigenvalues(turned, k_min, k_max);
    CHECK(k_min == Approx(other));
    CHECK(k_max == Approx(1));
    const Vec2d flat = other > -1 ? detail::min_direction(turned) : detail::max_direction(turned);
    CHECK(along(tensor, flat) == Approx(0).margin(1e-12));
    const double angle = std::acos(std::abs(detail::max_direction(turned) | axis));
    CHECK(angle == Approx(std::atan(std::sqrt(other > -1 ? -other : -1 / other))));
    // counter-clockwise
    const Vec2d to = detail::max_direction(turned);
    CHECK(detail::cross2(axis, (to | axis) < 0 ? Vec2d(-to) : to) > 0);
  }
  const Vec3d convex = detail::tensor_from(0.2, 1, axis), parabolic = detail::tensor_from(0, 1, axis);
  CHECK(detail::turned_to_asymptotic(convex) == convex);
  CHECK(detail::turned_to_asymptotic(parabolic) == parabolic);
  CHECK(detail::turned_to_asymptotic(-convex) == -convex);
  const auto jump = [&](double k, double l) {
    return detail::frobenius_norm(detail::turned_to_asymptotic(detail::tensor_from(k, 1, axis)) -
                                  detail::turned_to_asymptotic(detail::tensor_from(l, 1, axis)));
  };
  CHECK(jump(-1e-10, 1e-10) < 5e-5);  // the square root of the change
  CHECK(jump(-1 - 1e-10, -1 + 1e-10) < 1e-8);
}

TEST_CASE("in a constant saddle field one kind of lines runs along the asymptotic direction", "[follow]") {
  // k_min along x, k_max = 4 |k_min| along y: the asymptotic direction is atan(1/2) from x.
  auto mesh = traced::square(20, traced::constant(-0.5, 2, M_PI / 2));
  trace_lines(mesh, min_abs(0.001));
  const SurfaceRef surface = mesh;
  for (const Line& line : read_lines(mesh).lines) {
    const Vec3d way = position(surface, line.points.back()) - position(surface, line.points.front());
    const double angle = std::atan2(way[1], way[0]) * degrees;
    const double wanted = std::atan(0.5) * degrees + (line.kind == LineKind::max ? 90 : 0);
    CHECK(std::abs(std::remainder(angle - wanted, 180)) < 1e-6);
  }
  CHECK(mesh.property(require_property(mesh, property::follow)) == static_cast<int>(Follow::min_abs));
}

TEST_CASE("on a hyperboloid of one sheet min lines are straight: its rulings", "[follow]") {
  const bool plane = GENERATE(true, false);
  INFO((plane ? "plane" : "surface"));
  ShapeOptions shape;
  shape.vertices = 10000;
  auto mesh = mesh_patch(half_hyperboloid(), shape);
  prepare(mesh, plane);
  trace_lines(mesh, min_abs(0.001));
  // Counter-clockwise from the meridian, seen from outside: the ruling that goes around clockwise as it
  // rises.
  const auto angles = off(mesh, LineKind::min, [](const Vec3d& p) {
    const double at_waist = std::atan2(p[1], p[0]) + std::atan(p[2]);
    return std::vector<Vec3d>{{std::sin(at_waist), -std::cos(at_waist), 1}};
  });
  REQUIRE(angles.size() > 300);
  CHECK(at_share(angles, 0.95) < 2);
  CHECK(at_share(angles, 0.5) < 0.5);
}

TEST_CASE("on the saddle z = (x^2 - y^2) / 2 the flatter kind runs along x + y or x - y", "[follow]") {
  const bool plane = GENERATE(true, false);
  INFO((plane ? "plane" : "surface"));
  ShapeOptions shape;
  shape.vertices = 10000;
  auto mesh = make_shape("saddle", shape);
  prepare(mesh, plane);
  trace_lines(mesh, min_abs(0.0005));
  // Bent up along x and down along y: max lines are those along y, and bend less where |y| > |x|.
  for (const LineKind kind : {LineKind::min, LineKind::max}) {
    const auto angles = off(mesh, kind, [kind](const Vec3d& p) {
      const bool flatter = (kind == LineKind::max) == (std::abs(p[1]) > std::abs(p[0]));
      std::vector<Vec3d> wanted{{1, 1, p[0] - p[1]}, {1, -1, p[0] + p[1]}};
      const Vec3d normal(-p[0], p[1], 1);
      if (!flatter)  // at right angles to the other kind
        for (Vec3d& w : wanted) w = cross(normal, w);
      return wanted;
    });
    REQUIRE(angles.size() > 300);
    CHECK(at_share(angles, 0.95) < 3);
    CHECK(at_share(angles, 0.5) < 1);
  }
}

TEST_CASE("where nothing is saddle-shaped min-abs changes nothing", "[follow]") {
  auto mesh = traced::shape("dome", 4000);
  TraceOptions options = min_abs(0.001);
  trace_lines(mesh, options);
  const LineNetwork turned = read_lines(mesh);
  options.follow = Follow::curvature;
  trace_lines(mesh, options);
  const LineNetwork plain = read_lines(mesh);
  REQUIRE(turned.lines.size() == plain.lines.size());
  for (size_t i = 0; i < plain.lines.size(); ++i) {
    REQUIRE(turned.lines[i].points.size() == plain.lines[i].points.size());
    for (size_t j = 0; j < plain.lines[i].points.size(); ++j)
      CHECK(turned.lines[i].points[j].barycentric == plain.lines[i].points[j].barycentric);
  }
}

TEST_CASE("results of min-abs are sound, with parabolic lines and a flat umbilic too", "[follow]") {
  const std::string name = GENERATE("torus", "saddle", "wave", "monkey-saddle");
  const bool fitted = GENERATE(false, true);
  INFO(name << (fitted ? ", fitted" : ""));
  ShapeOptions shape;
  shape.vertices = 4000;
  auto mesh = make_shape(name, shape);
  RemeshOptions options;
  options.target_vertices = 400;
  options.trace.follow = Follow::min_abs;
  options.fit.enabled = fitted;
  auto result = remesh(mesh, options);
  const Comparison c = compare(mesh, result);
  check_sound(c);
  CHECK(c.quad_fraction > 0.75);
  CHECK(std::abs(static_cast<double>(c.vertices) / 400 - 1) < 0.1);
}
