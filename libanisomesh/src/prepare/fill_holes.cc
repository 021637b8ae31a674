#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <numeric>
#include <string>

#include "anisomesh/errors.hh"
#include "anisomesh/holes.hh"
#include "numerics/disjoint_sets.hh"
#include "numerics/hole_triangulation.hh"
#include "surface/cut_surface.hh"
#include "surface/unfit_mesh.hh"

namespace anisomesh {

namespace {

using namespace detail;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

constexpr size_t kMostEdges = 1000;  // triangulate_hole() takes the third power
// Degrees between normals: more is taken for a fold. A single triangle was there, among slivers as it may be;
// it is only refused where it lies on a face that is there.
constexpr double kMostBend = 150, kMostBendOfOne = 179.9;

enum class Left { folding, non_manifold };

// A border edge as the hole sees it. A place is all border vertices that lie there; a fan is the faces around
// one of them from gap to gap.
struct Rim {
  HalfedgeHandle halfedge;
  int place[2] = {0, 0};      // from, to
  size_t corner[2] = {0, 0};  // of the face beside it, by 3 * face + corner: stands for the fan there
};

size_t corner_at(const SurfaceRef& surface, OpenMesh::FaceHandle face, VertexHandle vertex) {
  const auto c = surface.corners(face);
  const size_t i = c.vertex[0] == vertex ? 0 : c.vertex[1] == vertex ? 1 : 2;
  return 3 * static_cast<size_t>(face.idx()) + i;
}

class HoleFiller {
 public:
  HoleFiller(const SurfaceRef& surface, size_t max_edges)
      : surface_(surface),
        mesh_(surface.connectivity()),
        max_edges_(max_edges),
        fans_(3 * mesh_.n_faces()),
        place_(mesh_.n_vertices(), -1) {
    find_places();
    join_fans();
    find_rims();
    count_edges();
  }

  /// Holes that touch are closed from the shortest on, each time by other fans at the places where they do;
  /// what is left then may go along one fan, as a lone hole does.
  void run() {
    for (const bool other_fan : {true, false})
      while (close_shortest(other_fan)) {
      }
  }
  OpenMesh::TriMesh result(FillReport& report);

 private:
  void find_places();
  void join_fans();
  void find_rims();
  void count_edges();
  bool close_shortest(bool other_fan);
  std::vector<size_t> shortest_loop(size_t start, bool other_fan);
  bool close(const std::vector<size_t>& loop);
  void leave(const std::vector<size_t>& loop, Left why);
  void count_left(const OpenMesh::TriMesh& mesh, const std::vector<int>& place, FillReport& report) const;
  size_t fan(const Rim& rim, int end) { return fans_.root(rim.corner[end]); }
  int& edges_between(int a, int b) { return edges_[std::minmax(a, b)]; }
  bool is_simple(const std::vector<size_t>& loop) const;

