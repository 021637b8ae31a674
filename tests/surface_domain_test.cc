// Lines and samples on the surface itself, without a parameterization.
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "anisomesh/flatten.hh"
#include "anisomesh/lines.hh"
#include "anisomesh/properties.hh"
#include "catch.hh"
#include "lines/surface_domain.hh"
#include "lines/surface_index.hh"
#include "surface/surface_walk.hh"
#include "surface_stages.hh"

using namespace anisomesh;
using on_surface::prepare;
using on_surface::shape;

namespace {

constexpr double pi = 3.14159265358979323846;

TraceOptions with_epsilon(double fraction) {
  TraceOptions options;
  options.density.epsilon_fraction = fraction;
  return options;
}

std::vector<Vec3d> positions(const SurfaceRef& surface, const Line& line) {
  std::vector<Vec3d> result;
  for (const auto& p : line.points) result.push_back(position(surface, p));
  return result;
}

/// Lengths from the points of a line to the circle of the torus (R = 1, r = 0.4) that its median lies on.
std::vector<double> off_circle(const std::vector<Vec3d>& points, LineKind kind) {
  // Of a min line the angle around the tube is constant, of a max line that around the ring: relative to the
  // first point, so that no cut of the circle is in the way.
  std::vector<double> angle, radius;
  const auto angle_of = [&](const Vec3d& p) {
    const double axis = std::hypot(p[0], p[1]);
    return kind == LineKind::min ? std::atan2(p[2], axis - 1) : std::atan2(p[1], p[0]);
  };
  for (const Vec3d& p : points) {
    angle.push_back(std::remainder(angle_of(p) - angle_of(points.front()), 2 * pi));
    radius.push_back(kind == LineKind::min ? 0.4 : std::hypot(p[0], p[1]));
  }
  auto sorted = angle;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                   sorted.end());
  std::vector<double> off;
  for (size_t i = 0; i < angle.size(); ++i)
    off.push_back(radius[i] * std::abs(angle[i] - sorted[sorted.size() / 2]));
  return off;
}

struct CircleFit {
  size_t points = 0, off = 0;
  size_t lines[2] = {0, 0};
};

CircleFit fit_circles(const SurfaceRef& surface) {
  CircleFit fit;
  for (const Line& line : read_lines(surface).lines) {
    ++fit.lines[static_cast<size_t>(line.kind)];
    for (const double off : off_circle(positions(surface, line), line.kind)) {
      ++fit.points;
      fit.off += off > 0.002 * surface.diagonal();
    }
  }
  return fit;
}

/// A mesh of n x n cells over [-1, 1]^2 at a height, as one of several sheets.
void add_sheet(OpenMesh::TriMesh& mesh, int n, double height, bool up) {
  std::vector<OpenMesh::VertexHandle> v;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      v.push_back(mesh.add_vertex(Vec3d(2.0 * i / n - 1, 2.0 * j / n - 1, height)));
  const auto at = [&](int i, int j) { return v[static_cast<size_t>(j * (n + 1) + i)]; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const auto a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if (up) {
        mesh.add_face(a, b, c);
        mesh.add_face(a, c, d);
      } else {
        mesh.add_face(a, c, b);
        mesh.add_face(a, d, c);
      }
    }
}

OpenMesh::TriMesh empty_mesh() {
  OpenMesh::TriMesh mesh;
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  return mesh;
}

/// Gives every vertex the same tensor, bent by k_max along y and by k_min along x, and no umbilics.
void write_constant_field(OpenMesh::TriMesh& mesh, double k_min, double k_max) {
  const auto tensor = provide_property(mesh, property::surface_tensor);
  const auto normal = provide_property(mesh, property::normal);
  for (const auto v : mesh.vertices()) {
    mesh.property(tensor, v) = Vec6d(k_min, 0, 0, k_max, 0, 0);
    Vec3d sum(0, 0, 0);
    for (const auto f : v.faces()) sum += mesh.calc_face_normal(f);
    mesh.property(normal, v) = sum.normalized();
  }
  const auto umbilic = provide_property(mesh, property::umbilic);
  const auto where = provide_property(mesh, property::umbilic_position);
  for (const auto f : mesh.faces()) {
    mesh.property(umbilic, f) = 0;
    mesh.property(where, f) = Vec3d(0, 0, 0);
  }
}

}  // namespace

