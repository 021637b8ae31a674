#include "field/surface_field.hh"

#include <algorithm>
#include <cmath>

#include "anisomesh/properties.hh"
#include "numerics/tensor3d.hh"

namespace anisomesh::detail {

namespace {

// (cos, sin) from one frame of a plane to another of the same plane; none where they do not fit at all.
Vec2d between(const TangentFrame& from, const Vec3d& x, const Vec3d& y) {
  const Vec2d r((from.u | x) + (from.v | y), (from.u | y) - (from.v | x));
  const double length = std::hypot(r[0], r[1]);
  return length > 1e-9 ? Vec2d(r / length) : Vec2d(1, 0);
}

double angle_at(const SurfaceRef& surface, const SurfaceRef::Corners& c, int i) {
  const Vec3d p = surface.point(c.vertex[i]);
  const Vec3d a = surface.point(c.vertex[(i + 1) % 3]) - p, b = surface.point(c.vertex[(i + 2) % 3]) - p;
  return std::atan2((a % b).norm(), a | b);
}

// Means of the faces' normals around each node, by the angle that each has there.
std::vector<Vec3d> node_normals(const SurfaceRef& surface, const CutSurface& cut) {
  std::vector<Vec3d> normals(cut.nodes(), Vec3d(0, 0, 0));
  for (const auto f : surface.connectivity().all_faces()) {
    const auto c = surface.corners(f);
    Vec3d n = (surface.point(c.vertex[1]) - surface.point(c.vertex[0])) %
              (surface.point(c.vertex[2]) - surface.point(c.vertex[0]));
    const double length = n.norm();
    if (!(length > 0)) continue;
    n /= length;
    for (int i = 0; i < 3; ++i)
      normals[static_cast<size_t>(cut.corner_node[static_cast<size_t>(f.idx())][static_cast<size_t>(i)])] +=
          angle_at(surface, c, i) * n;
  }
  for (Vec3d& n : normals) {
    const double length = n.norm();
    n = length > 1e-9 ? Vec3d(n / length) : Vec3d(0, 0, 0);
  }
  return normals;
}

// Of each vertex, in the plane of another normal.
Vec3d in_plane_of(const Vec6d& tensor, const Vec3d& own_normal, const Vec3d& normal) {
  const Vec3d t = in_frame(tensor, TangentFrame(own_normal));
  return rotated(t, transport(own_normal, normal));
}

}  // namespace

Vec2d transport(const Vec3d& from, const Vec3d& to) {
  const TangentFrame end(to);
  return between(turned(TangentFrame(from), from, to), end.u, end.v);
}

SurfaceField surface_field(const SurfaceRef& surface, const std::vector<Vec6d>& tensors) {
  auto& mesh = surface.connectivity();
  const auto normal = require_property(mesh, property::normal);
  SurfaceField field;
  field.cut = cut_along_features(surface);
  const auto neighbours = node_neighbours(surface, field.cut);
  field.normal = node_normals(surface, field.cut);
  field.tensor.resize(field.normal.size());
  for (size_t n = 0; n < field.normal.size(); ++n) {
    const auto v = static_cast<size_t>(field.cut.vertex_of_node[n]);
    Vec3d at_vertex = mesh.property(normal, OpenMesh::VertexHandle(static_cast<int>(v)));
    if (!(at_vertex.sqrnorm() > 0.5)) at_vertex = field.normal[n];
    const bool own = !field.cut.on_feature[v] || !(field.normal[n].sqrnorm() > 0.5);
    if (own) field.normal[n] = at_vertex;
    if (!(field.normal[n].sqrnorm() > 0.5)) field.normal[n] = Vec3d(0, 0, 1);
    if (!(at_vertex.sqrnorm() > 0.5)) at_vertex = field.normal[n];
    field.tensor[n] = in_plane_of(tensors[v], at_vertex, field.normal[n]);
  }
  field.tensor = one_sided_values(field.cut, neighbours, field.tensor,
                                  [&field](size_t from, size_t to, const Vec3d& tensor) {
                                    return rotated(tensor, transport(field.normal[from], field.normal[to]));
                                  });
  return field;
}

std::vector<Vec6d> read_surface_tensors(const SurfaceRef& surface) {
  auto& mesh = surface.connectivity();
  const auto tensor = require_property(mesh, property::surface_tensor);
  std::vector<Vec6d> tensors;
  tensors.reserve(mesh.n_vertices());
  for (const auto v : mesh.all_vertices()) tensors.push_back(mesh.property(tensor, v));
  return tensors;
}

std::vector<std::array<Vec2d, 3>> turns_into_faces(const SurfaceRef& surface, const SurfaceField& field) {
  std::vector<std::array<Vec2d, 3>> turns(field.cut.corner_node.size());
  for (const auto f : surface.connectivity().all_faces()) {
    const auto& nodes = field.cut.corner_node[static_cast<size_t>(f.idx())];
    Vec3d hint(0, 0, 0);
    for (const int n : nodes) hint += field.normal[static_cast<size_t>(n)];
    const FaceFrame frame = face_frame(surface, f, hint);
    for (size_t i = 0; i < 3; ++i) {
      const Vec3d& normal = field.normal[static_cast<size_t>(nodes[i])];
      const TangentFrame laid = turned(TangentFrame(normal), normal, frame.normal);
      turns[static_cast<size_t>(f.idx())][i] = between(laid, frame.x, frame.y);
    }
  }
  return turns;
}

std::vector<std::array<Vec3d, 3>> corner_tensors_in_faces(const SurfaceRef& surface,
                                                          const SurfaceField& field) {
  const auto turns = turns_into_faces(surface, field);
  std::vector<std::array<Vec3d, 3>> corners(turns.size());
  for (size_t f = 0; f < corners.size(); ++f)
    for (size_t i = 0; i < 3; ++i)
      corners[f][i] = rotated(field.tensor[static_cast<size_t>(field.cut.corner_node[f][i])], turns[f][i]);
  return corners;
}

}  // namespace anisomesh::detail
