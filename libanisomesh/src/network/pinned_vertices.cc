// Where the vertices that are gone lie in the triangles that are left (Lee et al. 1998, MAPS): the part of
// MeshEmbedding that keeps track of them.
#include <algorithm>
#include <cmath>
#include <limits>

#include "network/mesh_embedding.hh"
#include "numerics/bvh.hh"
#include "surface/rounding.hh"

namespace anisomesh::detail {

namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

size_t at(int i) { return static_cast<size_t>(i); }

constexpr double pi = 3.14159265358979323846;
constexpr int most_parts = 12;           // of a triangle that its corners say enough of
constexpr double least_weight = 0.01;    // what is pinned stays clear of the sides
constexpr double sharp_cosine = 0.9;     // of a face to the normal at its vertex
constexpr double least_agreement = 0.3;  // cosine of a triangle to the surface at its samples

constexpr size_t small_ring = 24;  // is searched as it is

double cross2(const Vec2d& a, const Vec2d& b) { return a[0] * b[1] - a[1] * b[0]; }

}  // namespace

void MeshEmbedding::FlatStar::sort() {
  order.clear();
  if (ring.size() <= small_ring) return;
  for (size_t i = 0; i < ring.size(); ++i) order.emplace_back(ring[i].first, i);
  std::sort(order.begin(), order.end());
}

const Vec2d* MeshEmbedding::FlatStar::place_of(int vertex) const {
  if (order.empty()) {
    const auto found =
        std::find_if(ring.begin(), ring.end(), [vertex](const auto& entry) { return entry.first == vertex; });
    return found == ring.end() ? nullptr : &found->second;
  }
  const auto found = std::lower_bound(order.begin(), order.end(), std::pair<int, size_t>{vertex, 0});
  return found == order.end() || found->first != vertex ? nullptr : &ring[found->second].second;
}

// In the middle of each part that the lines leave of a triangle of the surface whose corners are all on
// features, the border or other sharp edges, or that is so large that no corner may be near.
void MeshEmbedding::add_samples(const SurfaceRef& surface, const Overlay& overlay,
                                const NetworkGraph& network) {
  std::vector<char> on_curve(at(vertices_), 0);
  for (const auto& edge : overlay.edges)
    if (!is_line(edge.kind))
      for (const int n : edge.node)
        if (n < vertices_) on_curve[at(n)] = 1;
  for (size_t t = 0; t < overlay.triangles.size(); ++t)
    for (const int n : overlay.triangles[t])
      if (n < vertices_ && (normals_[t] | node_normals_[at(n)]) < sharp_cosine) on_curve[at(n)] = 1;
  std::vector<int> parts(surface.connectivity().n_faces(), 0);
  for (const int f : overlay.faces) ++parts[at(f)];
  for (const int f : overlay.left_out) parts[at(f)] += 2;  // as many as there would be with that point
  for (size_t t = 0; t < overlay.triangles.size(); ++t) {
    const FaceHandle face(overlay.faces[t]);
    const auto corners = surface.corners(face);
    bool all = true;
    for (const auto v : corners.vertex) all = all && on_curve[at(v.idx())];
    if (!(all || parts[at(face.idx())] > most_parts) || normals_[t].sqrnorm() == 0) continue;
    Sample sample;
    sample.normal = normals_[t];
    sample.position = Vec3d(0, 0, 0);
    for (const int n : overlay.triangles[t]) sample.position += network.positions[at(n)] / 3;
    sample.point.face = face;
    const Vec3d b = closest_barycentric(sample.position, surface.point(corners.vertex[0]),
                                        surface.point(corners.vertex[1]), surface.point(corners.vertex[2]));
    for (size_t k = 0; k < 3; ++k) sample.point.barycentric[k] = b[k];
    pinned_[t].push_back({vertices_ + static_cast<int>(samples_.size()), Vec3d(1, 1, 1) / 3});
    samples_.push_back(sample);
  }
}