TEST_CASE("a torus has no umbilics, and its lines of curvature are its circles", "[surface-domain]") {
  const bool irregular = GENERATE(false, true);
  auto mesh = shape("torus", 20000, irregular);
  const auto umbilics = find_umbilics(mesh);
  CHECK(umbilics.wedges == 0);
  CHECK(umbilics.trisectors == 0);
  TraceOptions options = with_epsilon(0.0015);
  options.density.max_slope = 0.2;
  const auto report = trace_lines(mesh, options);
  const auto fit = fit_circles(mesh);
  CHECK(static_cast<double>(fit.off) <= 0.01 * static_cast<double>(fit.points));
  CHECK(fit.lines[0] >= 10);
  CHECK(fit.lines[1] >= 10);
  // Nothing is in their way but themselves.
  CHECK(report.ends[static_cast<size_t>(LineEnd::border)] == 0);
  CHECK(report.ends[static_cast<size_t>(LineEnd::step_limit)] == 0);
  CHECK(2 * report.closed_lines >= report.min_lines + report.max_lines);
}

TEST_CASE("on a torus the rings around it keep the spacing of equation 6", "[surface-domain]") {
  auto mesh = shape("torus", 20000);
  const SurfaceRef surface = mesh;
  TraceOptions options = with_epsilon(0.0015);
  trace_lines(mesh, options);
  std::vector<double> rings;
  for (const Line& line : read_lines(mesh).lines) {
    if (line.kind != LineKind::min || !line.closed) continue;
    const Vec3d p = positions(surface, line)[line.points.size() / 2];
    rings.push_back(std::atan2(p[2], std::hypot(p[0], p[1]) - 1));
  }
  std::sort(rings.begin(), rings.end());
  const double wanted = chord_spacing(1 / 0.4, 0.0015 * surface.diagonal());
  REQUIRE(rings.size() > 5);
  for (size_t i = 0; i < rings.size(); ++i) {
    const double next = i + 1 < rings.size() ? rings[i + 1] : rings[0] + 2 * pi;
    CHECK(2 * 0.4 * std::sin((next - rings[i]) / 2) >= 0.5 * wanted);
  }
}

