#include "mesh_embedding.hh"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "anisomesh/errors.hh"

namespace anisomesh::detail {

namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

size_t at(int i) { return static_cast<size_t>(i); }

constexpr double least_cosine = 0.3;   // to the normal that the triangle had before
constexpr double turned_cosine = 0.1;  // to the surface: below it a triangle counts as turned over
constexpr double least_shape = 0.02;   // twice the area over the square of the longest side
constexpr double least_area = 1e-7;    // likewise, where a triangle must only not be turned over
constexpr double pi = 3.14159265358979323846;
constexpr double least_weight = 0.01;  // what is pinned stays clear of the sides
constexpr int flip_passes = 50;
double cross2(const Vec2d& a, const Vec2d& b) { return a[0] * b[1] - a[1] * b[0]; }

constexpr size_t nearest_tried = 6;  // neighbours that a vertex may be moved to, unless nothing else is left

}  // namespace

MeshEmbedding::MeshEmbedding(const SurfaceRef& surface, const Overlay& overlay, const NetworkGraph& network)
    : node_normals_(network.normals), vertices_(static_cast<int>(surface.points().size())) {
  mesh_.reserve(overlay.points.size(), 3 * overlay.points.size(), overlay.triangles.size());
  for (const Vec3d& p : network.positions) mesh_.add_vertex(p);
  for (size_t t = 0; t < overlay.triangles.size(); ++t) {
    const auto& n = overlay.triangles[t];
    if (!mesh_.add_face(VertexHandle(n[0]), VertexHandle(n[1]), VertexHandle(n[2])).is_valid())
      throw CannotProcess("the lines cannot be drawn on triangle " + std::to_string(overlay.faces[t]) +
                          " of the surface; it is degenerate or not manifold there");
    const auto c = surface.corners(FaceHandle(overlay.faces[t]));
    Vec3d normal = cross(surface.point(c.vertex[1]) - surface.point(c.vertex[0]),
                         surface.point(c.vertex[2]) - surface.point(c.vertex[0]));
    const double length = normal.norm();
    normals_.push_back(length > 0 ? normal / length : normal);
  }
  pinned_.resize(normals_.size());
}

// As a fan around the vertex whose angles are scaled to a full turn, or to half of one on the border.
void MeshEmbedding::lay_flat(VertexHandle v) {
  star_.ring.clear();
  star_.points.clear();
  HalfedgeHandle start = mesh_.halfedge_handle(v);  // on the border OpenMesh keeps the border halfedge here
  const Vec3d& centre = mesh_.point(v);
  std::vector<double> angles;
  std::vector<FaceHandle> faces;
  double total = 0;
  // Counter-clockwise: from an outgoing halfedge to the one before it in its face, and across.
  HalfedgeHandle h =
      mesh_.is_boundary(start) ? mesh_.opposite_halfedge_handle(mesh_.prev_halfedge_handle(start)) : start;
  const bool open = mesh_.is_boundary(start);
  if (open) {  // the first face counter-clockwise after the gap
    h = start;
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

// Vertices beyond the two across the edge that both its ends have as neighbours would become a pinch; a
// vertex of three neighbours across the edge would keep two.
bool MeshEmbedding::is_topology_kept(HalfedgeHandle h) {
  if (!mesh_.is_collapse_ok(h)) return false;
  for (const auto side : {h, mesh_.opposite_halfedge_handle(h)}) {
    if (mesh_.is_boundary(side)) continue;
    const VertexHandle apex = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(side));
    if (!mesh_.is_boundary(apex) && mesh_.valence(apex) <= 3) return false;
  }
  // Where the last triangles of a border loop are: a loop of three edges stays.
  for (const auto side : {h, mesh_.opposite_halfedge_handle(h)})
    if (mesh_.is_boundary(side) &&
        mesh_.next_halfedge_handle(mesh_.next_halfedge_handle(mesh_.next_halfedge_handle(side))) == side)
      return false;
  return true;
}

bool MeshEmbedding::is_shape_kept(HalfedgeHandle h, Care care) const {
  const VertexHandle gone = mesh_.from_vertex_handle(h), keep = mesh_.to_vertex_handle(h);
  const Vec3d& place = mesh_.point(keep);
  for (const auto out : mesh_.voh_range(gone)) {
    if (mesh_.is_boundary(out)) continue;
    const VertexHandle a = mesh_.to_vertex_handle(out),
                       b = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(out));
    if (a == keep || b == keep) continue;
    const Vec3d ab = mesh_.point(b) - mesh_.point(a), along = mesh_.point(a) - place;
    const Vec3d normal = cross(along, mesh_.point(b) - place);
    const double length = normal.norm();
    const double longest = std::max({ab.sqrnorm(), along.sqrnorm(), (mesh_.point(b) - place).sqrnorm()});
    const Vec3d& before = normals_[at(mesh_.face_handle(out).idx())];
    const double cosine = care == Care::shape ? least_cosine : 0.0;
    if (before.sqrnorm() > 0 && !((normal | before) > cosine * length)) return false;
    if (!(length > least_area * longest)) return false;
    if (care == Care::shape && length < least_shape * longest) {
      const Vec3d old = cross(mesh_.point(a) - mesh_.point(gone), mesh_.point(b) - mesh_.point(gone));
      if (length < old.norm()) return false;  // no worse than it was
    }
  }
  return true;
}

