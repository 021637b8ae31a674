#include "network/uv_locator.hh"

#include <algorithm>

#include "anisomesh/properties.hh"

namespace anisomesh::detail {

namespace {

double cross(const Vec2d& a, const Vec2d& b) { return a[0] * b[1] - a[1] * b[0]; }
size_t at(int i) { return static_cast<size_t>(i); }

Vec3d clamped(Vec3d b) {
  b.maximize(Vec3d(0, 0, 0));
  return b / (b[0] + b[1] + b[2]);
}

size_t smallest(const Vec3d& b) { return b[0] <= b[1] ? (b[0] <= b[2] ? 0 : 2) : (b[1] <= b[2] ? 1 : 2); }

// Rounding in the barycentric coordinates of a point on an edge; they are clamped afterwards.
constexpr double slack = 1e-12;

}  // namespace

UvLocator::UvLocator(const SurfaceRef& surface) {
  auto& mesh = surface.connectivity();
  const auto uv = require_property(mesh, property::uv);
  uv_.reserve(mesh.n_vertices());
  for (const auto v : mesh.vertices()) uv_.push_back(mesh.property(uv, v));
  faces_.reserve(mesh.n_faces());
  for (const auto f : mesh.faces()) {
    FaceData data;
    auto h = mesh.halfedge_handle(f);
    for (int k = 0; k < 3; ++k, h = mesh.next_halfedge_handle(h)) {
      data.corner[k] = mesh.to_vertex_handle(h).idx();
      // Corner k is the to-vertex of h, so the edge opposite it is that of the halfedge before h.
      data.neighbor[k] = mesh.face_handle(mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(h))).idx();
    }
    faces_.push_back(data);
  }
}

Vec2d UvLocator::uv(const SurfacePoint& point) const {
  const FaceData& face = faces_[at(point.face.idx())];
  return point.barycentric[0] * uv_[at(face.corner[0])] + point.barycentric[1] * uv_[at(face.corner[1])] +
         point.barycentric[2] * uv_[at(face.corner[2])];
}

Vec3d UvLocator::barycentric(const FaceData& face, const Vec2d& p) const {
  const Vec2d a = uv_[at(face.corner[0])] - p, b = uv_[at(face.corner[1])] - p,
              c = uv_[at(face.corner[2])] - p;
  const Vec3d areas(cross(b, c), cross(c, a), cross(a, b));
  const double sum = areas[0] + areas[1] + areas[2];
  return sum > 0 ? areas / sum : Vec3d(1.0 / 3, 1.0 / 3, 1.0 / 3);
}

SurfacePoint UvLocator::locate(const Vec2d& uv, OpenMesh::FaceHandle start, bool* inside) const {
  int face = start.idx();
  // A straight walk over well-formed triangles visits about the square root of all; a cycle is possible only
  // through rounding.
  for (size_t step = 0; step <= faces_.size(); ++step) {
    const Vec3d b = barycentric(faces_[at(face)], uv);
    const size_t lowest = smallest(b);
    if (b[lowest] >= -slack) {
      if (inside) *inside = true;
      return {OpenMesh::FaceHandle(face), clamped(b)};
    }
    int next = faces_[at(face)].neighbor[lowest];
    if (next < 0) {
      for (size_t k = 0; k < 3 && next < 0; ++k)
        if (b[k] < -slack) next = faces_[at(face)].neighbor[k];
      if (next < 0) {
        if (inside) *inside = false;
        return {OpenMesh::FaceHandle(face), clamped(b)};
      }
    }
    face = next;
  }
  if (inside) *inside = false;
  return {OpenMesh::FaceHandle(face), clamped(barycentric(faces_[at(face)], uv))};
}

SurfacePoint UvLocator::locate_surely(const Vec2d& uv, OpenMesh::FaceHandle start) const {
  bool inside = false;
  const SurfacePoint walked = locate(uv, start, &inside);
  if (inside) return walked;
  double best = -1e300;
  SurfacePoint result = walked;
  for (size_t f = 0; f < faces_.size(); ++f) {
    const Vec3d b = barycentric(faces_[f], uv);
    const double lowest = b[smallest(b)];
    if (lowest <= best) continue;
    best = lowest;
    result = {OpenMesh::FaceHandle(static_cast<int>(f)), clamped(b)};
    if (best >= -slack) break;
  }
  return result;
}

}  // namespace anisomesh::detail
