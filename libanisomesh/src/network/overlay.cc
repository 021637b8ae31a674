#include "network/overlay.hh"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "anisomesh/features.hh"
#include "network/line_places.hh"
#include "network/section_path.hh"
#include "numerics/arrangement.hh"

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

constexpr int no_kind = -1;
// Places are rounded to so many bits, so that points of an edge lie on it exactly, in both its triangles.
constexpr double edge_grid = 1 << 30, face_grid = 1ll << 40;

class Drawing {
 public:
  Drawing(const SurfaceRef& surface, const LineNetwork& lines, double corner_angle,
          const std::vector<char>& kept_faces)
      : surface_(surface),
        lines_(lines),
        corner_angle_(corner_angle),
        kept_faces_(kept_faces),
        arrays_(surface) {}

  Overlay run() {
    add_vertices();
    draw_lines();
    for (const SurfacePoint& sample : lines_.isotropic_samples)
      node_at(place_of(arrays_, sample), Origin::isotropic, true);
    if (!kept_faces_.empty()) clear_kept_faces();
    divide_faces();
    return std::move(overlay_);
  }

 private:
  // A straight piece of a line within one face.
  struct Piece {
    int face, a, b, kind;
  };
  struct Divided {
    std::vector<std::array<int, 3>> triangles;  // nodes; -1 - i: the i-th of `crossings`
    std::vector<Overlay::Drawn> edges;
    std::vector<Vec3d> crossings;  // barycentric
    size_t line_crossings = 0;
  };
  struct EdgeNode {
    double t;
    int node;
  };

  void add_vertices();
  void draw_lines();
  void connect(const Place& from, int a, const Place& to, int b, int kind);
  int add_node(const SurfacePoint& point, Origin origin, bool fixed);
  int node_on_edge(const EdgeCrossing& crossing, int face, Origin origin, bool fixed);
  int node_at(const Place& place, Origin origin, bool fixed);
  bool is_kept(int face) const { return face >= 0 && !kept_faces_.empty() && kept_faces_[at(face)]; }
  void clear_kept_faces();
  void divide_faces();
  void divide(int face, const Piece* begin, const Piece* end, const std::vector<int>& inside,
              Divided& result) const;
  std::vector<EdgeNode> nodes_between(int a, int b) const;
  int kind_of_edge(int face, int side) const;
  Vec2d local(int face, int node) const;
  void append(int face, const Divided& divided);

  const SurfaceRef& surface_;
  const LineNetwork& lines_;
  double corner_angle_;
  const std::vector<char>& kept_faces_;
  SurfaceArrays arrays_;
  Overlay overlay_;
  std::vector<Piece> pieces_;
  std::unordered_map<std::uint64_t, std::vector<EdgeNode>> edge_nodes_;  // by edge, ascending by t at the end
  std::vector<std::array<int, 2>> face_nodes_;                           // face, node inside it
  std::unordered_map<int, EdgeCrossing> edge_of_node_;  // where each node that is on an edge crosses it
};

std::uint64_t key_of(int low, int high) {
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(low)) << 32) |
         static_cast<std::uint32_t>(high);
}

void Drawing::add_vertices() {
  const auto& mesh = surface_.connectivity();
  for (const auto v : mesh.vertices()) {
    if (mesh.is_isolated(v)) {  // no triangle will have it
      add_node({OpenMesh::FaceHandle(0), {1, 0, 0}}, Origin::line, false);
      continue;
    }
    auto h = mesh.halfedge_handle(v);
    if (mesh.is_boundary(h)) h = mesh.opposite_halfedge_handle(h);
    SurfacePoint point{mesh.face_handle(h), {0, 0, 0}};
    point.barycentric[arrays_.corner_of(point.face.idx(), v.idx())] = 1;
    const Origin origin = mesh.is_boundary(v)            ? Origin::border
                          : arrays_.at_wall[at(v.idx())] ? Origin::feature
                                                         : Origin::line;
    add_node(point, origin, false);
  }
  for (const auto v : feature_skeleton(surface_, corner_angle_).corners) {
    overlay_.origins[at(v.idx())] = Origin::corner;
    overlay_.fixed[at(v.idx())] = 1;
  }
}

int Drawing::add_node(const SurfacePoint& point, Origin origin, bool fixed) {
  overlay_.points.push_back(point);
  overlay_.origins.push_back(origin);
  overlay_.fixed.push_back(fixed);
  return static_cast<int>(overlay_.points.size()) - 1;
}

