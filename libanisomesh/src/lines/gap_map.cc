#include "lines/gap_map.hh"

#include <algorithm>
#include <cmath>

namespace anisomesh::detail {

namespace {

double cross(const Vec2d& a, const Vec2d& b) { return a[0] * b[1] - a[1] * b[0]; }

// Where on the way from `a` to `b` the segment from `c` to `d` is crossed, as a fraction; infinite: nowhere.
// Ends count: the next piece of a line begins where this one ends.
double crossing(const Vec2d& a, const Vec2d& b, const Vec2d& c, const Vec2d& d) {
  constexpr double kSlack = 1e-9;
  const Vec2d way = b - a, segment = d - c;
  const double sine = cross(way, segment);
  const double t = cross(c - a, segment) / sine, s = cross(c - a, way) / sine;
  const bool meets = t >= -kSlack && t <= 1 + kSlack && s >= -kSlack && s <= 1 + kSlack;
  return meets ? t : std::numeric_limits<double>::infinity();
}

}  // namespace

void GapMap::enter(int line, const std::vector<TracePoint>& points, size_t first, size_t last) {
  std::vector<int>& faces = faces_of_[line];
  for (size_t i = first + 1; i < last; ++i) {
    // Each half of a line was walked from the seed outward.
    const bool outward = points[i].arc > 0;
    const TracePoint &from = outward ? points[i - 1] : points[i], &to = outward ? points[i] : points[i - 1];
    domain_.walk_while(from.point, to.made, [&](const WayPiece& piece) {
      pieces_[static_cast<size_t>(piece.face)].push_back({piece.from, piece.to, line});
      faces.push_back(piece.face);
      return true;
    });
  }
}

void GapMap::erase(int line) {
  const auto found = faces_of_.find(line);
  if (found == faces_of_.end()) return;
  for (const int face : found->second) {
    auto& pieces = pieces_[static_cast<size_t>(face)];
    pieces.erase(
        std::remove_if(pieces.begin(), pieces.end(), [line](const Piece& p) { return p.line == line; }),
        pieces.end());
  }
  faces_of_.erase(found);
}

double GapMap::along(const SurfacePoint& from, const Vec2d& vector) const {
  double nearest = std::numeric_limits<double>::infinity();
  const Reach reach = domain_.walk_while(from, vector, [&](const WayPiece& way) {
    for (const Piece& piece : pieces_[static_cast<size_t>(way.face)]) {
      const double t = crossing(way.from, way.to, piece.from, piece.to);
      if (!std::isinf(t)) nearest = std::min(nearest, way.begin + t * (way.end - way.begin));
    }
    return std::isinf(nearest);
  });
  return std::isinf(nearest) && reach.blocked ? reach.fraction : std::max(nearest, 0.0);
}

}  // namespace anisomesh::detail
