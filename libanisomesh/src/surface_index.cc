#include "surface_index.hh"

#include <algorithm>
#include <cmath>

namespace anisomesh::detail {

namespace {

// The point of a segment nearest to p, as a parameter in [0, 1].
double nearest_parameter(const Vec2d& p, const Vec2d& a, const Vec2d& b) {
  const Vec2d ab = b - a;
  const double length2 = ab.sqrnorm();
  return length2 > 0 ? std::clamp(((p - a) | ab) / length2, 0.0, 1.0) : 0.0;
}

Vec2d unit(const Vec2d& v) {
  const double length = v.norm();
  return length > 0 ? Vec2d(v / length) : Vec2d(1, 0);
}

}  // namespace

void SurfaceIndex::add(int face, const Piece& piece) {
  int& first = first_[static_cast<size_t>(face)];
  pieces_.push_back(piece);
  pieces_.back().next = first;
  first = static_cast<int>(pieces_.size()) - 1;
}

Neighbourhood SurfaceIndex::nearest(const SurfacePoint& at, double bound, int own, double from, double to) {
  Neighbourhood best;
  double line2 = bound * bound, fence2 = bound * bound;
  const auto record = [](Neighbour& neighbour, const SurfaceFlood::Visit& visit, const Vec2d& place,
                         const Vec2d& along, double distance2) {
    neighbour.distance = std::sqrt(distance2);
    neighbour.offset = turned_back(place - visit.place, visit.turn);
    neighbour.direction = turned_back(unit(along), visit.turn);
  };
  flood_.run(at, line2, [&](const SurfaceFlood::Visit& visit) {
    for (int i = first_[static_cast<size_t>(visit.face)]; i >= 0;) {
      const Piece& piece = pieces_[static_cast<size_t>(i)];
      i = piece.next;
      const double t = nearest_parameter(visit.place, piece.from, piece.to);
      const Vec2d place = piece.from + t * (piece.to - piece.from);
      const double distance2 = (place - visit.place).sqrnorm();
      if (!(distance2 < line2)) continue;
      const double arc = (1 - t) * piece.arc_from + t * piece.arc_to;
      if (piece.line == own && own >= 0 && arc >= from && arc <= to) continue;
      line2 = distance2;
      const Vec2d along = piece.to - piece.from;
      record(best.line, visit, place, piece.arc_to >= piece.arc_from ? along : -along, distance2);
      best.line.line = piece.line;
      best.line.arc = arc;
    }
    for (int i = 0; i < 3; ++i) {
      if (faces_.across(visit.face, i) >= 0) continue;
      double t = 0;
      const double distance2 = faces_.edge_distance2(visit.face, i, visit.place, t);
      if (!(distance2 < fence2)) continue;
      fence2 = distance2;
      const Vec2d a = faces_.corner(visit.face, (i + 1) % 3), b = faces_.corner(visit.face, (i + 2) % 3);
      record(best.fence, visit, a + t * (b - a), b - a, distance2);
    }
    return pieces_.empty() ? fence2 : line2;
  });
  // Fences are searched only as far as the nearest line: which of those beyond it were met is chance.
  if (fence2 >= line2) best.fence = {};
  return best;
}

void SurfaceIndex::enter(int line, const std::vector<ArcPoint>& points) {
  for (size_t i = 1; i < points.size(); ++i) {
    const auto& way = paths_.find(points[i - 1].point, points[i].point);
    double length = 0, gone = 0;
    for (const PathPiece& piece : way) length += (piece.to - piece.from).norm();
    const double span = points[i].arc - points[i - 1].arc;
    for (const PathPiece& piece : way) {
      const double before = length > 0 ? gone / length : 0;
      gone += (piece.to - piece.from).norm();
      const double after = length > 0 ? gone / length : 1;
      add(piece.face, {piece.from, piece.to, points[i - 1].arc + before * span,
                       points[i - 1].arc + after * span, line, -1});
    }
  }
}

void SurfaceIndex::enter_sample(int id, const SurfacePoint& point) {
  const Vec2d place = faces_.place(point);
  add(point.face.idx(), {place, place, 0, 0, id, -1});
}

}  // namespace anisomesh::detail
