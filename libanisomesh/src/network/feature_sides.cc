#include "network/feature_sides.hh"

#include <algorithm>
#include <limits>

#include "anisomesh/features.hh"
#include "surface/rounding.hh"

namespace anisomesh::detail {

namespace {

using OpenMesh::FaceHandle, OpenMesh::HalfedgeHandle, OpenMesh::VertexHandle;

size_t at(int i) { return static_cast<size_t>(i); }

Vec3d unit(const Vec3d& v) {
  const double length = v.norm();
  return length > 0 ? v / length : v;
}

/// The vertex that a point is, or none.
VertexHandle vertex_at(const SurfaceRef& surface, const SurfacePoint& point) {
  const auto c = surface.corners(point.face);
  for (size_t k = 0; k < 3; ++k)
    if (point.barycentric[k] >= 1 - kRounding) return c.vertex[k];
  return VertexHandle();
}

/// From each edge of a feature or the border that leaves a vertex to the next one.
std::vector<FeatureSide> around_vertex(const SurfaceRef& surface, VertexHandle v) {
  const auto& mesh = surface.connectivity();
  const auto along = [&](HalfedgeHandle h) {
    return unit(surface.point(mesh.to_vertex_handle(h)) - surface.point(v));
  };
  std::vector<FeatureSide> sides;
  for (const HalfedgeHandle first : mesh.voh_range(v)) {
    if (!is_feature_or_border(mesh, mesh.edge_handle(first)) || mesh.is_boundary(first)) continue;
    FeatureSide side;
    side.spokes.push_back(along(first));
    HalfedgeHandle h = first;
    do {
      side.faces.push_back(mesh.face_handle(h));
      h = mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(h));
      side.spokes.push_back(along(h));
    } while (!is_feature_or_border(mesh, mesh.edge_handle(h)));
    sides.push_back(std::move(side));
  }
  return sides;
}

/// The two sides of the edge that a point lies on, if that is a feature.
std::vector<FeatureSide> beside_edge(const SurfaceRef& surface, const SurfacePoint& point) {
  const auto& mesh = surface.connectivity();
  std::vector<FeatureSide> sides;
  const auto c = surface.corners(point.face);
  for (size_t k = 0; k < 3; ++k) {
    if (point.barycentric[k] > kRounding) continue;
    const HalfedgeHandle h = mesh.find_halfedge(c.vertex[(k + 1) % 3], c.vertex[(k + 2) % 3]);
    if (!is_feature_or_border(mesh, mesh.edge_handle(h))) continue;
    for (const HalfedgeHandle half : {h, mesh.opposite_halfedge_handle(h)}) {
      if (mesh.is_boundary(half)) continue;
      const Vec3d &a = surface.point(mesh.from_vertex_handle(half)),
                  &b = surface.point(mesh.to_vertex_handle(half)),
                  &tip = surface.point(mesh.to_vertex_handle(mesh.next_halfedge_handle(half)));
      const Vec3d place = position(surface, point), along = unit(b - a);
      const Vec3d inward = unit((tip - place) - ((tip - place) | along) * along);
      const FaceHandle f = mesh.face_handle(half);
      sides.push_back({{f, f}, {along, inward, -along}});
    }
    break;
  }
  return sides;
}

/// Cosine of the least angle between a direction and those between two spokes.
double cosine_to(const Vec3d& direction, const Vec3d& a, const Vec3d& b) {
  const Vec3d normal = unit(cross(a, b));
  const Vec3d in_plane = direction - (direction | normal) * normal;
  const bool between = (cross(a, in_plane) | normal) > 0 && (cross(in_plane, b) | normal) > 0;
  return between ? in_plane.norm() : std::max(direction | a, direction | b);
}

double cosine_to(const Vec3d& direction, const FeatureSide& side) {
  double best = -1;
  for (size_t i = 0; i + 1 < side.spokes.size(); ++i)
    best = std::max(best, cosine_to(direction, side.spokes[i], side.spokes[i + 1]));
  return best;
}

bool is_fence(const NetworkGraph& network, int a, int b) {
  const int e = network.graph.find_edge(a, b);
  return e >= 0 && !is_line(network.graph.edge(e).kind);
}

}  // namespace

FeatureSides::FeatureSides(const SurfaceRef& surface, const NetworkGraph& network)
    : sides_(network.graph.n_nodes()) {
  for (size_t n = 0; n < sides_.size(); ++n) {
    if (!network.touches(static_cast<int>(n), EdgeKind::feature)) continue;
    const VertexHandle v = vertex_at(surface, network.points[n]);
    auto sides = v.is_valid() ? around_vertex(surface, v) : beside_edge(surface, network.points[n]);
    if (sides.size() > 1) sides_[n] = std::move(sides);
  }
}

FaceHandle FeatureSides::face_between(const NetworkGraph& network, int before, int node, int after) const {
  const FaceHandle known = network.points[at(node)].face;
  if (at(node) >= sides_.size() || sides_[at(node)].empty()) return known;
  const Vec3d& place = network.positions[at(node)];
  const Vec3d in = unit(network.positions[at(before)] - place),
              out = unit(network.positions[at(after)] - place);
  const bool fence_in = is_fence(network, before, node), fence_out = is_fence(network, node, after);
  const FeatureSide* best = nullptr;
  double most = -std::numeric_limits<double>::infinity();
  for (const FeatureSide& side : sides_[at(node)]) {
    const double cosines = (fence_out ? out | side.spokes.front() : cosine_to(out, side)) +
                           (fence_in ? in | side.spokes.back() : cosine_to(in, side));
    if (cosines > most + kTie) most = cosines, best = &side;
  }
  if (!best) return known;
  if (std::find(best->faces.begin(), best->faces.end(), known) != best->faces.end()) return known;
  return fence_out || !fence_in ? best->faces.front() : best->faces.back();
}

}  // namespace anisomesh::detail