bool MeshEmbedding::collapse(VertexHandle gone, VertexHandle keep, Care care) {
  const HalfedgeHandle h = mesh_.find_halfedge(gone, keep);
  if (!h.is_valid() || !is_topology_kept(h)) return false;
  if (care != Care::topology && !is_shape_kept(h, care)) return false;
  lay_flat(gone);
  mesh_.collapse(h);
  pin_again(keep);
  for (const auto f : mesh_.vf_range(keep)) {
    auto v = mesh_.cfv_begin(f);
    const Vec3d &p = mesh_.point(*v), &q = mesh_.point(*++v), &r = mesh_.point(*++v);
    const Vec3d normal = cross(q - p, r - p);
    const double length = normal.norm();
    const double longest = std::max({(q - p).sqrnorm(), (r - q).sqrnorm(), (p - r).sqrnorm()});
    if (length > 1e-4 * longest) normals_[at(f.idx())] = normal / length;
  }
  return true;
}

bool MeshEmbedding::straighten(int a, int node, int b) {
  const VertexHandle from(node);
  const auto distance = [&](int n) { return (mesh_.point(VertexHandle(n)) - mesh_.point(from)).sqrnorm(); };
  if (distance(b) < distance(a)) std::swap(a, b);
  return collapse(from, VertexHandle(a), Care::turning) || collapse(from, VertexHandle(b), Care::turning) ||
         cut_corner(VertexHandle(a), from, VertexHandle(b));
}

// The triangle that the chain gives up holds no other vertex: what lies around it can be triangulated
// without turning a triangle over, if not as a fan.
bool MeshEmbedding::cut_corner(VertexHandle a, VertexHandle node, VertexHandle b) {
  Vec3d normal(0, 0, 0);
  std::vector<VertexHandle> fan;
  for (const auto f : mesh_.vf_range(node)) normal += normals_[at(f.idx())];
  const auto turn = [&](const Vec3d& p, const Vec3d& q, const Vec3d& r) {
    return cross(q - p, r - p) | normal;
  };
  const Vec3d &pa = mesh_.point(a), &pn = mesh_.point(node), &pb = mesh_.point(b);
  const double side = turn(pa, pn, pb) < 0 ? -1 : 1;
  for (const auto w : mesh_.vv_range(node)) {
    if (w == a || w == b) continue;
    const Vec3d& p = mesh_.point(w);
    if (side * turn(pa, pn, p) >= 0 && side * turn(pn, pb, p) >= 0 && side * turn(pb, pa, p) >= 0)
      return false;
    if (!mesh_.find_halfedge(w, a).is_valid()) fan.push_back(w);
  }
  if (!collapse(node, a, Care::topology)) return false;
  for (bool changed = true; changed;) {
    changed = false;
    for (auto& w : fan) {
      if (!w.is_valid()) continue;
      const auto h = mesh_.find_halfedge(a, w);
      if (!h.is_valid() || mesh_.is_boundary(mesh_.edge_handle(h))) continue;
      const auto left = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h)),
                 right =
                     mesh_.to_vertex_handle(mesh_.next_halfedge_handle(mesh_.opposite_halfedge_handle(h)));
      const Vec3d &pw = mesh_.point(w), &pl = mesh_.point(left), &pr = mesh_.point(right);
      const double now = std::min(turn(pa, pw, pl), turn(pw, pa, pr));
      const double then = std::min(turn(pl, pr, pw), turn(pr, pl, pa));
      if (now > 0 || then <= now || !mesh_.is_flip_ok(mesh_.edge_handle(h))) continue;
      const auto faces = {mesh_.face_handle(h), mesh_.opposite_face_handle(h)};
      flip_edge(mesh_.edge_handle(h));
      for (const auto f : faces) normals_[at(f.idx())] = normal.normalized();
      w = VertexHandle();
      changed = true;
    }
  }
  return true;
}

bool MeshEmbedding::contract(int keep, int gone, const std::vector<int>&) {
  return collapse(VertexHandle(gone), VertexHandle(keep), Care::turning);
}

void MeshEmbedding::drop(int node) {
  const VertexHandle v(node);
  if (!mesh_.status(v).deleted() && !mesh_.is_isolated(v)) take_out(v, Care::turning);
}

bool MeshEmbedding::take_out(VertexHandle v, Care care) {
  std::vector<std::pair<double, VertexHandle>> near;
  for (const auto w : mesh_.vv_range(v)) near.emplace_back((mesh_.point(w) - mesh_.point(v)).sqrnorm(), w);
  if (care == Care::topology)  // something will be turned over: as little as can be
    for (auto& [key, w] : near) key = -lowest_cosine(v, w);
  std::sort(near.begin(), near.end());
  const size_t tried = care == Care::topology ? near.size() : std::min(near.size(), nearest_tried);
  for (size_t i = 0; i < tried; ++i)
    if (collapse(v, near[i].second, care)) return true;
  return false;
}