// As a fan around the vertex whose angles are scaled to a full turn, or to half of one on the border.
void MeshEmbedding::lay_flat(VertexHandle v) {
  laid_flat_ = v;
  star_.ring.clear();
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
  star_.closed = !open;
  star_.sort();
  star_.points.clear();
  star_.has_samples = false;
  for (const FaceHandle f : faces) add_points(f);
  if (v.idx() < vertices_ && !open) star_.points.push_back({v.idx(), {0, 0}});
}

// What is pinned in the two triangles at an edge keeps its place in them laid flat.
void MeshEmbedding::lay_flat(OpenMesh::EdgeHandle e) {
  laid_flat_ = VertexHandle();
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
  star_.sort();
  star_.points.clear();
  star_.has_samples = false;
  for (const auto f : {mesh_.face_handle(h), mesh_.face_handle(o)}) add_points(f);
}

void MeshEmbedding::add_points(FaceHandle f) {
  const auto& pinned = pinned_[at(f.idx())];
  if (pinned.empty()) return;
  std::array<Vec2d, 3> corner;
  size_t k = 0;
  for (const auto v : mesh_.fv_range(f)) {
    const Vec2d* place = star_.place_of(v.idx());
    corner[k++] = place ? *place : Vec2d(0, 0);  // the vertex that the star is around
  }
  for (const Pinned& x : pinned) {
    star_.points.push_back({x.vertex, x.barycentric[0] * corner[0] + x.barycentric[1] * corner[1] +
                                          x.barycentric[2] * corner[2]});
    star_.has_samples = star_.has_samples || x.vertex >= vertices_;
  }
}

// Those with all corners in the star, laid flat with it.
std::vector<MeshEmbedding::Candidate> MeshEmbedding::placed(const std::vector<Candidate>& candidates) const {
  std::vector<Candidate> result;
  for (Candidate candidate : candidates) {
    size_t known = 0;
    for (size_t k = 0; k < 3; ++k)
      if (const Vec2d* place = star_.place_of(candidate.node[k])) {
        candidate.corner[k] = *place;
        ++known;
      }
    if (known < 3) continue;
    const auto& c = candidate.corner;
    candidate.area = cross2(c[1] - c[0], c[2] - c[0]);
    result.push_back(candidate);
  }
  return result;
}

// The triangle that a point of the star is in, or the nearest to having it.
MeshEmbedding::Landing MeshEmbedding::land(const FlatStar::Point& x,
                                           const std::vector<Candidate>& candidates) const {
  Landing best{candidates.empty() ? nullptr : &candidates.front(), Vec3d(1, 1, 1) / 3};
  double deepest = -std::numeric_limits<double>::infinity();
  for (const Candidate& candidate : candidates) {
    const auto& c = candidate.corner;
    if (!(candidate.area > 0)) continue;
    const Vec3d w = Vec3d(cross2(c[1] - x.place, c[2] - x.place), cross2(c[2] - x.place, c[0] - x.place),
                          cross2(c[0] - x.place, c[1] - x.place)) /
                    candidate.area;
    const double depth = std::min({w[0], w[1], w[2]});
    if (depth <= deepest + kRounding) continue;  // on a side: the first
    deepest = depth;
    best = {&candidate, w};
  }
  best.barycentric.maximize(Vec3d(1, 1, 1) * least_weight);
  best.barycentric /= best.barycentric | Vec3d(1, 1, 1);
  return best;
}

// Whether the cosine of each triangle to the surface at the samples that would lie in it is above `least`.
bool MeshEmbedding::is_along(const std::vector<Candidate>& candidates, double least, bool vertices) const {
  const auto flat = placed(candidates);
  return std::all_of(star_.points.begin(), star_.points.end(), [&](const FlatStar::Point& x) {
    const bool is_vertex = x.vertex < vertices_;
    if (is_vertex && !vertices) return true;
    const Landing landing = land(x, flat);
    if (!landing.candidate) return true;
    const auto& n = landing.candidate->node;
    const Vec3d &p = mesh_.point(VertexHandle(n[0])), &q = mesh_.point(VertexHandle(n[1])),
                &r = mesh_.point(VertexHandle(n[2]));
    const Vec3d normal = cross(q - p, r - p);
    const Vec3d& surface =
        is_vertex ? node_normals_[at(x.vertex)] : samples_[at(x.vertex - vertices_)].normal;
    const double length = normal.norm();
    return length > 0 && (normal | surface) / length > least;
  });
}