int Drawing::node_on_edge(const EdgeCrossing& crossing, int face, Origin origin, bool fixed) {
  const double t = std::round(crossing.t * edge_grid) / edge_grid;
  auto& nodes = edge_nodes_[key_of(crossing.vertex[0], crossing.vertex[1])];
  for (const EdgeNode& n : nodes)
    if (n.t == t) return n.node;
  SurfacePoint point{OpenMesh::FaceHandle(face), {0, 0, 0}};
  const int low = arrays_.corner_of(face, crossing.vertex[0]),
            high = arrays_.corner_of(face, crossing.vertex[1]);
  point.barycentric[low] = 1 - t;
  point.barycentric[high] = t;
  const auto& c = arrays_.corners[at(face)];
  const int side = c[at((low + 1) % 3)] == crossing.vertex[1] ? low : high;
  const int kind = kind_of_edge(face, side);
  if (kind == static_cast<int>(EdgeKind::border)) origin = Origin::border;
  if (kind == static_cast<int>(EdgeKind::feature)) origin = Origin::feature;
  const int node = add_node(point, origin, fixed);
  nodes.push_back({t, node});
  edge_of_node_[node] = {crossing.vertex, t};
  return node;
}

int Drawing::node_at(const Place& place, Origin origin, bool fixed) {
  if (place.vertex >= 0) {
    if (fixed && !overlay_.fixed[at(place.vertex)]) {
      overlay_.fixed[at(place.vertex)] = 1;
      if (overlay_.origins[at(place.vertex)] == Origin::line) overlay_.origins[at(place.vertex)] = origin;
    }
    return place.vertex;
  }
  if (place.on_edge()) return node_on_edge(place.edge, place.face, origin, fixed);
  SurfacePoint point{OpenMesh::FaceHandle(place.face), {0, 0, 0}};
  for (int k = 1; k < 3; ++k) {
    const double rounded = std::round(place.barycentric[k] * face_grid) / face_grid;
    point.barycentric[k] = std::max(rounded, 1 / face_grid);
  }
  point.barycentric[0] = 1 - point.barycentric[1] - point.barycentric[2];
  const int node = add_node(point, origin, fixed);
  face_nodes_.push_back({place.face, node});
  return node;
}

void Drawing::connect(const Place& from, int a, const Place& to, int b, int kind) {
  if (a == b) return;
  const int common = common_face(arrays_, from, to);
  if (common >= 0) {
    pieces_.push_back({common, a, b, kind});
    return;
  }
  const SectionPath path = section_path(arrays_, from, to);
  if (!path.found) return;
  int before = a;
  for (size_t i = 0; i < path.crossings.size(); ++i) {
    const int next = node_on_edge(path.crossings[i], path.faces[i], Origin::line, false);
    if (next != before) pieces_.push_back({path.faces[i], before, next, kind});
    before = next;
  }
  if (before != b) pieces_.push_back({path.faces.back(), before, b, kind});
}

void Drawing::draw_lines() {
  for (const Line& line : lines_.lines) {
    const int kind = static_cast<int>(line.kind == LineKind::min ? EdgeKind::min : EdgeKind::max);
    Place first, before;
    int first_node = -1, before_node = -1;
    for (const Place& place : places_of(arrays_, surface_, line, overlay_.left_out)) {
      const int node = node_at(place, Origin::line, false);
      if (before_node >= 0) connect(before, before_node, place, node, kind);
      if (first_node < 0) {
        first = place;
        first_node = node;
      }
      before = place;
      before_node = node;
    }
    if (line.closed && line.points.size() > 2) connect(before, before_node, first, first_node, kind);
  }
}

int Drawing::kind_of_edge(int face, int side) const {
  if (const int beyond = arrays_.neighbours[at(face)][at(side)]; beyond >= 0)
    return is_kept(face) || is_kept(beyond) ? static_cast<int>(EdgeKind::conforming) : no_kind;
  const auto& mesh = surface_.connectivity();
  // The halfedge of a face ends in corner 0, so the one after it leaves corner 0.
  auto h = mesh.next_halfedge_handle(mesh.halfedge_handle(OpenMesh::FaceHandle(face)));
  for (int k = 0; k < side; ++k) h = mesh.next_halfedge_handle(h);
  return static_cast<int>(mesh.is_boundary(mesh.edge_handle(h)) ? EdgeKind::border : EdgeKind::feature);
}

