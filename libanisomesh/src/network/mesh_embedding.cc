#include "network/mesh_embedding.hh"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_set>

#include "anisomesh/errors.hh"
#include "surface/rounding.hh"

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
constexpr double negligible =
    1e-10;                        // squared, of the longest side: two nodes in one place but for rounding,
constexpr double thinner = 0.02;  // which may leave so much of the area
constexpr double pi = 3.14159265358979323846;
constexpr int flip_passes = 50, vertices_a_breath = 256;
constexpr unsigned large_star =
    24;  // what has taken so many in waits, or it would take the next one in, and the next
constexpr unsigned huge_star = 96;   // likewise, where lines are taken out
constexpr size_t most_judged = 64;   // neighbours, by what each would turn over: the nearest
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
  changed_.assign(overlay.points.size(), 0);
  stuck_.assign(overlay.points.size(), -1);
  for (const auto v : surface.connectivity().vertices()) surface_points_.push_back(surface.point(v));
  add_samples(surface, overlay, network);
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
  const double moved = (place - mesh_.point(gone)).sqrnorm();
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
    const double old = cross(mesh_.point(a) - mesh_.point(gone), mesh_.point(b) - mesh_.point(gone)).norm();
    if (!(length > least_area * longest) && !(moved < negligible * longest && length > thinner * old))
      return false;
    if (care == Care::shape && length < least_shape * longest && is_surely_less(length, old)) return false;
  }
  return true;
}

bool MeshEmbedding::collapse(VertexHandle gone, VertexHandle keep, Care care) {
  const HalfedgeHandle h = mesh_.find_halfedge(gone, keep);
  if (!h.is_valid() || !is_topology_kept(h)) return false;
  if (care != Care::topology && !is_shape_kept(h, care)) return false;
  if (laid_flat_ != gone) lay_flat(gone);
  if (!is_surface_kept(keep, care)) return false;
  join(h);
  return true;
}

// The star of the vertex that goes is laid flat.
void MeshEmbedding::join(HalfedgeHandle h) {
  laid_flat_ = VertexHandle();
  const VertexHandle gone = mesh_.from_vertex_handle(h), keep = mesh_.to_vertex_handle(h);
  for (const auto f : mesh_.vf_range(gone)) pinned_[at(f.idx())].clear();
  mesh_.collapse(h);
  changed_[at(keep.idx())] = ++step_;
  for (const auto w : mesh_.vv_range(keep)) changed_[at(w.idx())] = step_;
  pin_again(around(keep));
  for (const auto f : mesh_.vf_range(keep)) {
    auto v = mesh_.cfv_begin(f);
    const Vec3d &p = mesh_.point(*v), &q = mesh_.point(*++v), &r = mesh_.point(*++v);
    const Vec3d normal = cross(q - p, r - p);
    const double length = normal.norm();
    const double longest = std::max({(q - p).sqrnorm(), (r - q).sqrnorm(), (p - r).sqrnorm()});
    if (length > 1e-4 * longest) normals_[at(f.idx())] = normal / length;
  }
}

// Whether nothing has changed since then that says whether the vertex can go.
bool MeshEmbedding::is_as_at(int step, VertexHandle v) const {
  if (changed_[at(v.idx())] > step) return false;
  for (const auto w : mesh_.vv_range(v))
    if (changed_[at(w.idx())] > step) return false;
  return true;
}

