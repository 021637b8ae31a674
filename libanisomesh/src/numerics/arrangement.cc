#include "numerics/arrangement.hh"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <utility>

namespace anisomesh::detail {

using OpenMesh::Vec2d;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;
using Vertex = Triangulation::Vertex_handle;
using Face = Triangulation::Face_handle;
using Point = Kernel::Point_2;

Vec2d to_vec(const Point& p) { return {p.x(), p.y()}; }

double cross(const Vec2d& a, const Vec2d& b) { return a[0] * b[1] - a[1] * b[0]; }

// Where segment ab meets segment cd, rounded.
Point meeting_point(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Vec2d along = to_vec(d) - to_vec(c), other = to_vec(b) - to_vec(a);
  const double denominator = cross(along, other);
  double t = denominator != 0 ? cross(to_vec(a) - to_vec(c), other) / denominator : 0.5;
  t = std::clamp(t, 0.0, 1.0);
  const Vec2d p = to_vec(c) + t * along;
  return {p[0], p[1]};
}

}  // namespace

struct Arrangement::Implementation {
  Triangulation cdt;
  PlanarGraph graph;
  std::vector<Vertex> vertices;  // of each node
  std::vector<Crossing> crossings;
  Vertex last;  // where locating starts: unlike a face, it is not replaced when constraints are inserted

  int node_of(Vertex v) const { return v->info(); }
  Vertex new_node(Vertex v) {
    v->info() = graph.add_node(to_vec(v->point()));
    vertices.push_back(v);
    last = v;
    return v;
  }

  // What stops a segment on its way from `from` to `to`: a vertex on it or a constraint across it; neither if
  // the way is free.
  struct Obstacle {
    Vertex vertex;
    Face face;
    int index = -1;
  };
  Obstacle first_obstacle(Vertex from, Vertex to) const;
  Vertex cross_constraint(const Obstacle& obstacle, Vertex from, Vertex to, int tag);
  bool stays_valid(const Point& p, Face face, int index) const;
  bool insert(Vertex from, Vertex to, int kind, int tag, int depth);
  void add_edge(Vertex from, Vertex to, int kind, int tag);
};

namespace {

// True if x lies ahead of `from` on the line to `to`; for collinear points only.
bool ahead(const Point& from, const Point& to, const Point& x) {
  return (to.x() - from.x()) * (x.x() - from.x()) + (to.y() - from.y()) * (x.y() - from.y()) > 0;
}

}  // namespace

Arrangement::Implementation::Obstacle Arrangement::Implementation::first_obstacle(Vertex from,
                                                                                  Vertex to) const {
  const Point &a = from->point(), &b = to->point();
  Face face;
  int index = -1;
  auto circulator = cdt.incident_faces(from);
  const auto done = circulator;
  do {
    if (cdt.is_infinite(circulator)) continue;
    const int i = circulator->index(from);
    const Vertex right = circulator->vertex(Triangulation::ccw(i));
    const Vertex left = circulator->vertex(Triangulation::cw(i));
    if (right == to || left == to) return {};
    const auto turn_right = CGAL::orientation(a, b, right->point());
    if (turn_right == CGAL::COLLINEAR && ahead(a, b, right->point())) return {right, {}, -1};
    const auto turn_left = CGAL::orientation(a, b, left->point());
    if (turn_right == CGAL::RIGHT_TURN && turn_left == CGAL::LEFT_TURN) {
      face = circulator;
      index = i;
      break;
    }
  } while (++circulator != done);

  while (index >= 0) {
    if (face->is_constrained(index)) return {{}, face, index};
    const Face next = face->neighbor(index);
    const int back = next->index(face);
    const Vertex apex = next->vertex(back);
    if (apex == to) return {};
    const auto turn = CGAL::orientation(a, b, apex->point());
    if (turn == CGAL::COLLINEAR) return {apex, {}, -1};
    // Seen from `next`, the vertex on the right is cw(back) (it was ccw(index) in `face`).
    index = turn == CGAL::LEFT_TURN ? Triangulation::ccw(back) : Triangulation::cw(back);
    face = next;
  }
  return {};
}

bool Arrangement::Implementation::stays_valid(const Point& p, Face face, int index) const {
  const Face beyond = face->neighbor(index);
  const Point& apex = face->vertex(index)->point();
  const Point& foot = beyond->vertex(beyond->index(face))->point();
  const Point& c = face->vertex(Triangulation::ccw(index))->point();
  const Point& d = face->vertex(Triangulation::cw(index))->point();
  return CGAL::orientation(apex, c, p) == CGAL::LEFT_TURN &&
         CGAL::orientation(c, foot, p) == CGAL::LEFT_TURN &&
         CGAL::orientation(foot, d, p) == CGAL::LEFT_TURN && CGAL::orientation(d, apex, p) == CGAL::LEFT_TURN;
}

