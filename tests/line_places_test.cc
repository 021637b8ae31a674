// The points of a line that its drawing on the surface needs.
#include "network/line_places.hh"

#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <cmath>

#include "catch.hh"

using namespace anisomesh;

namespace {

// The unit square in two triangles, cut along x = y; a line goes through the one below.
struct Square {
  OpenMesh::TriMesh mesh;
  Square() {
    const auto a = mesh.add_vertex({0, 0, 0}), b = mesh.add_vertex({1, 0, 0}), c = mesh.add_vertex({1, 1, 0}),
               d = mesh.add_vertex({0, 1, 0});
    mesh.add_face(a, b, c);
    mesh.add_face(a, c, d);
  }
};

struct Drawn {
  std::vector<Vec3d> points, kept;
  std::vector<int> left_out;
};

template <class Curve>
Drawn drawn(const Curve& curve, int steps) {
  Square square;
  const SurfaceRef surface(square.mesh);
  const detail::SurfaceArrays arrays(surface);
  Line line;
  Drawn result;
  for (int i = 0; i <= steps; ++i) {
    const Vec3d p = curve(static_cast<double>(i) / steps);
    const int face = p[1] < p[0] ? 0 : 1;
    SurfacePoint point{OpenMesh::FaceHandle(face), {0, 0, 0}};
    for (int k = 0; k < 3; ++k) {
      const Vec3d &a = arrays.corner_point(face, (k + 1) % 3), &b = arrays.corner_point(face, (k + 2) % 3);
      point.barycentric[k] = cross(a - p, b - p)[2];
    }
    line.points.push_back(point);
    result.points.push_back(p);
  }
  for (const auto& place : detail::places_of(arrays, surface, line, result.left_out))
    result.kept.push_back(position(surface, {OpenMesh::FaceHandle(place.face), place.barycentric}));
  return result;
}

double off_polyline(const Vec3d& p, const std::vector<Vec3d>& line) {
  double nearest = 1;
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec3d along = line[i + 1] - line[i];
    const double t = std::min(1.0, std::max(0.0, ((p - line[i]) | along) / along.sqrnorm()));
    nearest = std::min(nearest, (p - line[i] - t * along).norm());
  }
  return nearest;
}

}  // namespace

TEST_CASE("of a straight line's many steps through one triangle a fourth is drawn", "[line_places]") {
  const auto straight = drawn([](double t) { return Vec3d(0.3 + 0.6 * t, 0.1, 0); }, 80);
  CHECK(straight.kept.size() == 21);
  CHECK(straight.left_out == std::vector<int>(60, 0));
  CHECK((straight.kept.front() - straight.points.front()).norm() < 1e-12);
  CHECK((straight.kept.back() - straight.points.back()).norm() < 1e-12);
}

TEST_CASE("of very many steps through one triangle some twenty are drawn", "[line_places]") {
  CHECK(drawn([](double t) { return Vec3d(0.3 + 0.6 * t, 0.1, 0); }, 400).kept.size() == 21);
}

TEST_CASE("what is left out of a line is on what is drawn, and a line that turns is drawn whole",
          "[line_places]") {
  const auto arc = [](double turn) {
    return [turn](double t) {
      return Vec3d(0.5 + 0.3 * std::sin(turn * t) / turn, 0.05 + 0.3 * (1 - std::cos(turn * t)) / turn, 0);
    };
  };
  for (const double turn : {0.01, 0.3, 1.0}) {
    const auto gentle = drawn(arc(turn), 60);
    for (const Vec3d& p : gentle.points) CHECK(off_polyline(p, gentle.kept) <= 0.02 * 0.3 / 60 * 1.001);
  }
  CHECK(drawn(arc(0.01), 60).kept.size() == 16);
  CHECK(drawn(arc(1.5), 8).left_out.empty());
}

TEST_CASE("a line keeps a point on each side of an edge that it crosses", "[line_places]") {
  const auto across = drawn([](double t) { return Vec3d(0.9 - 0.8 * t, 0.1 + 0.7 * t, 0); }, 51);
  for (size_t i = 0; i + 1 < across.points.size(); ++i) {
    const auto is_below = [](const Vec3d& p) { return p[1] < p[0]; };
    if (is_below(across.points[i]) == is_below(across.points[i + 1])) continue;
    for (const Vec3d& p : {across.points[i], across.points[i + 1]}) {
      double nearest = 1;
      for (const Vec3d& k : across.kept) nearest = std::min(nearest, (k - p).norm());
      CHECK(nearest < 1e-12);
    }
  }
}
