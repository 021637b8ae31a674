#include "network/line_places.hh"

#include <algorithm>
#include <limits>

namespace anisomesh::detail {

namespace {

constexpr double straight = 0.02;  // off the chord, of the shortest step along it
constexpr size_t longest = 4;      // steps that one takes the place of: cells want nodes along a line, too
constexpr size_t enough = 20;      // nodes of a line in one triangle, however many its steps are

bool is_inside(const Place& place) { return place.vertex < 0 && !place.on_edge(); }

/// How many steps may become one, of those that a line makes in each triangle.
std::vector<size_t> longest_steps(const std::vector<Place>& places) {
  std::vector<size_t> result(places.size(), longest);
  for (size_t begin = 0, end = 0; begin < places.size(); begin = end) {
    while (end < places.size() && places[end].face == places[begin].face) ++end;
    std::fill(result.begin() + static_cast<std::ptrdiff_t>(begin),
              result.begin() + static_cast<std::ptrdiff_t>(end), std::max(longest, (end - begin) / enough));
  }
  return result;
}

/// Whether the points between two of them are on the segment that joins the two.
bool is_straight(const std::vector<Vec3d>& points, size_t begin, size_t end) {
  const Vec3d &a = points[begin], along = points[end] - a;
  const double squared = along.sqrnorm();
  double shortest = std::numeric_limits<double>::infinity(), farthest = 0;
  for (size_t i = begin; i < end; ++i) shortest = std::min(shortest, (points[i + 1] - points[i]).sqrnorm());
  for (size_t i = begin + 1; i < end; ++i) {
    const Vec3d from_a = points[i] - a;
    const double t = squared > 0 ? std::clamp((from_a | along) / squared, 0.0, 1.0) : 0.0;
    farthest = std::max(farthest, (from_a - t * along).sqrnorm());
  }
  return farthest <= straight * straight * shortest;
}

}  // namespace

std::vector<Place> places_of(const SurfaceArrays& mesh, const SurfaceRef& surface, const Line& line,
                             std::vector<int>& left_out) {
  std::vector<Place> all, kept;
  std::vector<Vec3d> points;
  all.reserve(line.points.size());
  for (const SurfacePoint& point : line.points) {
    all.push_back(place_of(mesh, point));
    points.push_back(position(surface, point));
  }
  const std::vector<size_t> longest_at = longest_steps(all);
  for (size_t i = 0; i < all.size();) {
    kept.push_back(all[i]);
    size_t next = i + 1;
    while (is_inside(all[i]) && next + 1 < all.size() && next - i < longest_at[i] &&
           is_inside(all[next + 1]) && all[next + 1].face == all[i].face && is_straight(points, i, next + 1))
      left_out.push_back(all[next++].face);
    i = next;
  }
  return kept;
}

}  // namespace anisomesh::detail
