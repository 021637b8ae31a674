// Lines, samples and umbilics on the surface itself, without a parameterization.
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "anisomesh/domain.hh"
#include "anisomesh/features.hh"
#include "anisomesh/io.hh"
#include "anisomesh/lines.hh"
#include "anisomesh/properties.hh"
#include "anisomesh/smoothing.hh"
#include "anisomesh/umbilics.hh"
#include "catch.hh"
#include "data.hh"
#include "surface_domain.hh"
#include "surface_index.hh"
#include "surface_walk.hh"
#include "traced_surface.hh"

using namespace anisomesh;

namespace {

constexpr double pi = 3.14159265358979323846;

void prepare(OpenMesh::TriMesh& mesh) {
  estimate_curvature(mesh);
  smooth_tensors(mesh);
  find_umbilics(mesh);
}

OpenMesh::TriMesh shape(const std::string& name, int vertices, bool irregular = true) {
  ShapeOptions options;
  options.vertices = vertices;
  options.irregular = irregular;
  auto mesh = make_shape(name, options);
  prepare(mesh);
  return mesh;
}

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

long euler(const OpenMesh::TriMesh& mesh) {
  return static_cast<long>(mesh.n_vertices()) - static_cast<long>(mesh.n_edges()) +
         static_cast<long>(mesh.n_faces());
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

TEST_CASE("faces without area do no harm", "[surface-domain]") {
  auto mesh = make_shape("torus", {3000, true});
  // Each hundredth edge is split at one of its ends: faces without area, edges without length.
  std::vector<OpenMesh::EdgeHandle> edges;
  for (const auto e : mesh.edges())
    if (e.idx() % 100 == 0) edges.push_back(e);
  for (const auto e : edges) mesh.split(e, mesh.point(mesh.from_vertex_handle(mesh.halfedge_handle(e, 0))));
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

TEST_CASE("on a half torus plane and surface find the same lines", "[surface-domain]") {
  ShapeOptions options;
  options.vertices = 20000;
  options.irregular = true;
  auto on_surface = make_shape("half-torus", options), in_plane = on_surface;
  prepare(on_surface);
  estimate_curvature(in_plane);
  flatten(in_plane);
  smooth_tensors(in_plane);
  find_umbilics(in_plane);
  TraceOptions trace = with_epsilon(0.0015);
  trace.density.max_slope = 0.2;  // graded gently, so that no circle has to end
  const auto a = trace_lines(on_surface, trace), b = trace_lines(in_plane, trace);
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
  CHECK(total(on_surface) == Approx(total(in_plane)).epsilon(0.1));
  const auto fit = fit_circles(on_surface);
  CHECK(static_cast<double>(fit.off) <= 0.01 * static_cast<double>(fit.points));
}

TEST_CASE("a sphere is sampled, and its noise makes no lines", "[surface-domain]") {
  auto mesh = shape("sphere", 4000);
  const SurfaceRef surface = mesh;
  const auto traced = trace_lines(mesh);
  CHECK(traced.min_lines + traced.max_lines <= 2);
  place_isotropic_samples(mesh);
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
  // The bounding box turns with the axes, not with the surface: its diagonal is taken out of the options.
  const auto trace = [](OpenMesh::TriMesh mesh, double scale) {
    const double unit = scale / SurfaceRef(mesh).diagonal();
    CurvatureOptions curvature;
    curvature.radius_fraction = 0.03 * unit;
    SmoothingOptions smoothing;
    smoothing.radius_fraction = 0.05 * unit;
    estimate_curvature(mesh, curvature);
    smooth_tensors(mesh, smoothing);
    find_umbilics(mesh);
    TraceOptions options = with_epsilon(0.001 * unit);
    options.density.max_spacing_fraction = 0.4 * unit;
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
