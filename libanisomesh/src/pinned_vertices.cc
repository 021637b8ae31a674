// Where the vertices that are gone lie in the triangles that are left (Lee et al. 1998, MAPS): the part of
// MeshEmbedding that keeps track of them.
#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh_embedding.hh"

namespace anisomesh::detail {

namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

size_t at(int i) { return static_cast<size_t>(i); }

constexpr double pi = 3.14159265358979323846;
constexpr double least_weight = 0.01;  // what is pinned stays clear of the sides

double cross2(const Vec2d& a, const Vec2d& b) { return a[0] * b[1] - a[1] * b[0]; }

}  // namespace

// As a fan around the vertex whose angles are scaled to a full turn, or to half of one on the border.
void MeshEmbedding::lay_flat(VertexHandle v) {
  star_.ring.clear();
  star_.points.clear();
  const HalfedgeHandle start =
      mesh_.halfedge_handle(v);  // on the border OpenMesh keeps the border halfedge here
  const Vec3d& centre = mesh_.point(v);
  std::vector<double> angles;
  std::vector<FaceHandle> faces;
  double total = 0;
  // Counter-clockwise: from an outgoing halfedge to the one before it in its face, and across.
  HalfedgeHandle h = start;
  const bool open = mesh_.is_boundary(start);
  if (open) {  // the first face counter-clockwise after the gap
    while (true) {
      const HalfedgeHandle clockwise = mesh_.next_halfedge_handle(mesh_.opposite_halfedge_handle(h));
      if (mesh_.is_boundary(mesh_.opposite_halfedge_handle(h))) break;
      h = clockwise;
      if (h == start) break;
    }
  }
  const HalfedgeHandle first = h;
  do {
    star_.ring.push_back({mesh_.to_vertex_handle(h).idx(), {0, 0}});
    angles.push_back(total);
    if (mesh_.is_boundary(h)) break;
    const HalfedgeHandle before = mesh_.prev_halfedge_handle(h);  // ends in v
    const Vec3d p = mesh_.point(mesh_.to_vertex_handle(h)) - centre,
                q = mesh_.point(mesh_.from_vertex_handle(before)) - centre;
    total += std::max(1e-6, std::atan2(cross(p, q).norm(), p | q));
    faces.push_back(mesh_.face_handle(h));
    h = mesh_.opposite_halfedge_handle(before);
  } while (h != first);
  const double scale = (open ? pi : 2 * pi) / total;
  for (size_t i = 0; i < star_.ring.size(); ++i) {
    const double length = (mesh_.point(VertexHandle(star_.ring[i].first)) - centre).norm();
    star_.ring[i].second = length * Vec2d(std::cos(scale * angles[i]), std::sin(scale * angles[i]));
  }
  const auto place_of = [&](int vertex) {
    for (const auto& entry : star_.ring)
      if (entry.first == vertex) return entry.second;
    return Vec2d(0, 0);
  };
  for (const FaceHandle f : faces) {
    auto& pinned = pinned_[at(f.idx())];
    if (pinned.empty()) continue;
    auto c = mesh_.cfv_begin(f);
    const Vec2d p = place_of(c->idx()), q = place_of((++c)->idx()), r = place_of((++c)->idx());
    for (const Pinned& x : pinned)
      star_.points.push_back({x.vertex, x.barycentric[0] * p + x.barycentric[1] * q + x.barycentric[2] * r});
    pinned.clear();
  }
  if (v.idx() < vertices_ && !open) star_.points.push_back({v.idx(), {0, 0}});
}

// The triangles around `keep` that took the place of the star hold its points now.
void MeshEmbedding::pin_again(VertexHandle keep) {
  if (star_.points.empty()) return;
  struct Candidate {
    FaceHandle face;
    std::array<Vec2d, 3> corner;
    double area;
  };
  std::vector<Candidate> candidates;
  for (const auto f : mesh_.vf_range(keep)) {
    Candidate candidate{f, {}, 0};
    size_t known = 0, k = 0;
    for (const auto c : mesh_.fv_range(f)) {
      for (const auto& entry : star_.ring)
        if (entry.first == c.idx()) {
          candidate.corner[k] = entry.second;
          ++known;
          break;
        }
      ++k;
    }
    if (known < 3) continue;
    const auto& c = candidate.corner;
    candidate.area = cross2(c[1] - c[0], c[2] - c[0]);
    candidates.push_back(candidate);
  }
  for (const FlatStar::Point& x : star_.points) {
    const Candidate* best = nullptr;
    Vec3d best_weights(1.0 / 3, 1.0 / 3, 1.0 / 3);
    double deepest = -std::numeric_limits<double>::infinity();
    for (const Candidate& candidate : candidates) {
      const auto& c = candidate.corner;
      if (!(candidate.area > 0)) continue;
      const Vec3d w = Vec3d(cross2(c[1] - x.place, c[2] - x.place), cross2(c[2] - x.place, c[0] - x.place),
                            cross2(c[0] - x.place, c[1] - x.place)) /
                      candidate.area;
      const double depth = std::min({w[0], w[1], w[2]});
      if (depth <= deepest) continue;
      deepest = depth;
      best = &candidate;
      best_weights = w;
    }
    if (!best && !candidates.empty()) best = &candidates.front();
    if (!best) continue;
    best_weights.maximize(Vec3d(1, 1, 1) * least_weight);
    pinned_[at(best->face.idx())].push_back({x.vertex, best_weights / (best_weights | Vec3d(1, 1, 1))});
  }
}

// What is pinned in the two triangles keeps its place in them laid flat.
void MeshEmbedding::flip_edge(OpenMesh::EdgeHandle e) {
  const auto h = mesh_.halfedge_handle(e, 0), o = mesh_.halfedge_handle(e, 1);
  const VertexHandle a = mesh_.from_vertex_handle(h), b = mesh_.to_vertex_handle(h);
  const VertexHandle c = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h)),
                     d = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(o));
  const double length = (mesh_.point(b) - mesh_.point(a)).norm();
  const auto apex = [&](VertexHandle v, double side) {
    const Vec3d along = (mesh_.point(b) - mesh_.point(a)) / length, off = mesh_.point(v) - mesh_.point(a);
    return Vec2d(off | along, side * cross(along, off).norm());
  };
  star_.ring = {{a.idx(), {0, 0}}, {b.idx(), {length, 0}}, {c.idx(), apex(c, 1)}, {d.idx(), apex(d, -1)}};
  star_.points.clear();
  for (const auto f : {mesh_.face_handle(h), mesh_.face_handle(o)}) {
    auto& pinned = pinned_[at(f.idx())];
    Vec2d corner[3];
    size_t k = 0;
    for (const auto v : mesh_.fv_range(f)) {
      for (const auto& entry : star_.ring)
        if (entry.first == v.idx()) corner[k] = entry.second;
      ++k;
    }
    for (const Pinned& x : pinned)
      star_.points.push_back({x.vertex, x.barycentric[0] * corner[0] + x.barycentric[1] * corner[1] +
                                            x.barycentric[2] * corner[2]});
    pinned.clear();
  }
  mesh_.flip(e);
  pin_again(c);
}

}  // namespace anisomesh::detail