Vertex Arrangement::Implementation::cross_constraint(const Obstacle& obstacle, Vertex from, Vertex to,
                                                     int tag) {
  const Vertex c = obstacle.face->vertex(Triangulation::ccw(obstacle.index));
  const Vertex d = obstacle.face->vertex(Triangulation::cw(obstacle.index));
  const Point p = meeting_point(from->point(), to->point(), c->point(), d->point());
  if (!stays_valid(p, obstacle.face, obstacle.index))
    return CGAL::has_smaller_distance_to_point(p, c->point(), d->point()) ? c : d;
  const int edge = graph.find_edge(node_of(c), node_of(d));
  const Vertex v = new_node(cdt.insert(p, Triangulation::EDGE, obstacle.face, obstacle.index));
  crossings.push_back({node_of(v), {graph.edge(edge).tag, tag}});
  graph.split_edge(edge, node_of(v));
  return v;
}

void Arrangement::Implementation::add_edge(Vertex from, Vertex to, int kind, int tag) {
  const int a = node_of(from), b = node_of(to);
  const int edge = graph.find_edge(a, b);
  if (edge < 0)
    graph.add_edge(a, b, kind, tag);
  else if (graph.edge(edge).kind < kind)
    graph.set_kind(edge, kind, tag);
}

bool Arrangement::Implementation::insert(Vertex from, Vertex to, int kind, int tag, int depth) {
  // A segment that keeps being deflected by rounding gives up: far more levels than any real one needs.
  constexpr int max_depth = 400;
  while (from != to) {
    if (depth++ > max_depth) return false;
    const Obstacle obstacle = first_obstacle(from, to);
    Vertex stop = to;
    if (obstacle.vertex != Vertex()) stop = obstacle.vertex;
    if (obstacle.index >= 0) {
      stop = cross_constraint(obstacle, from, to, tag);
      // Rounding moved the crossing: whether the way to it is free must be asked again.
      if (stop != to && !insert(from, stop, kind, tag, depth)) return false;
    } else {
      cdt.insert_constraint(from, stop);
      add_edge(from, stop, kind, tag);
    }
    from = stop;
  }
  return true;
}

Arrangement::Arrangement(const Vec2d& low, const Vec2d& high)
    : implementation_(std::make_unique<Implementation>()) {
  const Vec2d margin = (high - low) * 0.5 + Vec2d(1, 1) * ((high - low).norm() * 0.1);
  for (int i = 0; i < 4; ++i) {
    const double u = i % 2 ? high[0] + margin[0] : low[0] - margin[0];
    const double v = i / 2 ? high[1] + margin[1] : low[1] - margin[1];
    implementation_->cdt.insert(Point(u, v))->info() = -1 - i;
  }
  implementation_->last = implementation_->cdt.finite_vertices_begin();
}

Arrangement::~Arrangement() = default;

int Arrangement::insert_point(const Vec2d& uv) {
  Implementation& self = *implementation_;
  const Point p(uv[0], uv[1]);
  Triangulation::Locate_type type;
  int index = 0;
  const Face face = self.cdt.locate(p, type, index, self.last->face());
  if (type == Triangulation::VERTEX) {
    self.last = face->vertex(index);
    return self.node_of(self.last);
  }
  int edge = -1;
  if (type == Triangulation::EDGE && face->is_constrained(index))
    edge = self.graph.find_edge(self.node_of(face->vertex(Triangulation::ccw(index))),
                                self.node_of(face->vertex(Triangulation::cw(index))));
  const Vertex v = self.new_node(self.cdt.insert(p, type, face, index));
  if (edge >= 0) self.graph.split_edge(edge, self.node_of(v));
  return self.node_of(v);
}

bool Arrangement::insert_segment(int a, int b, int kind, int tag) {
  Implementation& self = *implementation_;
  return self.insert(self.vertices[static_cast<size_t>(a)], self.vertices[static_cast<size_t>(b)], kind, tag,
                     0);
}

const PlanarGraph& Arrangement::graph() const { return implementation_->graph; }
Vec2d Arrangement::box_corner(int node) const {
  // The box was made first, so its corners are the first vertices.
  for (const Vertex v : implementation_->cdt.finite_vertex_handles())
    if (v->info() == node) return to_vec(v->point());
  return {0, 0};
}

const std::vector<Arrangement::Crossing>& Arrangement::crossings() const {
  return implementation_->crossings;
}

std::vector<Arrangement::Triangle> Arrangement::triangles() const {
  const Implementation& self = *implementation_;
  std::vector<Triangle> result;
  CGAL::Unique_hash_map<Face, int> index_of(-1, self.cdt.number_of_faces());
  for (const Face f : self.cdt.finite_face_handles()) {
    index_of[f] = static_cast<int>(result.size());
    result.emplace_back();
  }
  size_t i = 0;
  for (const Face f : self.cdt.finite_face_handles()) {
    Triangle& t = result[i++];
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<size_t>(k);
      t.node[at] = self.node_of(f->vertex(k));
      t.neighbor[at] = self.cdt.is_infinite(f->neighbor(k)) ? -1 : index_of[f->neighbor(k)];
    }
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<size_t>(k);
      t.edge[at] =
          f->is_constrained(k) ? self.graph.find_edge(t.node[(at + 1) % 3], t.node[(at + 2) % 3]) : -1;
    }
  }
  return result;
}

}  // namespace anisomesh::detail
