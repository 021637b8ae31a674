#include "surface/surface_path.hh"

#include <algorithm>
#include <cmath>

namespace anisomesh::detail {

namespace {

constexpr double kDetour = 6;      // times the distance in space that a way may be long
constexpr double kArrived = 1e-6;  // of the length: the straight way ends where it should

}  // namespace

// The triangles from one point to the other, in order.
bool SurfacePaths::reach(const SurfacePoint& from, const SurfacePoint& to) {
  const double chord = (position(surface_, to) - position(surface_, from)).norm();
  // Within one edge length even a point at no distance may lie across a crease.
  double bound = kDetour * chord;
  for (int i = 0; i < 3; ++i)
    bound = std::max(
        bound, (faces_.corner(from.face.idx(), i) - faces_.corner(from.face.idx(), (i + 1) % 3)).norm());
  int found = -1;
  flood_.run(from, bound, [&](const SurfaceFlood::Visit& visit) {
    if (found < 0 && visit.face == to.face.idx()) found = static_cast<int>(flood_.visits().size()) - 1;
    return found < 0 ? bound : 0.0;
  });
  if (found < 0) return false;
  strip_.clear();
  for (int i = found; i >= 0; i = flood_.visits()[static_cast<size_t>(i)].parent)
    strip_.push_back(flood_.visits()[static_cast<size_t>(i)]);
  std::reverse(strip_.begin(), strip_.end());
  return true;
}

// Heads for the end at each edge, as far as the edge allows. Whether it was allowed everywhere.
bool SurfacePaths::lay_through_strip(const Vec2d& start, const Vec2d& vector) {
  bool straight = true;
  Vec2d at = start;
  pieces_.clear();
  for (size_t m = 0; m < strip_.size(); ++m) {
    const auto& here = strip_[m];
    const Vec2d end = here.place + turned_by(vector, here.turn);
    if (m + 1 == strip_.size()) {
      pieces_.push_back({here.face, at, end, -1});
      break;
    }
    int exit = 0;
    while (exit < 2 && !(faces_.across(here.face, exit) == strip_[m + 1].face &&
                         faces_.twin(here.face, exit) == strip_[m + 1].entered))
      ++exit;
    const Vec2d a = faces_.corner(here.face, (exit + 1) % 3),
                ab = faces_.corner(here.face, (exit + 2) % 3) - a;
    const Vec2d ahead = end - at;
    // The edge runs counter-clockwise: what leaves by it turns to its right.
    const double leaving = cross2(ahead, ab);
    double s = leaving > 0 ? cross2(ahead, at - a) / leaving : ((end - a) | ab) / ab.sqrnorm();
    if (!(leaving > 0) || s < -1e-12 || s > 1 + 1e-12) straight = false;
    s = std::clamp(s, 0.0, 1.0);
    const Vec2d crossing = a + s * ab;
    pieces_.push_back({here.face, at, crossing, exit});
    at = faces_.carried(here.face, exit, crossing);
  }
  return straight;
}

// The strip may pass a vertex on the wrong side.
bool SurfacePaths::lay_straight(const SurfacePoint& from, const SurfacePoint& to, const Vec2d& vector) {
  tried_.clear();
  const Reach reach =
      walk_straight(faces_, from, vector, [this](const PathPiece& piece) { tried_.push_back(piece); });
  const Vec2d end = faces_.place(to);
  if (reach.blocked || reach.point.face != to.face) return false;
  if (!((tried_.back().to - end).norm() <= kArrived * vector.norm())) return false;
  tried_.back().to = end;
  pieces_.swap(tried_);
  return true;
}

const std::vector<PathPiece>& SurfacePaths::find(const SurfacePoint& from, const SurfacePoint& to) {
  pieces_.clear();
  if (from.face == to.face) {
    pieces_.push_back({from.face.idx(), faces_.place(from), faces_.place(to), -1});
    return pieces_;
  }
  const auto vector = vector_to(from, to);
  if (!vector) return pieces_;
  if (!lay_through_strip(faces_.place(from), *vector)) lay_straight(from, to, *vector);
  return pieces_;
}

std::optional<Vec2d> SurfacePaths::vector_to(const SurfacePoint& from, const SurfacePoint& to) {
  if (!reach(from, to)) return std::nullopt;
  const auto& last = strip_.back();
  return turned_back(faces_.place(to) - last.place, last.turn);
}

}  // namespace anisomesh::detail
