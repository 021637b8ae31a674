#include "anisomesh/shapes.hh"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "shapes/planar_sampling.hh"
#include "shapes/shapes_closed.hh"

namespace anisomesh {

namespace {

using Domain = ParametricPatch::Domain;
constexpr double pi = 3.14159265358979323846;

ParametricPatch graph_over_disc(std::function<double(double, double)> height) {
  ParametricPatch patch;
  patch.position = [height = std::move(height)](double x, double y) { return Vec3d(x, y, height(x, y)); };
  patch.domain = Domain::disc;
  return patch;
}

ParametricPatch graph_over_square(std::function<double(double, double)> height) {
  ParametricPatch patch;
  patch.position = [height = std::move(height)](double x, double y) { return Vec3d(x, y, height(x, y)); };
  patch.u_min = patch.v_min = -1;
  return patch;
}

/// The part of an ellipsoid around its +z pole up to an angle (of the unit sphere it is the image of).
ParametricPatch ellipsoid_around_pole(const Vec3d& semi_axes, double angle) {
  ParametricPatch patch;
  patch.domain = Domain::disc;
  patch.position = [=](double u, double v) {
    const double radius = std::hypot(u, v), polar = radius * angle;
    const double s = radius > 0 ? std::sin(polar) / radius : angle;
    return Vec3d(semi_axes[0] * s * u, semi_axes[1] * s * v, semi_axes[2] * std::cos(polar));
  };
  return patch;
}

/// Half the ring R = 1, r = 0.4, its tube slit open along the inside: one disc.
ParametricPatch half_torus() {
  ParametricPatch patch;
  patch.position = [](double around, double tube) {
    const double distance = 1 + 0.4 * std::cos(tube);
    return Vec3d(distance * std::cos(around), distance * std::sin(around), 0.4 * std::sin(tube));
  };
  patch.u_max = pi;
  patch.v_min = -170 * pi / 180;
  patch.v_max = 170 * pi / 180;
  return patch;
}

ParametricPatch half_cylinder() {
  ParametricPatch patch;
  patch.position = [](double angle, double z) { return Vec3d(std::cos(angle), std::sin(angle), z); };
  patch.u_max = pi;
  patch.v_max = 2;
  return patch;
}

/// Eight convex petals that meet at sharp valleys; all terms are homogeneous in the radius, so that the
/// curvatures stay bounded at the centre.
ParametricPatch octa_flower() {
  ParametricPatch patch;
  patch.domain = Domain::disc;
  patch.crease_rays = 8;
  patch.position = [](double u, double v) {
    const double radius = std::hypot(u, v), petal = std::abs(std::sin(4 * std::atan2(v, u)));
    const double outline = 1 + 0.12 * petal;
    return Vec3d(u * outline, v * outline, 0.45 * (1 - radius * radius) + 0.2 * radius * radius * petal);
  };
  return patch;
}

const std::vector<std::pair<std::string, ParametricPatch>>& catalogue() {
  const auto square = [](double x) { return x * x; };
  static const std::vector<std::pair<std::string, ParametricPatch>> shapes{
      {"dome", graph_over_disc([=](double x, double y) { return 1.2 * (1 - square(x) - square(y)); })},
      {"squeezed-dome",
       [] {
         ParametricPatch patch;
         patch.domain = Domain::disc;
         patch.position = [](double u, double v) { return Vec3d(u, 0.4 * v, 1.2 * (1 - u * u - v * v)); };
         return patch;
       }()},
      {"saddle", graph_over_square([=](double x, double y) { return 0.5 * (square(x) - square(y)); })},
      {"octa-flower", octa_flower()},
      {"half-torus", half_torus()},
      {"cylinder", half_cylinder()},
      {"ellipsoid-cap", ellipsoid_around_pole({1, 0.8, 0.6}, 80 * pi / 180)},
      {"monkey-saddle", graph_over_disc([](double x, double y) { return 0.4 * x * (x * x - 3 * y * y); })},
      {"wave", graph_over_square([](double x, double y) {
         return 0.15 * std::sin(1.5 * pi * x) + 0.1 * std::cos(pi * y);
       })},
      {"plane", graph_over_square([](double, double) { return 0.0; })},
      {"hemisphere", ellipsoid_around_pole({1, 1, 1}, pi / 2)}};
  return shapes;
}

/// Mean lengths in space of the curves along u and along v, which decide how many columns and rows there are.
Vec2d mean_extent(const ParametricPatch& patch) {
  constexpr int steps = 32;
  const auto at = [&](int i, int j) {
    return patch.position(patch.u_min + (patch.u_max - patch.u_min) * i / steps,
                          patch.v_min + (patch.v_max - patch.v_min) * j / steps);
  };
  Vec2d extent(0, 0);
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      extent[0] += (at(i + 1, j) - at(i, j)).norm();
      extent[1] += (at(j, i + 1) - at(j, i)).norm();
    }
  return extent / (steps + 1);
}

detail::PlanarSampling sample_rectangle(const ParametricPatch& patch, const ShapeOptions& options,
                                        std::mt19937& generator) {
  const Vec2d extent = mean_extent(patch);
  const double spacing = std::sqrt(extent[0] * extent[1] / options.vertices);
  const auto cells = [&](double length) {
    return std::max(2, static_cast<int>(std::lround(length / spacing)) - 1);
  };
  auto sampling = detail::regular_rectangle(extent[0], extent[1], cells(extent[0]), cells(extent[1]));
  if (options.irregular) detail::make_irregular_rectangle(sampling, extent[0], extent[1], spacing, generator);
  for (auto& p : sampling.points)
    p = Vec2d(patch.u_min + (patch.u_max - patch.u_min) * (p[0] / extent[0]),
              patch.v_min + (patch.v_max - patch.v_min) * (p[1] / extent[1]));
  return sampling;
}

detail::PlanarSampling sample_disc(const ParametricPatch& patch, const ShapeOptions& options,
                                   std::mt19937& generator) {
  const int rays = patch.crease_rays;
  const int spokes = rays == 0 ? 6 : rays * std::max(1, 6 / rays);
  const int rings =
      std::max(1, static_cast<int>(std::lround(std::sqrt(2.0 * options.vertices / spokes) - 0.5)));
  auto sampling = detail::regular_disc(spokes, rings, rays);
  if (options.irregular) detail::make_irregular_disc(sampling, rays, 1.0 / rings, generator);
  return sampling;
}

OpenMesh::TriMesh mesh_of(const std::vector<Vec3d>& points, const std::vector<std::array<int, 3>>& triangles,
                          const std::vector<std::pair<int, int>>& creases) {
  OpenMesh::TriMesh mesh;
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  mesh.reserve(points.size(), 3 * points.size(), triangles.size());
  for (const auto& p : points) mesh.add_vertex(p);
  for (const auto& t : triangles)
    mesh.add_face(OpenMesh::VertexHandle(t[0]), OpenMesh::VertexHandle(t[1]), OpenMesh::VertexHandle(t[2]));
  for (const auto& [a, b] : creases) {
    const auto halfedge = mesh.find_halfedge(OpenMesh::VertexHandle(a), OpenMesh::VertexHandle(b));
    mesh.status(mesh.edge_handle(halfedge)).set_feature(true);
  }
  return mesh;
}

/// Shifts the vertices along their normals, which are all taken before the first shift.
void add_noise(OpenMesh::TriMesh& mesh, double deviation_fraction, std::mt19937& generator) {
  const SurfaceRef surface = mesh;
  std::vector<Vec3d> normals(mesh.n_vertices(), Vec3d(0, 0, 0));
  for (const auto f : mesh.faces()) {
    const auto corners = surface.corners(f);
    const Vec3d& p = surface.point(corners.vertex[0]);
    const Vec3d area = (surface.point(corners.vertex[1]) - p) % (surface.point(corners.vertex[2]) - p);
    for (int i = 0; i < 3; ++i) normals[static_cast<size_t>(corners.vertex[i].idx())] += area;
  }
  const double deviation = deviation_fraction * surface.diagonal();
  for (const auto v : mesh.vertices())
    mesh.point(v) +=
        deviation * detail::gaussian(generator) * normals[static_cast<size_t>(v.idx())].normalize_cond();
}

}  // namespace

