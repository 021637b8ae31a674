#include "anisomesh/flatten.hh"

#include <algorithm>
#include <cmath>

#include "anisomesh/curvature.hh"
#include "anisomesh/errors.hh"
#include "anisomesh/io.hh"
#include "anisomesh/shapes.hh"
#include "catch.hh"
#include "data.hh"
#include "exact_curvature.hh"
#include "numerics/tensor2d.hh"
#include "shapes.hh"

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
  // On a straight border rounding decides on which side of another edge one is: they are apart all the same.
  const auto apart = [&](int a, int b, int c, int d) {
    for (const size_t k : {size_t{0}, size_t{1}})
      if (std::max(map[a][k], map[b][k]) < std::min(map[c][k], map[d][k]) ||
          std::max(map[c][k], map[d][k]) < std::min(map[a][k], map[b][k]))
        return true;
    return false;
  };
  for (size_t i = 0; i < edges.size(); ++i)
    for (size_t j = i + 1; j < edges.size(); ++j) {
      const auto [a, b] = edges[i];
      const auto [c, d] = edges[j];
      if (a == c || a == d || b == c || b == d || apart(a, b, c, d)) continue;
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

/// A winding staircase, nearly flat, of one and a half turns: unrolled at its true lengths it lies on itself.
TriMesh staircase() {
  ParametricPatch patch;
  patch.position = [](double angle, double r) {
    return Vec3d(r * std::cos(angle), r * std::sin(angle), 0.2 * angle);
  };
  patch.u_max = 3 * shapes::pi;
  patch.v_min = 1;
  patch.v_max = 2;
  ShapeOptions options;
  options.vertices = 3000;
  auto mesh = mesh_patch(patch, options);
  exact::write_curvature(mesh, exact::plane());
  return mesh;
}

/// A stretched half ellipsoid and more: `length` times as long as wide.
TriMesh finger(double length) {
  ParametricPatch patch;
  patch.domain = ParametricPatch::Domain::disc;
  patch.position = [=](double u, double v) {
    const double radius = std::hypot(u, v), polar = radius * 2.4;
    const double s = radius > 0 ? std::sin(polar) / radius : 2.4;
    return Vec3d(s * u, s * v, length * std::cos(polar));
  };
  ShapeOptions options;
  options.vertices = 6000;
  auto mesh = mesh_patch(patch, options);
  exact::write_curvature(mesh, exact::ellipsoid(1, 1, length));
  return mesh;
}

/// The image in the plane of the point of a sampled surface with these parameters, where they are inside it.
bool image_of(const shapes::Sampled& sampled, const std::vector<Vec2d>& map, const Vec2d& p, Vec2d& image) {
  const auto& q = sampled.parameters;
  for (const auto f : sampled.mesh.faces()) {
    const auto h = f.halfedge();
    const int a = h.from().idx(), b = h.to().idx(), c = h.next().to().idx();
    const double area = detail::cross2(q[b] - q[a], q[c] - q[a]);
    const double wa = detail::cross2(q[b] - p, q[c] - p) / area,
                 wb = detail::cross2(q[c] - p, q[a] - p) / area;
    if (wa < -1e-9 || wb < -1e-9 || wa + wb > 1 + 1e-9) continue;
    image = wa * map[a] + wb * map[b] + (1 - wa - wb) * map[c];
    return true;
  }
  return false;
}

/// The rule of the paper (section 2.2): the angle from one projected edge of the 1-ring.
Vec2d direction_by_edge(const shapes::Sampled& sampled, const std::vector<Vec2d>& map,
                        OpenMesh::SmartVertexHandle v) {
  const auto& truth = sampled.truth[v.idx()];
  const auto to = v.halfedge().to();
  Vec3d edge = sampled.mesh.point(to) - sampled.mesh.point(v);
  edge = (edge - truth.normal * (truth.normal | edge)).normalized();
  const double c = edge | truth.gamma_max, s = (edge % truth.gamma_max) | truth.normal;
  const Vec2d e = map[to.idx()] - map[v.idx()];
  return Vec2d(c * e[0] - s * e[1], s * e[0] + c * e[1]).normalized();
}

double angle_between(const Vec2d& a, const Vec2d& b) {
  return std::atan2(std::abs(detail::cross2(a, b)), std::abs(a | b)) * 180 / shapes::pi;
}

}  // namespace