// Of what lies in kept faces only their vertices are left; lines end before them.
void Drawing::clear_kept_faces() {
  std::vector<char> gone(overlay_.points.size(), 0);
  for (int f = 0; f < arrays_.n_faces(); ++f) {
    if (!is_kept(f)) continue;
    const auto& corners = arrays_.corners[at(f)];
    for (size_t k = 0; k < 3; ++k) {
      const int a = corners[k], b = corners[(k + 1) % 3];
      overlay_.fixed[at(a)] = 1;
      if (overlay_.origins[at(a)] == Origin::isotropic) overlay_.origins[at(a)] = Origin::line;
      const auto found = edge_nodes_.find(key_of(std::min(a, b), std::max(a, b)));
      if (found == edge_nodes_.end()) continue;
      for (const EdgeNode& n : found->second) gone[at(n.node)] = 1;
      edge_nodes_.erase(found);
    }
  }
  for (const auto& entry : face_nodes_)
    if (is_kept(entry[0])) gone[at(entry[1])] = 1;
  for (size_t n = 0; n < gone.size(); ++n)
    if (gone[n]) overlay_.fixed[n] = 0;
  const auto is_gone = [&](int n) { return gone[at(n)] != 0; };
  pieces_.erase(
      std::remove_if(pieces_.begin(), pieces_.end(),
                     [&](const Piece& p) { return is_kept(p.face) || is_gone(p.a) || is_gone(p.b); }),
      pieces_.end());
  face_nodes_.erase(std::remove_if(face_nodes_.begin(), face_nodes_.end(),
                                   [&](const auto& entry) { return is_gone(entry[1]); }),
                    face_nodes_.end());
}

std::vector<Drawing::EdgeNode> Drawing::nodes_between(int a, int b) const {
  const auto found = edge_nodes_.find(key_of(std::min(a, b), std::max(a, b)));
  if (found == edge_nodes_.end()) return {};
  std::vector<EdgeNode> nodes = found->second;
  if (a > b) std::reverse(nodes.begin(), nodes.end());
  return nodes;
}

// In the triangle (0, 0), (1, 0), (0, 1).
Vec2d Drawing::local(int face, int node) const {
  Vec3d b(0, 0, 0);
  const auto edge = edge_of_node_.find(node);
  if (at(node) < arrays_.points.size()) {
    b[arrays_.corner_of(face, node)] = 1;
  } else if (edge != edge_of_node_.end()) {
    const EdgeCrossing& crossing = edge->second;
    b[arrays_.corner_of(face, crossing.vertex[0])] = 1 - crossing.t;
    b[arrays_.corner_of(face, crossing.vertex[1])] = crossing.t;
  } else {
    b = overlay_.points[at(node)].barycentric;
  }
  return {b[1], b[2]};
}

void Drawing::divide(int face, const Piece* begin, const Piece* end, const std::vector<int>& inside,
                     Divided& result) const {
  const auto& corners = arrays_.corners[at(face)];
  std::vector<int> around;
  std::vector<int> kinds;  // of the side from each node around to the next
  for (size_t k = 0; k < 3; ++k) {
    const int kind = kind_of_edge(face, static_cast<int>(k));
    around.push_back(corners[k]);
    kinds.push_back(kind);
    for (const EdgeNode& n : nodes_between(corners[k], corners[(k + 1) % 3])) {
      around.push_back(n.node);
      kinds.push_back(kind);
    }
  }
  const auto draw = [&](int a, int b, int kind) {
    if (kind >= 0) result.edges.push_back({{std::min(a, b), std::max(a, b)}, kind});
  };
  if (around.size() == 3 && inside.empty() && begin == end) {
    result.triangles.push_back({corners[0], corners[1], corners[2]});
    for (size_t k = 0; k < 3; ++k) draw(corners[k], corners[(k + 1) % 3], kinds[k]);
    return;
  }
  Arrangement arrangement({0, 0}, {1, 1});
  std::vector<int> global;
  std::unordered_map<int, int> local_of;
  const auto enter = [&](int node) {
    const auto known = local_of.find(node);
    if (known != local_of.end()) return known->second;
    const int own = arrangement.insert_point(local(face, node));
    if (at(own) == global.size()) global.push_back(node);
    return local_of[node] = own;
  };
  for (const int n : around) enter(n);
  for (size_t i = 0; i < around.size(); ++i)
    arrangement.insert_segment(enter(around[i]), enter(around[(i + 1) % around.size()]), kinds[i], 0);
  for (const int n : inside) enter(n);
  for (const Piece* p = begin; p != end; ++p) {
    enter(p->a);
    enter(p->b);
  }
  for (const Piece* p = begin; p != end; ++p) {
    const int a = enter(p->a), b = enter(p->b);
    if (a != b) arrangement.insert_segment(a, b, p->kind, 1);
  }
  const auto& graph = arrangement.graph();
  for (int n = static_cast<int>(global.size()); n < static_cast<int>(graph.n_nodes()); ++n) {
    const Vec2d& uv = graph.uv(n);
    global.push_back(-1 - static_cast<int>(result.crossings.size()));
    result.crossings.emplace_back(1 - uv[0] - uv[1], uv[0], uv[1]);
  }
  result.line_crossings = result.crossings.size();
  for (const auto& t : arrangement.triangles())
    if (*std::min_element(t.node.begin(), t.node.end()) >= 0)
      result.triangles.push_back({global[at(t.node[0])], global[at(t.node[1])], global[at(t.node[2])]});
  for (int e = 0; e < static_cast<int>(graph.n_edges()); ++e) {
    const auto& edge = graph.edge(e);
    if (edge.alive) draw(global[at(edge.node[0])], global[at(edge.node[1])], edge.kind);
  }
}

