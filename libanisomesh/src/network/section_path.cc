#include "network/section_path.hh"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

constexpr double on_element = 1e-6;  // a barycentric coordinate below it is zero
constexpr double least_t = 1e-6;     // a crossing keeps this far from both ends of its edge
constexpr size_t most_faces = 4000;  // that a search for a way looks at

Vec3d position_of(const SurfaceArrays& mesh, const Place& place) {
  Vec3d p(0, 0, 0);
  for (int k = 0; k < 3; ++k) p += place.barycentric[k] * mesh.corner_point(place.face, k);
  return p;
}

Vec3d normal_of(const SurfaceArrays& mesh, int face) {
  const Vec3d& a = mesh.corner_point(face, 0);
  const Vec3d n = cross(mesh.corner_point(face, 1) - a, mesh.corner_point(face, 2) - a);
  const double length = n.norm();
  return length > 0 ? n / length : n;
}

EdgeCrossing crossing_of(int a, int b, double t) {
  t = std::clamp(t, least_t, 1 - least_t);
  return a < b ? EdgeCrossing{{a, b}, t} : EdgeCrossing{{b, a}, 1 - t};
}

class Walker {
 public:
  Walker(const SurfaceArrays& mesh, const Place& from, const Place& to)
      : mesh_(mesh), from_(from), goals_(faces_at(mesh, to)), p_(position_of(mesh, from)) {
    const Vec3d ahead = position_of(mesh, to) - p_;
    length_ = ahead.norm();
    direction_ = length_ > 0 ? ahead / length_ : ahead;
    across_ = cross(normal_of(mesh, from.face) + normal_of(mesh, to.face), direction_);
  }

  SectionPath straight() const;
  SectionPath fewest() const;

 private:
  struct Exit {
    int face = -1, side = -1;
    double t = 0, ahead = 0;
  };
  bool is_goal(int face) const { return std::find(goals_.begin(), goals_.end(), face) != goals_.end(); }
  const Vec3d& corner(int face, int k) const { return mesh_.corner_point(face, k % 3); }
  double side_of(int face, int k) const { return across_ | (corner(face, k) - p_); }
  Exit exit_of(int face, int entered) const;
  void append(SectionPath& path, int face, int side, double t) const {
    const auto& c = mesh_.corners[at(face)];
    path.crossings.push_back(crossing_of(c[at(side)], c[at((side + 1) % 3)], t));
    path.faces.push_back(mesh_.neighbours[at(face)][at(side)]);
  }

  const SurfaceArrays& mesh_;
  const Place& from_;
  std::vector<int> goals_;
  Vec3d p_, direction_, across_;
  double length_ = 0;
};

// Where the plane leaves a face, farthest ahead; not by the side it was entered by or one that holds the
// start.
Walker::Exit Walker::exit_of(int face, int entered) const {
  Exit best;
  best.ahead = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const auto &a = mesh_.corners[at(face)][at(k)], &b = mesh_.corners[at(face)][at((k + 1) % 3)];
    if (k == entered) continue;
    if (entered < 0) {
      if (from_.vertex == a || from_.vertex == b) continue;
      if (from_.on_edge() && std::min(a, b) == from_.edge.vertex[0] && std::max(a, b) == from_.edge.vertex[1])
        continue;
    }
    const double s = side_of(face, k), t = side_of(face, k + 1);
    if ((s < 0) == (t < 0)) continue;
    const double share = s / (s - t);
    const Vec3d x = corner(face, k) + share * (corner(face, k + 1) - corner(face, k));
    const double ahead = (x - p_) | direction_;
    if (ahead > best.ahead) best = {face, k, share, ahead};
  }
  return best;
}

SectionPath Walker::straight() const {
  SectionPath path;
  Exit exit;
  exit.ahead = 0;
  for (const int face : faces_at(mesh_, from_)) {
    const Exit e = exit_of(face, -1);
    if (e.face >= 0 && e.ahead > exit.ahead) exit = e;
  }
  if (exit.face < 0) return path;
  path.faces.push_back(exit.face);
  for (size_t step = 0; step < most_faces && exit.face >= 0; ++step) {
    const int next = mesh_.neighbours[at(exit.face)][at(exit.side)];
    if (next < 0 || std::abs(exit.ahead) > 1.5 * length_) return {};
    append(path, exit.face, exit.side, exit.t);
    if (is_goal(next)) {
      path.found = true;
      return path;
    }
    int entered = 0;
    while (mesh_.neighbours[at(next)][at(entered)] != exit.face) ++entered;
    exit = exit_of(next, entered);
  }
  return {};
}

