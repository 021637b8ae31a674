#include "lines/surface_index.hh"
#include "numerics/segment.hh"

#include <algorithm>
#include <cmath>

namespace anisomesh::detail {

namespace {

Vec2d unit(const Vec2d& v) {
  const double length = v.norm();
  return length > 0 ? Vec2d(v / length) : Vec2d(1, 0);
}

// The nearest of pieces. Of two that meet in the nearest point it is the one whose middle is nearer, so that
// rounding has no say in the direction.
class Nearest {
 public:
  explicit Nearest(double bound) : distance_(bound) {}
  bool gives_way(double distance, const Vec2d& to_middle) const {
    if (std::abs(distance - distance_) <= kSame * distance_) return to_middle.sqrnorm() < middle2_;
    return distance < distance_;
  }
  void take(double distance, const Vec2d& to_middle) {
    distance_ = distance;
    middle2_ = to_middle.sqrnorm();
  }
  double distance() const { return distance_; }

 private:
  static constexpr double kSame = 1e-9;
  double distance_, middle2_ = std::numeric_limits<double>::infinity();
};

void record(Neighbour& neighbour, const SurfaceFlood::Visit& visit, const Vec2d& place, const Vec2d& along,
            double distance) {
  neighbour.distance = distance;
  neighbour.offset = turned_back(place - visit.place, visit.turn);
  neighbour.direction = turned_back(unit(along), visit.turn);
}

}  // namespace

void SurfaceIndex::add(int face, const Piece& piece, double reach) {
  int& first = first_[static_cast<size_t>(face)];
  pieces_.push_back(piece);
  pieces_.back().next = first;
  first = static_cast<int>(pieces_.size()) - 1;
  pending_.push_back({face, 0.5 * (piece.from + piece.to), 0.5 * (piece.to - piece.from).norm(), reach});
}

void SurfaceIndex::spread_pending() {
  if (!pending_.empty()) distance_.add(pending_);
  pending_.clear();
  pending_points_.clear();
  pending_line_ = -1;
}

// Whether a piece that is not spread yet, and is not to be left out, may be that near.
bool SurfaceIndex::pending_near(const SurfacePoint& at, double bound, double from, double to) const {
  if (pending_points_.empty()) return false;
  const Vec3d here = position(surface_, at);
  for (const Pending& p : pending_points_)
    if ((p.arc < from || p.arc > to) && (p.position - here).norm() < bound + p.length) return true;
  return false;
}

template <class Beyond>
double SurfaceIndex::nearest_line(const SurfacePoint& at, double bound, int own, double from, double to,
                                  Neighbour& best, const Beyond& beyond) {
  Nearest nearest{bound};
  flood_.search(
      at, bound,
      [&](const SurfaceFlood::Visit& visit) {
        for (int i = first_[static_cast<size_t>(visit.face)]; i >= 0;) {
          const Piece& piece = pieces_[static_cast<size_t>(i)];
          i = piece.next;
          const double t = nearest_parameter(visit.place, piece.from, piece.to);
          const Vec2d place = piece.from + t * (piece.to - piece.from);
          const double distance = (place - visit.place).norm();
          if (!nearest.gives_way(distance, 0.5 * (piece.from + piece.to) - visit.place)) continue;
          const double arc = (1 - t) * piece.arc_from + t * piece.arc_to;
          if (piece.line == own && own >= 0 && arc >= from && arc <= to) continue;
          nearest.take(distance, 0.5 * (piece.from + piece.to) - visit.place);
          const Vec2d along = piece.to - piece.from;
          record(best, visit, place, piece.arc_to >= piece.arc_from ? along : -along, distance);
          best.line = piece.line;
          best.arc = arc;
        }
        return nearest.distance();
      },
      beyond);
  return nearest.distance();
}

void SurfaceIndex::nearest_fence(const SurfacePoint& at, double bound, Neighbour& best) {
  Nearest nearest{bound};
  flood_.search(
      at, bound,
      [&](const SurfaceFlood::Visit& visit) {
        for (int i = 0; i < 3; ++i) {
          if (faces_.across(visit.face, i) >= 0) continue;
          double t = 0;
          const double distance = std::sqrt(faces_.edge_distance2(visit.face, i, visit.place, t));
          const Vec2d a = faces_.corner(visit.face, (i + 1) % 3), b = faces_.corner(visit.face, (i + 2) % 3);
          if (!nearest.gives_way(distance, 0.5 * (a + b) - visit.place)) continue;
          nearest.take(distance, 0.5 * (a + b) - visit.place);
          record(best, visit, a + t * (b - a), b - a, distance);
        }
        return nearest.distance();
      },
      *fences_, true);
}

Neighbourhood SurfaceIndex::nearest(const SurfacePoint& at, double bound, int own, double from, double to) {
  if (own < 0 || own != pending_line_) spread_pending();
  Neighbourhood best;
  const double line = pending_near(at, bound, from, to)
                          ? nearest_line(at, bound, own, from, to, best.line, [](int) { return 0.0; })
                          : nearest_line(at, bound, own, from, to, best.line, distance_);
  // Fences are searched only as far as the nearest line.
  if (fences_) nearest_fence(at, line, best.fence);
  return best;
}

void SurfaceIndex::enter(int line, const std::vector<ArcPoint>& points) {
  constexpr double kSpreadEvery = 1;  // of arc: spacings
  if (points.empty()) return;
  if (line != pending_line_) {
    spread_pending();
    pending_line_ = line;
    pending_arc_ = points.front().arc;
  }
  for (size_t i = 1; i < points.size(); ++i) {
    const auto& way = paths_.find(points[i - 1].point, points[i].point);
    double length = 0, gone = 0;
    for (const PathPiece& piece : way) length += (piece.to - piece.from).norm();
    for (const ArcPoint& end : {points[i - 1], points[i]})
      pending_points_.push_back({position(surface_, end.point), end.arc, length});
    const double span = points[i].arc - points[i - 1].arc, reach = reach_(points[i].point);
    for (const PathPiece& piece : way) {
      const double before = length > 0 ? gone / length : 0;
      gone += (piece.to - piece.from).norm();
      const double after = length > 0 ? gone / length : 1;
      add(piece.face,
          {piece.from, piece.to, points[i - 1].arc + before * span, points[i - 1].arc + after * span, line,
           -1},
          reach);
    }
  }
  // Not with each step: the ground ahead of the line is gone over again each time.
  if (std::abs(points.back().arc - pending_arc_) > kSpreadEvery) {
    spread_pending();
    pending_line_ = line;
    pending_arc_ = points.back().arc;
  }
}

void SurfaceIndex::enter_sample(int id, const SurfacePoint& point) {
  const Vec2d place = faces_.place(point);
  add(point.face.idx(), {place, place, 0, 0, id, -1}, reach_(point));
}

}  // namespace anisomesh::detail