void Drawing::append(int face, const Divided& divided) {
  std::vector<int> crossing;
  for (const Vec3d& b : divided.crossings)
    crossing.push_back(add_node({OpenMesh::FaceHandle(face), b}, Origin::crossing, false));
  const auto node = [&](int n) { return n >= 0 ? n : crossing[at(-1 - n)]; };
  for (const auto& t : divided.triangles) {
    overlay_.triangles.push_back({node(t[0]), node(t[1]), node(t[2])});
    overlay_.faces.push_back(face);
  }
  for (const auto& e : divided.edges) {
    const int a = node(e.node[0]), b = node(e.node[1]);
    overlay_.edges.push_back({{std::min(a, b), std::max(a, b)}, e.kind});
  }
  overlay_.crossings += divided.line_crossings;
}

void Drawing::divide_faces() {
  for (auto& entry : edge_nodes_)
    std::sort(entry.second.begin(), entry.second.end(),
              [](const EdgeNode& x, const EdgeNode& y) { return x.t < y.t; });
  std::stable_sort(pieces_.begin(), pieces_.end(),
                   [](const Piece& x, const Piece& y) { return x.face < y.face; });
  std::sort(face_nodes_.begin(), face_nodes_.end());
  const int n = arrays_.n_faces();
  std::vector<Divided> divided(at(n));
  tbb::parallel_for(0, n, [&](int f) {
    const auto first = std::lower_bound(pieces_.begin(), pieces_.end(), f,
                                        [](const Piece& p, int face) { return p.face < face; });
    auto last = first;
    while (last != pieces_.end() && last->face == f) ++last;
    std::vector<int> inside;
    for (auto it = std::lower_bound(face_nodes_.begin(), face_nodes_.end(), std::array<int, 2>{f, -1});
         it != face_nodes_.end() && (*it)[0] == f; ++it)
      inside.push_back((*it)[1]);
    divide(f, pieces_.data() + (first - pieces_.begin()), pieces_.data() + (last - pieces_.begin()), inside,
           divided[at(f)]);
  });
  for (int f = 0; f < n; ++f) append(f, divided[at(f)]);
  auto& edges = overlay_.edges;  // of two faces each, where they lie between two
  std::sort(edges.begin(), edges.end(), [](const Overlay::Drawn& x, const Overlay::Drawn& y) {
    return x.node != y.node ? x.node < y.node : x.kind > y.kind;
  });
  edges.erase(std::unique(edges.begin(), edges.end(),
                          [](const Overlay::Drawn& x, const Overlay::Drawn& y) { return x.node == y.node; }),
              edges.end());
}

}  // namespace

Overlay overlay_lines(const SurfaceRef& surface, const LineNetwork& lines, double corner_angle_degrees,
                      const std::vector<char>& kept_faces) {
  return Drawing(surface, lines, corner_angle_degrees, kept_faces).run();
}

}  // namespace anisomesh::detail