  const SurfaceRef& surface_;
  OpenMesh::TriConnectivity& mesh_;
  size_t max_edges_;
  DisjointSets fans_;
  std::vector<int> place_;  // of each vertex on the border
  std::vector<Rim> rims_;
  std::vector<std::vector<size_t>> leaving_;  // of each place, the rims that start there
  std::map<std::pair<int, int>, int> edges_;  // between two places: how many
  std::vector<char> closed_;                  // of each rim
  std::vector<size_t> parent_, seen_;         // of the search
  size_t searches_ = 0;
  std::vector<std::array<size_t, 3>> triangles_;  // new ones, by a corner that stands for the fan
  std::map<std::pair<int, int>, Left> left_;
  size_t holes_ = 0;
};

void HoleFiller::find_places() {
  std::vector<int> border;
  for (const auto v : mesh_.all_vertices())
    if (!mesh_.is_isolated(v) && mesh_.is_boundary(v)) border.push_back(v.idx());
  const auto key = [this](int v) {
    const Vec3d& p = surface_.point(VertexHandle(v));
    return std::array<double, 3>{p[0], p[1], p[2]};
  };
  std::stable_sort(border.begin(), border.end(), [&](int a, int b) { return key(a) < key(b); });
  int places = 0;
  for (size_t i = 0; i < border.size(); ++i) {
    if (i > 0 && key(border[i]) != key(border[i - 1])) ++places;
    place_[static_cast<size_t>(border[i])] = places;
  }
  leaving_.resize(static_cast<size_t>(places) + 1);
}

void HoleFiller::join_fans() {
  for (const auto e : mesh_.all_edges()) {
    if (e.is_boundary()) continue;
    for (const auto v : {e.v0(), e.v1()})
      fans_.join(corner_at(surface_, e.h0().face(), v), corner_at(surface_, e.h1().face(), v));
  }
}

void HoleFiller::find_rims() {
  for (const auto h : mesh_.all_halfedges()) {
    if (!h.is_boundary()) continue;
    const auto beside = h.opp().face();
    Rim rim;
    rim.halfedge = h;
    for (const int end : {0, 1}) {
      const VertexHandle v = end == 0 ? h.from() : h.to();
      rim.place[end] = place_[static_cast<size_t>(v.idx())];
      rim.corner[end] = corner_at(surface_, beside, v);
    }
    leaving_[static_cast<size_t>(rim.place[0])].push_back(rims_.size());
    rims_.push_back(rim);
  }
  closed_.assign(rims_.size(), 0);
  parent_.assign(rims_.size(), 0);
  seen_.assign(rims_.size(), 0);
}

void HoleFiller::count_edges() {
  for (const auto e : mesh_.all_edges()) {
    const int a = place_[static_cast<size_t>(e.v0().idx())], b = place_[static_cast<size_t>(e.v1().idx())];
    if (a >= 0 && b >= 0) ++edges_between(a, b);
  }
}

// Breadth first, from border edge to border edge. Empty if there is none that is short enough.
std::vector<size_t> HoleFiller::shortest_loop(size_t start, bool other_fan) {
  const size_t mark = ++searches_;
  std::vector<size_t> level{start}, next;
  for (size_t length = 1; length <= max_edges_ && !level.empty(); ++length) {
    next.clear();
    for (const size_t r : level) {
      const auto& onward = leaving_[static_cast<size_t>(rims_[r].place[1])];
      const auto open = std::count_if(onward.begin(), onward.end(), [&](size_t o) { return !closed_[o]; });
      for (const size_t o : onward) {
        if (closed_[o] || seen_[o] == mark) continue;
        if (other_fan && open > 1 && fan(rims_[r], 1) == fan(rims_[o], 0)) continue;
        seen_[o] = mark;
        parent_[o] = r;
        if (o == start) {
          std::vector<size_t> loop{start};
          for (size_t back = r; back != start; back = parent_[back]) loop.push_back(back);
          std::reverse(loop.begin() + 1, loop.end());
          return loop;
        }
        next.push_back(o);
      }
    }
    std::swap(level, next);
  }
  return {};
}

bool HoleFiller::is_simple(const std::vector<size_t>& loop) const {
  std::vector<int> places;
  places.reserve(loop.size());
  for (const size_t r : loop) places.push_back(rims_[r].place[0]);
  std::sort(places.begin(), places.end());
  return std::adjacent_find(places.begin(), places.end()) == places.end();
}

void HoleFiller::leave(const std::vector<size_t>& loop, Left why) {
  for (const size_t r : loop) left_[{rims_[r].place[0], rims_[r].place[1]}] = why;
}

bool HoleFiller::close(const std::vector<size_t>& loop) {
  const auto place = [&](int i) { return rims_[loop[static_cast<size_t>(i)]].place[0]; };
  const int n = static_cast<int>(loop.size());
  bool manifold = n >= 3 && is_simple(loop);
  for (int i = 0; manifold && i < n; ++i) manifold = edges_between(place(i), place((i + 1) % n)) == 1;
  if (!manifold) return leave(loop, Left::non_manifold), false;
  HoleRim rim;
  for (const size_t r : loop) {
    const auto h = rims_[r].halfedge;
    rim.corner.push_back(surface_.point(mesh_.from_vertex_handle(h)));
    rim.beyond.push_back(surface_.point(
        mesh_.to_vertex_handle(mesh_.next_halfedge_handle(mesh_.opposite_halfedge_handle(h)))));
  }
  const auto triangles = triangulate_hole(rim, n == 3 ? kMostBendOfOne : kMostBend, [&](int i, int k) {
    return edges_.count(std::minmax(place(i), place(k))) > 0;
  });
  if (triangles.empty()) return leave(loop, Left::folding), false;
  for (size_t i = 0; i < loop.size(); ++i) {
    closed_[loop[i]] = 1;
    fans_.join(rims_[loop[i]].corner[1], rims_[loop[(i + 1) % loop.size()]].corner[0]);
  }
  for (const auto& t : triangles) {
    std::array<size_t, 3> corners{};
    for (size_t k = 0; k < 3; ++k) {
      corners[k] = rims_[loop[static_cast<size_t>(t[k])]].corner[0];
      ++edges_between(place(t[k]), place(t[(k + 1) % 3]));
    }
    triangles_.push_back(corners);
  }
  ++holes_;
  return true;
}

// Tries every loop once, the shortest first. \return whether a hole was closed, so that others may be found
bool HoleFiller::close_shortest(bool other_fan) {
  std::vector<std::pair<size_t, size_t>> found;  // length, rim
  for (size_t r = 0; r < rims_.size(); ++r) {
    if (closed_[r]) continue;
    const auto loop = shortest_loop(r, other_fan);
    if (!loop.empty()) found.emplace_back(loop.size(), r);
  }
  std::sort(found.begin(), found.end());
  std::vector<char> tried(rims_.size(), 0);
  bool any = false;
  for (const auto& [length, r] : found) {
    if (closed_[r] || tried[r]) continue;
    const auto loop = shortest_loop(r, other_fan);
    if (loop.size() != length) continue;  // changed by those closed before: next time
    const bool done = close(loop);
    any = any || done;
    for (const size_t member : loop) tried[member] = 1;
  }
  return any;
}

// Loops of the result that are still open.
void HoleFiller::count_left(const OpenMesh::TriMesh& mesh, const std::vector<int>& place,
                            FillReport& report) const {
  std::vector<char> seen(mesh.n_halfedges(), 0);
  for (const auto start : mesh.halfedges()) {
    if (!start.is_boundary() || seen[static_cast<size_t>(start.idx())]) continue;
    size_t length = 0;
    bool folding = false;
    auto h = start;
    do {
      seen[static_cast<size_t>(h.idx())] = 1;
      ++length;
      const auto why =
          left_.find({place[static_cast<size_t>(h.from().idx())], place[static_cast<size_t>(h.to().idx())]});
      folding = folding || (why != left_.end() && why->second == Left::folding);
      h = h.next();
    } while (h != start);
    ++(length > max_edges_ ? report.left_long : folding ? report.left_folding : report.left_non_manifold);
  }
}

OpenMesh::TriMesh HoleFiller::result(FillReport& report) {
  OpenMesh::TriMesh mesh;
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  // A vertex for each fan, in the order of the input's vertices.
  std::vector<int> vertex_of_fan(3 * mesh_.n_faces(), -1), place;
  report.vertex_of.assign(mesh_.n_vertices(), -1);
  const auto add = [&](VertexHandle old) {
    place.push_back(place_[static_cast<size_t>(old.idx())]);
    return mesh.add_vertex(surface_.point(old)).idx();
  };
  for (const auto v : mesh_.all_vertices()) {
    int& first = report.vertex_of[static_cast<size_t>(v.idx())];
    if (mesh_.is_isolated(v)) first = add(v);
    for (const auto f : mesh_.vf_range(v)) {
      int& vertex = vertex_of_fan[fans_.root(corner_at(surface_, f, v))];
      if (vertex < 0) vertex = add(v);
      if (first < 0) first = vertex;
    }
  }
  const auto vertex = [&](size_t corner) { return VertexHandle(vertex_of_fan[fans_.root(corner)]); };
  for (const auto f : mesh_.all_faces()) {
    const size_t c = 3 * static_cast<size_t>(f.idx());
    mesh.add_face(vertex(c), vertex(c + 1), vertex(c + 2));
    auto h = mesh_.halfedge_handle(f);
    for (size_t i = 0; i < 3; ++i, h = mesh_.next_halfedge_handle(h))
      if (is_feature(mesh_, mesh_.edge_handle(h))) {
        const auto made = mesh.find_halfedge(vertex(c + (i + 2) % 3), vertex(c + i));
        mesh.status(mesh.edge_handle(made)).set_feature(true);
      }
  }
  for (const auto& t : triangles_) mesh.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2]));
  report.closed = holes_;
  report.triangles = triangles_.size();
  report.joined_vertices =
      mesh_.n_vertices() > mesh.n_vertices() ? mesh_.n_vertices() - mesh.n_vertices() : 0;
  count_left(mesh, place, report);
  return mesh;
}

}  // namespace

void FillOptions::validate() const {
  if (max_edges != 0 && (max_edges < 3 || max_edges > kMostEdges))
    throw InvalidOption("max_edges of a hole is " + std::to_string(max_edges) + ", must be 0 or from 3 to " +
                        std::to_string(kMostEdges));
}

OpenMesh::TriMesh fill_holes(const SurfaceRef& surface, const FillOptions& options, FillReport* report) {
  const auto start = std::chrono::steady_clock::now();
  options.validate();
  HoleFiller filler(detail::unchanged(surface), options.max_edges);
  if (options.max_edges > 0) filler.run();
  FillReport done;
  OpenMesh::TriMesh mesh = filler.result(done);
  done.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (report) *report = done;
  return mesh;
}

}  // namespace anisomesh