// Breadth first over the faces; each edge is crossed where it is nearest to the straight line.
SectionPath Walker::fewest() const {
  std::unordered_map<int, std::array<int, 2>> reached;  // face -> the one before it and the side of that
  std::vector<int> queue;
  for (const int face : faces_at(mesh_, from_))
    if (reached.emplace(face, std::array<int, 2>{-1, -1}).second) queue.push_back(face);
  int goal = -1;
  for (size_t i = 0; i < queue.size() && goal < 0 && queue.size() < most_faces; ++i) {
    if (is_goal(queue[i])) goal = queue[i];
    for (int k = 0; k < 3; ++k) {
      const int next = mesh_.neighbours[at(queue[i])][at(k)];
      if (next >= 0 && reached.emplace(next, std::array<int, 2>{queue[i], k}).second) queue.push_back(next);
    }
  }
  SectionPath path;
  if (goal < 0) return path;
  std::vector<std::array<int, 2>> steps;
  for (auto step = reached.at(goal); step[0] >= 0; step = reached.at(step[0])) steps.push_back(step);
  std::reverse(steps.begin(), steps.end());
  path.faces.push_back(steps.empty() ? goal : steps.front()[0]);
  for (const auto& [face, side] : steps) {
    const Vec3d a = corner(face, side), along = corner(face, side + 1) - a;
    const Vec3d flat = along - (along | direction_) * direction_, start = a - p_;
    const double t = flat.sqrnorm() > 0 ? -(start | flat) / flat.sqrnorm() : 0.5;
    append(path, face, side, std::clamp(t, 0.05, 0.95));
  }
  path.found = true;
  return path;
}

}  // namespace

Place place_of(const SurfaceArrays& mesh, const SurfacePoint& point) {
  Place place;
  place.face = point.face.idx();
  place.barycentric = point.barycentric;
  const auto& c = mesh.corners[at(place.face)];
  for (int k = 0; k < 3; ++k)
    if (point.barycentric[k] > 1 - 2 * on_element) {
      place.vertex = c[at(k)];
      return place;
    }
  for (int k = 0; k < 3; ++k)
    if (point.barycentric[k] < on_element) {
      const int a = (k + 1) % 3, b = (k + 2) % 3;
      const double t = point.barycentric[b] / (point.barycentric[a] + point.barycentric[b]);
      place.edge = crossing_of(c[at(a)], c[at(b)], t);
      return place;
    }
  return place;
}

std::vector<int> faces_at(const SurfaceArrays& mesh, const Place& place) {
  if (place.vertex >= 0) {
    const int* star = mesh.star_of(place.vertex);
    return {star, star + mesh.star_size(place.vertex)};
  }
  std::vector<int> faces{place.face};
  if (place.on_edge()) {
    const int a = place.edge.vertex[0], b = place.edge.vertex[1];
    for (int i = 0; i < mesh.star_size(a); ++i) {
      const int f = mesh.star_of(a)[i];
      const auto& c = mesh.corners[at(f)];
      if (f != place.face && std::find(c.begin(), c.end(), b) != c.end()) faces.push_back(f);
    }
  }
  return faces;
}

int common_face(const SurfaceArrays& mesh, const Place& a, const Place& b) {
  const auto of_a = faces_at(mesh, a), of_b = faces_at(mesh, b);
  for (const int f : of_a)
    if (std::find(of_b.begin(), of_b.end(), f) != of_b.end()) return f;
  return -1;
}

SectionPath section_path(const SurfaceArrays& mesh, const Place& from, const Place& to) {
  const Walker walker(mesh, from, to);
  SectionPath path = walker.straight();
  return path.found ? path : walker.fewest();
}

}  // namespace anisomesh::detail
