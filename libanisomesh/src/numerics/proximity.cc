#include "numerics/proximity.hh"
#include "numerics/segment.hh"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <cmath>

namespace anisomesh::detail {

namespace {

constexpr int kFence = -1;
constexpr int kCrossing = -2;  // a vertex that CGAL made where two constraints cross

struct VertexInfo {
  int line = kCrossing;
  bool isolated = false;
  double arc = 0;
  double scale = 1;
};
struct FaceInfo {
  unsigned visit = 0;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<VertexInfo, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
// Lines of a kind do not cross but for rounding: exact predicates with rounded crossings are enough.
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>;
using VertexHandle = Triangulation::Vertex_handle;
using FaceHandle = Triangulation::Face_handle;
using Point = Triangulation::Point;

Vec2d as_vector(const Point& p) { return {p.x(), p.y()}; }

}  // namespace

struct Proximity::Impl {
  Triangulation triangulation;
  FaceHandle last_face;
  VertexHandle last_vertex;
  unsigned visit = 0;
  bool any_points = false;
  std::vector<FaceHandle> stack;

  VertexHandle insert(const Vec2d& point, int line, double arc, double scale);
  void consider_edge(FaceHandle face, int index, const Vec2d& query, double distance2, double parameter,
                     const Ignore& ignore, PlaneNeighbourhood& best) const;
  void consider_points(FaceHandle face, const Vec2d& point, PlaneNeighbourhood& best) const;
  void visit_face(FaceHandle face, const Vec2d& point, const Ignore& ignore, PlaneNeighbourhood& best);
};

VertexHandle Proximity::Impl::insert(const Vec2d& point, int line, double arc, double scale) {
  const VertexHandle vertex = triangulation.insert(Point(point[0], point[1]), last_face);
  last_face = vertex->face();
  if (vertex->info().line == kCrossing) vertex->info() = {line, false, arc, scale};
  return vertex;
}

void Proximity::Impl::consider_edge(FaceHandle face, int index, const Vec2d& query, double distance2,
                                    double parameter, const Ignore& ignore, PlaneNeighbourhood& best) const {
  const VertexHandle a = face->vertex(Triangulation::ccw(index)), b = face->vertex(Triangulation::cw(index));
  const VertexInfo& from = a->info();
  const VertexInfo& to = b->info();
  const bool fence = from.line == kFence && to.line == kFence;
  const int line = std::max(from.line, to.line);
  // Where a line meets a vertex that is not its own, only its own end knows the arc.
  const bool own_from = from.line == line, own_to = to.line == line;
  const double arc_from = own_from ? from.arc : to.arc, arc_to = own_to ? to.arc : from.arc;
  const double arc = (1 - parameter) * arc_from + parameter * arc_to;
  if (!fence && line == ignore.line && line >= 0 && arc >= ignore.from && arc <= ignore.to) return;
  PlaneNeighbour& neighbour = fence ? best.fence : best.line;
  const Vec2d pa = as_vector(a->point()), pb = as_vector(b->point());
  const double middle2 = (0.5 * (pa + pb) - query).sqrnorm();
  const double nearest2 = neighbour.distance * neighbour.distance;
  const bool same = std::abs(distance2 - nearest2) <= kSameDistance * nearest2;
  if (same ? middle2 >= neighbour.middle2 : distance2 >= nearest2) return;
  neighbour.middle2 = middle2;
  neighbour.distance = std::sqrt(distance2);
  neighbour.point = (1 - parameter) * pa + parameter * pb;
  neighbour.direction = arc_to >= arc_from ? pb - pa : pa - pb;
  const double length = neighbour.direction.norm();
  if (length > 0) neighbour.direction /= length;
  neighbour.line = line;
  neighbour.arc = arc;
  neighbour.scale =
      (1 - parameter) * (own_from ? from.scale : to.scale) + parameter * (own_to ? to.scale : from.scale);
}

void Proximity::Impl::consider_points(FaceHandle face, const Vec2d& point, PlaneNeighbourhood& best) const {
  for (int i = 0; i < 3; ++i) {
    const VertexHandle vertex = face->vertex(i);
    if (!vertex->info().isolated) continue;
    const double distance = (as_vector(vertex->point()) - point).norm();
    if (distance >= best.line.distance) continue;
    best.line = {};
    best.line.distance = distance;
    best.line.point = as_vector(vertex->point());
    best.line.line = vertex->info().line;
    best.line.scale = vertex->info().scale;
  }
}

void Proximity::Impl::visit_face(FaceHandle face, const Vec2d& point, const Ignore& ignore,
                                 PlaneNeighbourhood& best) {
  if (any_points) consider_points(face, point, best);
  for (int i = 0; i < 3; ++i) {
    const bool constrained = face->is_constrained(i);
    const FaceHandle next = face->neighbor(i);
    if (!constrained && next->info().visit == visit) continue;
    const Vec2d a = as_vector(face->vertex(Triangulation::ccw(i))->point());
    const Vec2d b = as_vector(face->vertex(Triangulation::cw(i))->point());
    const double parameter = nearest_parameter(point, a, b);
    const double distance2 = (a + parameter * (b - a) - point).sqrnorm();
    if (distance2 > (1 + kSameDistance) * best.line.distance * best.line.distance) continue;
    if (constrained) {
      consider_edge(face, i, point, distance2, parameter, ignore, best);
      continue;
    }
    if (triangulation.is_infinite(next)) continue;
    next->info().visit = visit;
    stack.push_back(next);
  }
}

Proximity::Proximity() : impl_(std::make_unique<Impl>()) {}
Proximity::~Proximity() = default;

void Proximity::enter_fences(const std::vector<Fence>& fences) {
  for (const Fence& fence : fences) {
    const VertexHandle a = impl_->insert(fence.from, kFence, 0, fence.from_scale);
    const VertexHandle b = impl_->insert(fence.to, kFence, 0, fence.to_scale);
    if (a != b) impl_->triangulation.insert_constraint(a, b);
    impl_->last_face = b->face();
  }
}

void Proximity::enter_line(int line, const std::vector<Vertex>& vertices) {
  VertexHandle last;
  for (const Vertex& vertex : vertices) {
    const VertexHandle next = impl_->insert(vertex.point, line, vertex.arc, vertex.scale);
    if (last != VertexHandle() && last != next) impl_->triangulation.insert_constraint(last, next);
    last = next;
    impl_->last_face = next->face();
  }
}

void Proximity::enter_point(int line, const Vec2d& point, double scale) {
  const VertexHandle vertex = impl_->insert(point, line, 0, scale);
  vertex->info().isolated = true;
  impl_->any_points = true;
}

PlaneNeighbourhood Proximity::nearest(const Vec2d& point, double bound, const Ignore& ignore) {
  PlaneNeighbourhood best;
  best.line.distance = best.fence.distance = bound;
  Impl& impl = *impl_;
  if (impl.triangulation.dimension() == 2) {
    const FaceHandle start = impl.triangulation.locate(Point(point[0], point[1]), impl.last_face);
    impl.last_face = start;
    if (!impl.triangulation.is_infinite(start)) {
      ++impl.visit;
      start->info().visit = impl.visit;
      impl.stack.assign(1, start);
      while (!impl.stack.empty()) {
        const FaceHandle face = impl.stack.back();
        impl.stack.pop_back();
        impl.visit_face(face, point, ignore, best);
      }
    }
  }
  constexpr double kNone = std::numeric_limits<double>::infinity();
  // Fences are searched only as far as the nearest line: which of those beyond it were met is chance.
  if (best.fence.distance >= best.line.distance) best.fence.distance = kNone;
  if (best.line.distance >= bound) best.line.distance = kNone;
  return best;
}

}  // namespace anisomesh::detail