void ShapeOptions::validate() const {
  if (vertices < 9) throw InvalidOption("vertices is " + std::to_string(vertices) + ", must be at least 9");
  if (!(noise >= 0) || !std::isfinite(noise))
    throw InvalidOption("noise is " + std::to_string(noise) + ", must be finite and at least 0");
}

std::vector<std::string> disc_shape_names() {
  std::vector<std::string> names;
  for (const auto& [name, patch] : catalogue()) names.push_back(name);
  return names;
}

std::vector<std::string> closed_shape_names() { return {"sphere", "ellipsoid", "torus", "cube"}; }

std::vector<std::string> shape_names() {
  auto names = disc_shape_names();
  for (auto& name : closed_shape_names()) names.push_back(std::move(name));
  return names;
}

OpenMesh::TriMesh make_shape(const std::string& name, const ShapeOptions& options) {
  options.validate();
  std::mt19937 generator(options.seed);
  if (const auto closed = detail::sample_closed_shape(name, options, generator)) {
    auto mesh = mesh_of(closed->points, closed->triangles, closed->creases);
    if (options.noise > 0) add_noise(mesh, options.noise, generator);
    return mesh;
  }
  const auto& shapes = catalogue();
  const auto found =
      std::find_if(shapes.begin(), shapes.end(), [&](const auto& s) { return s.first == name; });
  if (found == shapes.end()) {
    std::string known;
    for (const auto& shape : shape_names()) known += (known.empty() ? "" : ", ") + shape;
    throw InvalidOption("no shape is called '" + name + "'; the shapes are " + known);
  }
  return mesh_patch(found->second, options);
}

OpenMesh::TriMesh mesh_patch(const ParametricPatch& patch, const ShapeOptions& options,
                             std::vector<Vec2d>* parameters) {
  options.validate();
  if (!patch.position) throw InvalidOption("the patch has no position function");
  if (patch.crease_rays != 0 && (patch.crease_rays < 3 || patch.domain != Domain::disc))
    throw InvalidOption("crease_rays must be 0, or at least 3 and the domain a disc");
  std::mt19937 generator(options.seed);
  auto sampling = patch.domain == Domain::disc ? sample_disc(patch, options, generator)
                                               : sample_rectangle(patch, options, generator);
  std::vector<Vec3d> points;
  points.reserve(sampling.points.size());
  for (const auto& p : sampling.points) points.push_back(patch.position(p[0], p[1]));
  auto mesh = mesh_of(points, sampling.triangles, sampling.creases);
  if (options.noise > 0) add_noise(mesh, options.noise, generator);
  if (parameters) *parameters = std::move(sampling.points);
  return mesh;
}

}  // namespace anisomesh