// The triangles that would take the place of the star if all of it were joined to `keep`.
std::vector<MeshEmbedding::Candidate> MeshEmbedding::fan_to(VertexHandle keep) const {
  std::vector<Candidate> fan;
  const auto& ring = star_.ring;
  for (size_t i = 0; i + 1 < ring.size() + (star_.closed ? 1 : 0); ++i) {
    const int a = ring[i].first, b = ring[(i + 1) % ring.size()].first;
    if (a != keep.idx() && b != keep.idx()) fan.push_back({{keep.idx(), a, b}, FaceHandle()});
  }
  return fan;
}

bool MeshEmbedding::is_near(const std::vector<Candidate>& candidates) const {
  return std::all_of(star_.points.begin(), star_.points.end(), [&](const FlatStar::Point& x) {
    const Vec3d& p =
        x.vertex < vertices_ ? surface_points_[at(x.vertex)] : samples_[at(x.vertex - vertices_)].position;
    return std::any_of(candidates.begin(), candidates.end(), [&](const Candidate& candidate) {
      const auto& n = candidate.node;
      const Vec3d &a = mesh_.point(VertexHandle(n[0])), &b = mesh_.point(VertexHandle(n[1])),
                  &c = mesh_.point(VertexHandle(n[2]));
      const Vec3d w = closest_barycentric(p, a, b, c);
      return (w[0] * a + w[1] * b + w[2] * c - p).sqrnorm() <= tolerance_ * tolerance_;
    });
  });
}

// Whether the star, all of it joined to `keep`, is still along the surface and near to it. Where a triangle
// was turned over before, none may be afterwards: in a flat place nothing else would tell.
bool MeshEmbedding::is_surface_kept(VertexHandle keep, Care care) const {
  const bool last = care == Care::topology;
  if (!star_.has_samples && !last && std::isinf(tolerance_)) return true;
  const auto fan = fan_to(keep);
  if (!std::isinf(tolerance_) && !is_near(fan)) return false;
  return last ? is_along(fan, 0, true) : !star_.has_samples || is_along(fan, least_agreement, false);
}

std::vector<MeshEmbedding::Candidate> MeshEmbedding::around(VertexHandle keep) const {
  std::vector<Candidate> result;
  for (const auto f : mesh_.vf_range(keep)) {
    auto c = mesh_.cfv_begin(f);
    const int p = c->idx(), q = (++c)->idx(), r = (++c)->idx();
    result.push_back({{p, q, r}, f});
  }
  return result;
}

// The triangles that took the place of the star hold its points now.
void MeshEmbedding::pin_again(const std::vector<Candidate>& candidates) {
  if (star_.points.empty()) return;
  const auto flat = placed(candidates);
  for (const FlatStar::Point& x : star_.points) {
    const Landing landing = land(x, flat);
    if (landing.candidate)
      pinned_[at(landing.candidate->face.idx())].push_back({x.vertex, landing.barycentric});
  }
}

void MeshEmbedding::flip_edge(OpenMesh::EdgeHandle e) {
  lay_flat(e);
  const auto h = mesh_.halfedge_handle(e, 0), o = mesh_.halfedge_handle(e, 1);
  const VertexHandle c = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h));
  pinned_[at(mesh_.face_handle(h).idx())].clear();
  pinned_[at(mesh_.face_handle(o).idx())].clear();
  ++step_;
  for (const auto& entry : star_.ring) changed_[at(entry.first)] = step_;
  mesh_.flip(e);
  pin_again(around(c));
}

}  // namespace anisomesh::detail