TEST_CASE("around a limb thinner than its lines are apart a line goes once and is closed",
          "[surface-domain]") {
  OpenMesh::TriMesh tube;  // of radius 1, slightly oval, so that its rings have a curvature of their own
  const int around = 48, along = 60;
  const double height = 120;
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * pi * (i + 0.5 * (j % 2)) / around;
      tube.add_vertex({std::cos(angle), 0.9 * std::sin(angle), height * j / along});
    }
  const auto at = [&](int i, int j) { return OpenMesh::VertexHandle(j * around + i % around); };
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i)
      if (j % 2) {
        tube.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
        tube.add_face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
      } else {
        tube.add_face(at(i, j), at(i + 1, j), at(i, j + 1));
        tube.add_face(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
  prepare(tube);
  TraceOptions options = with_epsilon(0.0003);
  options.density.max_spacing_fraction = 0.2;  // rings are as far apart as they may be
  trace_lines(tube, options);
  size_t rings = 0;
  double nearest = height;
  std::vector<double> heights;
  for (const Line& line : read_lines(tube).lines) {
    if (line.kind != LineKind::max) continue;
    const auto points = positions(tube, line);
    double length = (points.back() - points.front()).norm();
    for (size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
    if (points.front()[2] < 0.1 * height || points.front()[2] > 0.9 * height) continue;
    ++rings;
    CHECK(line.closed);
    CHECK(length == Approx(5.97).epsilon(0.02));  // of the ellipse; two windings and more before
    heights.push_back(points.front()[2]);
  }
  CHECK(rings >= 4);
  std::sort(heights.begin(), heights.end());
  for (size_t i = 1; i < heights.size(); ++i) nearest = std::min(nearest, heights[i] - heights[i - 1]);
  CHECK(1.6 * nearest > 5.97);  // or they would have seen themselves
}

TEST_CASE("two sheets near each other in space do not see each other", "[surface-domain]") {
  const auto lines_of = [](bool both) {
    auto mesh = empty_mesh();
    add_sheet(mesh, 24, 0, true);
    // A tenth of the spacing below, facing away.
    const double spacing = chord_spacing(2, 0.001 * std::sqrt(8.0));
    if (both) add_sheet(mesh, 24, -0.1 * spacing, false);
    write_constant_field(mesh, 0.5, 2);
    TraceOptions options;
    // In units of the same length, however thick the two are together.
    options.density.epsilon_fraction = 0.001 * std::sqrt(8.0) / SurfaceRef(mesh).diagonal();
    trace_lines(mesh, options);
    size_t upper = 0;
    for (const Line& line : read_lines(mesh).lines)
      upper += position(mesh, line.points.front())[2] > -1e-9 ? 1 : 0;
    return std::pair<size_t, size_t>(upper, read_lines(mesh).lines.size() - upper);
  };
  const auto one = lines_of(false), two = lines_of(true);
  CHECK(one.first >= 20);
  CHECK(one.second == 0);
  CHECK(static_cast<double>(two.first) == Approx(static_cast<double>(one.first)).epsilon(0.06));
  CHECK(static_cast<double>(two.second) == Approx(static_cast<double>(one.first)).epsilon(0.06));
}

TEST_CASE("the nearest line is found along the surface, around a fold and not through it",
          "[surface-domain]") {
  // A strip folded over: up the left wall, along the roof.
  auto mesh = empty_mesh();
  const std::vector<Vec3d> profile{{0, 0, 0}, {1, 0, 0}, {1, 0, 0.1}, {0, 0, 0.1}};
  std::vector<OpenMesh::VertexHandle> v;
  for (int j = 0; j < 2; ++j)
    for (const Vec3d& p : profile) v.push_back(mesh.add_vertex(p + Vec3d(0, 2.0 * j, 0)));
  for (size_t i = 0; i < 3; ++i) {
    mesh.add_face(v[i], v[i + 1], v[i + 5]);
    mesh.add_face(v[i], v[i + 5], v[i + 4]);
  }
  const SurfaceRef surface = mesh;
  std::vector<detail::DomainFace> across(mesh.n_faces());
  detail::set_across(surface, across);
  const detail::UnfoldedFaces faces(surface, across);
  detail::SurfaceIndex index(surface, faces, nullptr, [](const SurfacePoint&) { return 10.0; });
  // On the floor at x = 0.7, along y from 0.2 to 0.6 in one face.
  const auto on_floor = [&](double x, double y) {
    // Face 0 has corners (0,0), (1,0), (1,2) in some order.
    const auto f = OpenMesh::FaceHandle(0);
    const auto c = surface.corners(f);
    Vec3d b;
    for (size_t i = 0; i < 3; ++i) {
      const Vec3d p = surface.point(c.vertex[i]);
      b[i] = p[0] < 0.5 ? 1 - x : p[1] > 1 ? y / 2 : x - y / 2;
    }
    return SurfacePoint{f, b};
  };
  REQUIRE((position(surface, on_floor(0.7, 0.2)) - Vec3d(0.7, 0.2, 0)).norm() < 1e-12);
  index.enter(0, {{on_floor(0.7, 0.2), 0}, {on_floor(0.7, 0.6), 1}});
  // On the roof right above it: 0.3 to the wall, 0.1 up, 0.3 back.
  SurfacePoint above;
  double best = 1;
  for (const auto f : mesh.faces())
    for (double s = 0; s <= 1; s += 0.005)
      for (double t = 0; s + t <= 1; t += 0.005) {
        const SurfacePoint p{f, {1 - s - t, s, t}};
        const double off = (position(surface, p) - Vec3d(0.7, 0.4, 0.1)).norm();
        if (off < best) best = off, above = p;
      }
  REQUIRE(best < 0.01);
  const double expected = 2 * (1 - position(surface, above)[0]) + 0.1 - (0.7 - position(surface, above)[0]);
  CHECK(std::isinf(index.nearest(above, 0.5, -1, 0, 0).line.distance));
  const auto near = index.nearest(above, 1.0, -1, 0, 0).line;
  CHECK(near.line == 0);
  CHECK(near.distance == Approx(expected).epsilon(0.01));
}

TEST_CASE("a straight walk on a flat piece goes where it should, over vertices and back",
          "[surface-domain]") {
  auto mesh = empty_mesh();
  add_sheet(mesh, 8, 0, true);
  const SurfaceRef surface = mesh;
  std::vector<detail::DomainFace> across(mesh.n_faces());
  detail::set_across(surface, across);
  const detail::UnfoldedFaces faces(surface, across);
  for (const auto f : mesh.faces()) {
    const detail::FaceFrame frame = detail::face_frame(surface, f, Vec3d(0, 0, 1));
    const SurfacePoint from{f, {0.25, 0.25, 0.5}};
    // To every vertex of the sheet, exactly, and on past it by as much again.
    for (const auto v : mesh.vertices()) {
      const Vec3d to = mesh.point(v) - position(surface, from);
      const Vec2d vector(to | frame.x, to | frame.y);
      const auto there = detail::walk_straight(faces, from, vector, [](const detail::PathPiece&) {});
      CHECK((position(surface, there.point) - mesh.point(v)).norm() < 1e-9);
      const auto past = detail::walk_straight(faces, from, 2 * vector, [](const detail::PathPiece&) {});
      const Vec3d end = position(surface, from) + 2 * to;
      if (std::abs(end[0]) < 1 && std::abs(end[1]) < 1)
        CHECK((position(surface, past.point) - end).norm() < 1e-9);
      else
        CHECK(past.blocked);
    }
  }
}

TEST_CASE("on a half torus plane and surface find the same lines", "[surface-domain]") {
  ShapeOptions options;
  options.vertices = 20000;
  options.irregular = true;
  auto triangles = make_shape("half-torus", options), in_plane = triangles;
  prepare(triangles);
  estimate_curvature(in_plane);
  flatten(in_plane);
  smooth_tensors(in_plane);
  find_umbilics(in_plane);
  TraceOptions trace = with_epsilon(0.0015);
  trace.density.max_slope = 0.2;  // graded gently, so that no circle has to end
  trace.relax_passes = 0;         // which would cut some circles into parts, not the same in both
  const auto a = trace_lines(triangles, trace), b = trace_lines(in_plane, trace);
  // How many circles fit in a row may differ by what a gap of 0.8 to 1.4 spacings leaves open; what they
  // cover together may not.
  const auto total = [](const OpenMesh::TriMesh& const_mesh) {
    OpenMesh::TriMesh mesh = const_mesh;
    double length = 0;
    for (const Line& line : read_lines(mesh).lines) {
      const auto p = positions(mesh, line);
      for (size_t i = 1; i < p.size(); ++i) length += (p[i] - p[i - 1]).norm();
    }
    return length;
  };
  INFO(a.min_lines << " + " << a.max_lines << " on the surface, " << b.min_lines << " + " << b.max_lines);
  const double of_both = static_cast<double>(b.min_lines + b.max_lines);
  CHECK(static_cast<double>(a.min_lines + a.max_lines) == Approx(of_both).epsilon(0.1));
  CHECK(total(triangles) == Approx(total(in_plane)).epsilon(0.1));
  const auto fit = fit_circles(triangles);
  CHECK(static_cast<double>(fit.off) <= 0.01 * static_cast<double>(fit.points));
}

TEST_CASE("a sphere is sampled, and its noise makes no lines", "[surface-domain]") {
  auto mesh = shape("sphere", 4000);
  const SurfaceRef surface = mesh;
  const auto options = with_epsilon(0.001);
  const auto traced = trace_lines(mesh, options);
  CHECK(traced.min_lines + traced.max_lines <= 2);
  place_isotropic_samples(mesh, options);
  const double spacing = chord_spacing(1, 0.001 * surface.diagonal());
  std::vector<Vec3d> samples;
  for (const auto& p : read_lines(mesh).isotropic_samples) samples.push_back(position(surface, p));
  REQUIRE(samples.size() > 50);
  double nearest = 10, farthest = 0;
  for (size_t i = 0; i < samples.size(); ++i)
    for (size_t j = 0; j < i; ++j) nearest = std::min(nearest, (samples[i] - samples[j]).norm());
  for (const Vec3d& p : surface.points()) {
    double to_sample = 10;
    for (const Vec3d& s : samples) to_sample = std::min(to_sample, (s - p).norm());
    farthest = std::max(farthest, to_sample);
  }
  // Umbilics, of which noise makes some, may be as near as they may be to lines.
  CHECK(nearest >= 0.39 * spacing);
  CHECK(farthest <= 1.3 * spacing);
}

TEST_CASE("moved, turned and scaled, a surface has lines as long, and the first one is the same",
          "[surface-domain]") {
  // Of which seed comes next rounding decides where several fit equally well, so that later lines may differ.
  struct Traced {
    std::vector<Vec3d> first;
    double length[2] = {0, 0};
  };
  const auto trace = [](OpenMesh::TriMesh mesh, double scale) {
    CurvatureOptions curvature;
    curvature.radius_fraction = 0.03 * scale / SurfaceRef(mesh).extent();
    SmoothingOptions smoothing;
    smoothing.radius_fraction = 0.05 * scale / SurfaceRef(mesh).extent();
    estimate_curvature(mesh, curvature);
    smooth_tensors(mesh, smoothing);
    find_umbilics(mesh);
    TraceOptions options = with_epsilon(0.001 * scale / SurfaceRef(mesh).diagonal());
    options.density.max_spacing_fraction = 0.4 * scale / SurfaceRef(mesh).extent();
    trace_lines(mesh, options);
    Traced traced;
    for (const Line& line : read_lines(mesh).lines) {
      const auto p = positions(mesh, line);
      for (size_t i = 1; i < p.size(); ++i)
        traced.length[static_cast<size_t>(line.kind)] += (p[i] - p[i - 1]).norm() / scale;
      if (traced.first.empty()) traced.first = p;
    }
    return traced;
  };
  const auto original = make_shape("ellipsoid", {4000, true});
  const auto expected = trace(original, 1);
  const double scale = GENERATE(1e-6, 1.0, 1e6), c = std::cos(0.7), s = std::sin(0.7);
  const auto motion = [&](const Vec3d& p) {
    return Vec3d(scale * Vec3d(c * p[0] - s * p[2] + 3, p[1] - 2, s * p[0] + c * p[2] + 5));
  };
  auto moved = original;
  for (const auto v : moved.vertices()) moved.set_point(v, motion(moved.point(v)));
  const auto found = trace(moved, scale);
  REQUIRE(found.first.size() == expected.first.size());
  for (size_t i = 0; i < found.first.size(); ++i)
    CHECK((found.first[i] - motion(expected.first[i])).norm() < 1e-6 * scale);
  for (const size_t kind : {0, 1}) CHECK(found.length[kind] == Approx(expected.length[kind]).epsilon(0.05));
}

TEST_CASE("the lines and samples on a surface are the same bytes with any number of threads",
          "[surface-domain]") {
  auto reference = shape("ellipsoid", 4000);
  trace_lines(reference);
  place_isotropic_samples(reference);
  const auto same = [&](const OpenMesh::TriMesh& mesh) {
    const auto equal = [&](const auto& declaration) {
      return mesh.property(require_property(mesh, declaration)) ==
             reference.property(require_property(reference, declaration));
    };
    CHECK(equal(property::line_table));
    CHECK(equal(property::line_faces));
    CHECK(equal(property::line_barycentrics));
    CHECK(equal(property::isotropic_faces));
    CHECK(equal(property::isotropic_barycentrics));
  };
  for (const int threads : {1, 3}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                      static_cast<size_t>(threads));
    auto mesh = shape("ellipsoid", 4000);
    trace_lines(mesh);
    place_isotropic_samples(mesh);
    same(mesh);
  }
}