double MeshEmbedding::cosine_to_surface(VertexHandle a, VertexHandle b, VertexHandle c) const {
  const Vec3d normal = cross(mesh_.point(b) - mesh_.point(a), mesh_.point(c) - mesh_.point(a));
  const Vec3d surface = node_normals_[at(a.idx())] + node_normals_[at(b.idx())] + node_normals_[at(c.idx())];
  const double lengths = normal.norm() * surface.norm();
  return lengths > 0 ? (normal | surface) / lengths : 0;
}

// Of the triangles that moving a vertex to another would leave, to the normals of the surface.
double MeshEmbedding::lowest_cosine(VertexHandle gone, VertexHandle keep) const {
  double lowest = 1;
  for (const auto out : mesh_.voh_range(gone)) {
    if (mesh_.is_boundary(out)) continue;
    const VertexHandle a = mesh_.to_vertex_handle(out),
                       b = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(out));
    if (a != keep && b != keep) lowest = std::min(lowest, cosine_to_surface(keep, a, b));
  }
  return lowest;
}

// In passes that leave the neighbours of what went alone, so that the triangles stay of like size.
void MeshEmbedding::coarsen(const NetworkGraph& network) {
  std::vector<int> waiting;
  for (const auto v : mesh_.all_vertices())
    if (!mesh_.status(v).deleted() && !mesh_.is_isolated(v) && network.graph.degree(v.idx()) == 0 &&
        !network.fixed[at(v.idx())])
      waiting.push_back(v.idx());
  std::vector<int> touched(mesh_.n_vertices(), -1);
  int pass = 0;
  for (const Care care : {Care::shape, Care::turning, Care::topology}) {
    while (true) {
      ++pass;
      std::vector<int> left;
      size_t skipped = 0;
      for (const int n : waiting) {
        const VertexHandle v(n);
        if (touched[at(n)] == pass && care == Care::shape) {
          left.push_back(n);
          ++skipped;
          continue;
        }
        std::vector<int> around;
        for (const auto w : mesh_.vv_range(v)) around.push_back(w.idx());
        if (take_out(v, care))
          for (const int w : around) touched[at(w)] = pass;
        else
          left.push_back(n);
      }
      const bool done = left.size() == waiting.size() || left.empty();
      waiting = std::move(left);
      if (done) break;
    }
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

void MeshEmbedding::flip(const NetworkGraph& network) {
  const auto angle = [this](VertexHandle apex, VertexHandle a, VertexHandle b) {
    const Vec3d u = mesh_.point(a) - mesh_.point(apex), v = mesh_.point(b) - mesh_.point(apex);
    return std::atan2(cross(u, v).norm(), u | v);
  };
  bool changed = true;
  for (int pass = 0; changed && pass < flip_passes; ++pass) {
    changed = false;
    for (const auto e : mesh_.edges()) {
      if (mesh_.status(e).deleted() || mesh_.is_boundary(e)) continue;
      const auto h = mesh_.halfedge_handle(e, 0), o = mesh_.halfedge_handle(e, 1);
      const VertexHandle a = mesh_.from_vertex_handle(h), b = mesh_.to_vertex_handle(h);
      const VertexHandle c = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h)),
                         d = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(o));
      if (network.graph.find_edge(a.idx(), b.idx()) >= 0) continue;
      const double now = std::min(cosine_to_surface(a, b, c), cosine_to_surface(b, a, d));
      const bool wanted = now <= turned_cosine || angle(c, a, b) + angle(d, a, b) > pi + 1e-6;
      if (!wanted || !mesh_.is_flip_ok(e)) continue;
      const double then = std::min(cosine_to_surface(a, d, c), cosine_to_surface(d, b, c));
      // Among triangles that are turned over, as where a strip around a hole is twisted, shorter is better.
      const bool shorter = (mesh_.point(d) - mesh_.point(c)).sqrnorm() <
                           (1 - 1e-6) * (mesh_.point(b) - mesh_.point(a)).sqrnorm();
      if (now <= turned_cosine ? !(then > now + 1e-6 || shorter) : then <= turned_cosine) continue;
      flip_edge(e);
      changed = true;
    }
  }
}

std::vector<MeshEmbedding::Triangle> MeshEmbedding::triangles() const {
  std::vector<Triangle> result;
  for (const auto f : mesh_.faces()) {
    if (mesh_.status(f).deleted()) continue;
    auto v = mesh_.cfv_begin(f);
    const int a = v->idx(), b = (++v)->idx(), c = (++v)->idx();
    result.push_back({{a, b, c}, &pinned_[at(f.idx())]});
  }
  return result;
}

}  // namespace anisomesh::detail