TEST_CASE("every shape is flattened one to one, with its area", "[flatten]") {
  for (const auto& name : disc_shape_names())
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

TEST_CASE("directions in the plane are those of the images of the lines of curvature", "[flatten]") {
  double mean_ours = 0, mean_by_edge = 0;
  int shapes_seen = 0;
  for (const auto& form : shapes::curved())
    for (const bool irregular : {false, true}) {
      auto sampled = shapes::sample(form, 1500, irregular);
      auto& mesh = sampled.mesh;
      const auto normal = provide_property(mesh, property::normal);
      const auto tensor = provide_property(mesh, property::tensor);
      for (const auto v : mesh.vertices()) {
        const auto& truth = sampled.truth[v.idx()];
        const auto& g = truth.gamma_min;
        const auto& h = truth.gamma_max;
        mesh.property(normal, v) = truth.normal;
        for (const auto& [k, i, j] : {std::tuple(0, 0, 0), std::tuple(1, 0, 1), std::tuple(2, 0, 2),
                                      std::tuple(3, 1, 1), std::tuple(4, 1, 2), std::tuple(5, 2, 2)})
          mesh.property(tensor, v)[k] = truth.k_min * g[i] * g[j] + truth.k_max * h[i] * h[j];
      }
      flatten(mesh);
      const auto map = map_of(mesh);
      const auto tensor2d = require_property(mesh, property::tensor2d);
      double ours = 0, by_edge = 0;
      int count = 0;
      for (const auto v : mesh.vertices()) {
        if (v.idx() % 5 != 0 || v.is_boundary() || sampled.truth[v.idx()].anisotropy() < 0.1) continue;
        // The parameter direction of gamma_max, and the image of a short stretch along it.
        const auto& truth = sampled.truth[v.idx()];
        const Vec2d p = sampled.parameters[v.idx()];
        const auto jet = form.jet(p[0], p[1]);
        const double uu = jet.x_u | jet.x_u, uv = jet.x_u | jet.x_v, vv = jet.x_v | jet.x_v;
        const double a = truth.gamma_max | jet.x_u, b = truth.gamma_max | jet.x_v, det = uu * vv - uv * uv;
        const double reach = 2 * (mesh.point(v.halfedge().to()) - mesh.point(v)).norm();
        const Vec2d step = reach / det * Vec2d(vv * a - uv * b, uu * b - uv * a);
        Vec2d ahead, behind;
        if (!image_of(sampled, map, p + step, ahead) || !image_of(sampled, map, p - step, behind)) continue;
        ours += angle_between(ahead - behind, detail::max_direction(mesh.property(tensor2d, v)));
        by_edge += angle_between(ahead - behind, direction_by_edge(sampled, map, v));
        ++count;
      }
      REQUIRE(count > 50);
      INFO(form.name << (irregular ? ", irregular: " : ": ") << ours / count << " degrees, by one edge "
                     << by_edge / count);
      CHECK(ours / count < 1);
      CHECK(ours <= by_edge + 1e-9 * count);
      mean_ours += ours / count;
      mean_by_edge += by_edge / count;
      ++shapes_seen;
    }
  INFO("mean over shapes: " << mean_ours / shapes_seen << " degrees, by one edge "
                            << mean_by_edge / shapes_seen);
  CHECK(mean_ours < 0.5 * mean_by_edge);
}

TEST_CASE("a surface that would lie on itself in the plane gets a rounder border instead", "[flatten]") {
  auto mesh = staircase();
  const auto report = flatten(mesh);
  require_one_to_one(mesh);
  CHECK(report.border_roundness > 0);
  CHECK(report.mean_conformal_distortion < 1.1);
}

TEST_CASE("long features shrink, but stay one to one", "[flatten]") {
  const double length = GENERATE(3.0, 6.0, 10.0);
  INFO("length " << length);
  auto mesh = finger(length);
  flatten(mesh);
  require_one_to_one(mesh);
}

TEST_CASE("a feature too long for double precision is refused, never folded", "[flatten]") {
  auto mesh = finger(60);
  try {
    flatten(mesh);
    require_one_to_one(mesh);
  } catch (const CannotProcess& error) {
    CHECK(std::string(error.what()).find("double precision") != std::string::npos);
    CHECK_FALSE(has_property(mesh, property::uv));
  }
}

TEST_CASE("the map follows the surface when that is scaled, turned or renumbered", "[flatten]") {
  auto mesh = shape("squeezed-dome", 800, true);
  flatten(mesh);
  const auto map = map_of(mesh);
  SECTION("scaled") {
    const double scale = GENERATE(1e-6, 1e6);
    auto scaled = mesh;
    for (const auto v : scaled.vertices()) scaled.set_point(v, scale * mesh.point(v));
    flatten(scaled);
    const auto scaled_map = map_of(scaled);
    double worst = 0;
    for (size_t i = 0; i < map.size(); ++i) worst = std::max(worst, (scaled_map[i] / scale - map[i]).norm());
    CHECK(worst < 1e-9);
  }
  SECTION("turned") {
    auto turned = mesh;
    const double c = std::cos(0.7), s = std::sin(0.7);
    for (const auto v : turned.vertices()) {
      const auto p = mesh.point(v);
      turned.set_point(v, Vec3d(3 + p[2], c * p[0] - s * p[1], s * p[0] + c * p[1]));
    }
    flatten(turned);
    const auto turned_map = map_of(turned);
    double worst = 0;
    for (size_t i = 0; i < map.size(); ++i)
      worst = std::max(worst, std::min((turned_map[i] - map[i]).norm(), (turned_map[i] + map[i]).norm()));
    CHECK(worst < 1e-6);  // the dome is symmetric: half a turn of the map is as good
  }
  SECTION("renumbered") {
    TriMesh renumbered;
    const int n = static_cast<int>(mesh.n_vertices());
    for (int i = n - 1; i >= 0; --i) renumbered.add_vertex(mesh.point(OpenMesh::VertexHandle(i)));
    for (const auto f : mesh.faces()) {
      std::vector<OpenMesh::VertexHandle> corners;
      for (const auto v : f.vertices()) corners.emplace_back(n - 1 - v.idx());
      renumbered.add_face(corners);
    }
    exact::write_curvature(renumbered, exact::plane());
    flatten(renumbered);
    const auto other = map_of(renumbered);
    double worst = 0;
    for (int i = 0; i < n; ++i)
      worst =
          std::max(worst, std::min((other[n - 1 - i] - map[i]).norm(), (other[n - 1 - i] + map[i]).norm()));
    CHECK(worst < 1e-6);
  }
}

TEST_CASE("what is not a disc is refused with counts and a way out", "[flatten]") {
  TriMesh mesh;
  const auto add = [&](double x, double y, double z) { return mesh.add_vertex({x, y, z}); };
  std::string says;
  SECTION("a closed surface") {
    const auto a = add(0, 0, 0), b = add(1, 0, 0), c = add(0, 1, 0), d = add(0, 0, 1);
    mesh.add_face(a, c, b);
    mesh.add_face(a, b, d);
    mesh.add_face(b, c, d);
    mesh.add_face(c, a, d);
    says = "0 border loop(s)";
  }
  SECTION("two components") {
    for (const double x : {0.0, 5.0}) mesh.add_face(add(x, 0, 0), add(x + 1, 0, 0), add(x, 1, 0));
    says = "2 component(s)";
  }
  SECTION("a ring") {
    std::vector<OpenMesh::VertexHandle> in, out;
    for (int i = 0; i < 6; ++i) {
      const double t = i * shapes::pi / 3;
      in.push_back(add(std::cos(t), std::sin(t), 0));
      out.push_back(add(2 * std::cos(t), 2 * std::sin(t), 0));
    }
    for (int i = 0; i < 6; ++i) {
      mesh.add_face(in[i], out[i], out[(i + 1) % 6]);
      mesh.add_face(in[i], out[(i + 1) % 6], in[(i + 1) % 6]);
    }
    says = "2 border loop(s)";
  }
  SECTION("a vertex without a face") {
    mesh.add_face(add(0, 0, 0), add(1, 0, 0), add(0, 1, 0));
    add(2, 2, 2);
    says = "vertex 3 belongs to no face";
  }
  exact::write_curvature(mesh, exact::plane());
  CHECK_THROWS_AS(flatten(mesh), CannotProcess);
  CHECK_THROWS_WITH(flatten(mesh), Catch::Contains(says));
  CHECK_FALSE(has_property(mesh, property::uv));
}

TEST_CASE("flattening asks for what it reads, and leaves the mesh alone when cancelled", "[flatten]") {
  auto mesh = make_shape("dome");
  CHECK_THROWS_WITH(flatten(mesh), Catch::Contains("run estimate_curvature() first"));
  exact::write_curvature(mesh, exact::dome());
  CHECK_THROWS_AS(flatten(mesh, [](double done) { return done < 0.5; }), Cancelled);
  CHECK_FALSE(has_property(mesh, property::uv));
}

TEST_CASE("texture coordinates are written where the mesh has them", "[flatten]") {
  auto mesh = shape("wave", 300, false);
  mesh.request_vertex_texcoords2D();
  flatten(mesh);
  const auto map = map_of(mesh);
  double worst = 0;
  for (const auto v : mesh.vertices())
    worst = std::max(worst, std::abs(static_cast<double>(mesh.texcoord2D(v)[0]) - map[v.idx()][0]));
  CHECK(worst < 1e-6);
}

TEST_CASE("the discs of libcgal-demo are flattened one to one", "[flatten][data]") {
  for (const auto& name : demo_discs()) {
    const auto path = demo_mesh(name);
    if (!path) return skip(name);
    INFO(name);
    auto mesh = read_surface(*path);
    exact::write_curvature(mesh, exact::plane());
    const auto report = flatten(mesh);
    require_one_to_one(mesh);
    CHECK(report.free_boundary);
    CHECK(report.mean_conformal_distortion < (name == "three_peaks.off" ? 1.5 : 1.1));
    CHECK(report.repaired_triangles < 40);
  }
}