bool MeshEmbedding::straighten(int a, int node, int b) {
  const VertexHandle from(node);
  if (stuck_[at(node)] >= 0 && is_as_at(stuck_[at(node)], from)) return false;
  const auto distance = [&](int n) { return (mesh_.point(VertexHandle(n)) - mesh_.point(from)).sqrnorm(); };
  if (is_surely_less(distance(b), distance(a))) std::swap(a, b);
  if (collapse(from, VertexHandle(a), Care::turning) || collapse(from, VertexHandle(b), Care::turning) ||
      cut_corner(VertexHandle(a), from, VertexHandle(b)))
    return true;
  stuck_[at(node)] = step_;
  return false;
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
  const HalfedgeHandle away = mesh_.find_halfedge(node, a);
  if (!away.is_valid() || !is_topology_kept(away)) return false;
  lay_flat(node);
  join(away);
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

// The nodes of a line lie in a row, across many triangles where these are thin: one after the other they
// would all end in the last, whose star would hold the whole row. So what has a large star waits for a pass.
void MeshEmbedding::drop(const std::vector<int>& nodes) {
  std::vector<int> waiting = nodes;
  std::unordered_set<int> touched;
  while (!waiting.empty()) {
    std::vector<int> left;
    touched.clear();
    for (const int n : waiting) {
      const VertexHandle v(n);
      if (mesh_.status(v).deleted() || mesh_.is_isolated(v)) continue;
      if (touched.count(n) && mesh_.valence(v) > huge_star) {
        left.push_back(n);
        continue;
      }
      const std::vector<int> around = neighbours(n);
      if (take_out(v, Care::turning)) touched.insert(around.begin(), around.end());
    }
    waiting = std::move(left);
  }
}

bool MeshEmbedding::take_out(VertexHandle v, Care care) {
  using Neighbour = std::pair<double, VertexHandle>;
  const auto by_key = [](const Neighbour& a, const Neighbour& b) { return a.first < b.first; };
  const auto measured = [](const std::vector<Neighbour>& beside, auto&& measure) {
    std::vector<double> keys;
    for (const auto& w : beside) keys.push_back(measure(w.second));
    keys = in_steps(std::move(keys));
    std::vector<Neighbour> result;
    for (size_t i = 0; i < keys.size(); ++i) result.emplace_back(keys[i], beside[i].second);
    return result;
  };
  std::vector<Neighbour> near;
  for (const auto w : mesh_.vv_range(v)) near.emplace_back(0, w);
  near = measured(near, [&](VertexHandle w) { return (mesh_.point(w) - mesh_.point(v)).sqrnorm(); });
  std::sort(near.begin(), near.end());
  const bool last = care == Care::topology;
  if (last) {  // Something will be turned over: as little as can be. Where it is the same, the nearest takes
               // the star in: in a flat place one vertex would take in all others.
    near.resize(std::min(near.size(), most_judged));
    near = measured(near, [&](VertexHandle w) { return -lowest_cosine(v, w); });
    std::stable_sort(near.begin(), near.end(), by_key);
  }
  const size_t tried = last ? near.size() : std::min(near.size(), nearest_tried);
  for (size_t i = 0; i < tried; ++i) {
    if (last && !(near[i].first < 0)) break;  // this one turns a triangle over, and the rest
    if (collapse(v, near[i].second, care)) return true;
  }
  return false;
}

double MeshEmbedding::cosine(VertexHandle a, VertexHandle b, VertexHandle c, const Vec3d& surface) const {
  const Vec3d normal = cross(mesh_.point(b) - mesh_.point(a), mesh_.point(c) - mesh_.point(a));
  const double lengths = normal.norm() * surface.norm();
  return lengths > 0 ? (normal | surface) / lengths : 0;
}

double MeshEmbedding::cosine_to_surface(VertexHandle a, VertexHandle b, VertexHandle c) const {
  return cosine(a, b, c,
                node_normals_[at(a.idx())] + node_normals_[at(b.idx())] + node_normals_[at(c.idx())]);
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
void MeshEmbedding::coarsen(const NetworkGraph& network, double tolerance,
                            const std::function<void()>& breathe) {
  tolerance_ = tolerance;
  std::vector<int> waiting;
  const auto is_kept = [&](VertexHandle v) {
    return v.idx() < vertices_ && !network.share.empty() && network.share[at(v.idx())] <= kept_share;
  };
  for (const auto v : mesh_.all_vertices())
    if (!mesh_.status(v).deleted() && !mesh_.is_isolated(v) && network.graph.degree(v.idx()) == 0 &&
        !network.fixed[at(v.idx())] && !is_kept(v))
      waiting.push_back(v.idx());
  std::vector<int> touched(mesh_.n_vertices(), -1);
  std::vector<int> failed(mesh_.n_vertices(), -1);  // the step; it need not be tried again before another
  int pass = 0, tried = 0;
  for (const Care care : {Care::shape, Care::turning, Care::topology}) {
    std::fill(failed.begin(), failed.end(), -1);
    while (true) {
      ++pass;
      std::vector<int> left;
      for (const int n : waiting) {
        const VertexHandle v(n);
        if (touched[at(n)] == pass && (care == Care::shape || mesh_.valence(v) > large_star)) {
          left.push_back(n);
          continue;
        }
        if (breathe && ++tried % vertices_a_breath == 0) breathe();
        if (failed[at(n)] < 0 || !is_as_at(failed[at(n)], v)) {
          std::vector<int> around;
          for (const auto w : mesh_.vv_range(v)) around.push_back(w.idx());
          if (take_out(v, care)) {
            for (const int w : around) touched[at(w)] = pass;
            continue;
          }
          failed[at(n)] = step_;
        }
        left.push_back(n);
      }
      const bool done = left.size() == waiting.size() || left.empty();
      waiting = std::move(left);
      if (done) break;
    }
  }
  tolerance_ = std::numeric_limits<double>::infinity();
}

// What the surface's samples in the two triangles at an edge say; zero where there are none.
Vec3d MeshEmbedding::sampled_normal(OpenMesh::EdgeHandle e) const {
  Vec3d sum(0, 0, 0);
  for (unsigned i = 0; i < 2; ++i)
    for (const Pinned& x : pinned_[at(mesh_.face_handle(mesh_.halfedge_handle(e, i)).idx())])
      if (x.vertex >= vertices_) sum += samples_[at(x.vertex - vertices_)].normal;
  return sum;
}

void MeshEmbedding::flip(const NetworkGraph& network) {
  std::vector<char> on_feature(network.graph.n_nodes(), 0);
  for (size_t n = 0; n < on_feature.size(); ++n)
    on_feature[n] = network.touches(static_cast<int>(n), EdgeKind::feature);
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
      // Where features meet all corners, as in the wall of a thin plate, no corner knows the side that is
      // meant.
      const bool between = on_feature[at(a.idx())] && on_feature[at(b.idx())] && on_feature[at(c.idx())] &&
                           on_feature[at(d.idx())];
      const Vec3d sampled = between ? sampled_normal(e) : Vec3d(0, 0, 0);
      const auto cosine_there = [&](VertexHandle u, VertexHandle v, VertexHandle w) {
        return sampled.sqrnorm() == 0 ? cosine_to_surface(u, v, w) : cosine(u, v, w, sampled);
      };
      const double now = std::min(cosine_there(a, b, c), cosine_there(b, a, d));
      const bool wanted = now <= turned_cosine || angle(c, a, b) + angle(d, a, b) > pi + 1e-6;
      if (!wanted || !mesh_.is_flip_ok(e)) continue;
      const double then = std::min(cosine_there(a, d, c), cosine_there(d, b, c));
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
  std::vector<int> index(mesh_.n_faces(), -1);
  for (const auto f : mesh_.faces()) {
    index[at(f.idx())] = static_cast<int>(result.size());
    auto v = mesh_.cfv_begin(f);
    const int a = v->idx(), b = (++v)->idx(), c = (++v)->idx();
    result.push_back({{a, b, c}, {-1, -1, -1}, &pinned_[at(f.idx())]});
  }
  for (Triangle& t : result)
    for (size_t k = 0; k < 3; ++k) {
      const auto h = mesh_.find_halfedge(VertexHandle(t.node[k]), VertexHandle(t.node[(k + 1) % 3]));
      const FaceHandle beyond = mesh_.opposite_face_handle(h);
      if (beyond.is_valid()) t.across[k] = index[at(beyond.idx())];
    }
  return result;
}

std::vector<int> MeshEmbedding::neighbours(int node) const {
  std::vector<int> result;
  for (const auto w : mesh_.vv_range(VertexHandle(node))) result.push_back(w.idx());
  return result;
}

}  // namespace anisomesh::detail
