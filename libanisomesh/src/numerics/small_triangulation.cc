#include "numerics/small_triangulation.hh"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace anisomesh::detail {

using OpenMesh::Vec2d;

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

double turn_of(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// Four corners of a flip must turn left by more than this, relative to the lengths of the sides.
constexpr double convex_turn = 1e-9;
// A flip must widen the smaller angle by more than rounding, or two flips could undo each other for ever.
constexpr double delaunay_gain = 1e-9;

double cosine(const Vec2d& apex, const Vec2d& a, const Vec2d& b) {
  return ((a - apex) | (b - apex)) / ((a - apex).norm() * (b - apex).norm());
}

}  // namespace

SmallTriangulation::SmallTriangulation(const std::vector<Vec2d>& points,
                                       std::vector<std::array<int, 3>> triangles,
                                       const std::vector<std::array<int, 2>>& walls)
    : points_(&points), triangles_(std::move(triangles)), neighbors_(triangles_.size(), {-1, -1, -1}) {
  struct Side {
    int low, high, triangle;
    size_t k;
  };
  std::vector<Side> sides;
  sides.reserve(3 * triangles_.size());
  for (size_t t = 0; t < triangles_.size(); ++t)
    for (size_t k = 0; k < 3; ++k) {
      const int a = triangles_[t][(k + 1) % 3], b = triangles_[t][(k + 2) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<int>(t), k});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
    if (x.low != y.low) return x.low < y.low;
    return x.high != y.high ? x.high < y.high : x.triangle < y.triangle;
  });
  for (size_t i = 0; i + 1 < sides.size(); ++i) {
    const Side &x = sides[i], &y = sides[i + 1];
    if (x.low != y.low || x.high != y.high) continue;
    const bool wall = std::any_of(walls.begin(), walls.end(), [&](const std::array<int, 2>& w) {
      return std::min(w[0], w[1]) == x.low && std::max(w[0], w[1]) == x.high;
    });
    if (wall) continue;
    neighbors_[at(x.triangle)][x.k] = y.triangle;
    neighbors_[at(y.triangle)][y.k] = x.triangle;
  }
}

double SmallTriangulation::turn(int a, int b, int c) const { return turn_of(point(a), point(b), point(c)); }

size_t SmallTriangulation::index_of_neighbor(int t, int neighbor) const {
  const auto& n = neighbors_[at(t)];
  return n[0] == neighbor ? 0 : n[1] == neighbor ? 1 : 2;
}

void SmallTriangulation::replace_neighbor(int t, int old_one, int new_one) {
  if (t >= 0) neighbors_[at(t)][index_of_neighbor(t, old_one)] = new_one;
}

int SmallTriangulation::across(int t, size_t k) const {
  const int next = neighbors_[at(t)][k];
  return triangles_[at(next)][index_of_neighbor(next, t)];
}

int SmallTriangulation::locate(const Vec2d& p) const {
  int t = std::min(last_, static_cast<int>(triangles_.size()) - 1);
  for (size_t step = 0; step <= 2 * triangles_.size(); ++step) {
    const auto& corner = triangles_[at(t)];
    int next = -1;
    bool inside = true;
    for (size_t i = 0; i < 3 && next < 0; ++i) {
      const size_t k = (i + step) % 3;  // not always the same side first, or the walk may circle
      if (turn_of(point(corner[(k + 1) % 3]), point(corner[(k + 2) % 3]), p) >= 0) continue;
      inside = false;
      if (neighbors_[at(t)][k] >= 0) next = neighbors_[at(t)][k];
    }
    if (inside) return last_ = t;
    if (next < 0) break;
    t = next;
  }
  // The region need not be convex: the walk may meet its border on the way.
  double best = -std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < triangles_.size() && best < 0; ++i) {
    const Vec2d &a = point(triangles_[i][0]), &b = point(triangles_[i][1]), &c = point(triangles_[i][2]);
    const double lowest =
        std::min({turn_of(a, b, p), turn_of(b, c, p), turn_of(c, a, p)}) / std::abs(turn_of(a, b, c));
    if (lowest <= best) continue;
    best = lowest;
    last_ = static_cast<int>(i);
  }
  return last_;
}

bool SmallTriangulation::can_flip(int t, size_t k) const {
  if (neighbors_[at(t)][k] < 0) return false;
  const auto& corner = triangles_[at(t)];
  const int apex = corner[k], a = corner[(k + 1) % 3], b = corner[(k + 2) % 3], foot = across(t, k);
  const auto strict = [&](int x, int y, int z) {
    return turn(x, y, z) > convex_turn * (point(y) - point(x)).norm() * (point(z) - point(x)).norm();
  };
  if (!strict(apex, a, foot) || !strict(foot, b, apex)) return false;
  // An inner corner of three triangles would keep two on each other; only where the drawing is not without
  // folds does it look as if it could.
  const int other = neighbors_[at(t)][k];
  const size_t m = index_of_neighbor(other, t);
  const auto& n = neighbors_[at(other)];
  for (const auto& [mine, its] : {std::pair{(k + 1) % 3, (m + 2) % 3}, std::pair{(k + 2) % 3, (m + 1) % 3}})
    if (neighbors_[at(t)][mine] >= 0 && neighbors_[at(t)][mine] == n[its]) return false;
  return true;
}

void SmallTriangulation::flip(int t, size_t k) {
  const int other = neighbors_[at(t)][k];
  const size_t m = index_of_neighbor(other, t);
  const int apex = triangles_[at(t)][k], a = triangles_[at(t)][(k + 1) % 3],
            b = triangles_[at(t)][(k + 2) % 3];
  const int foot = triangles_[at(other)][m];
  const int beyond_b = neighbors_[at(t)][(k + 1) % 3], beyond_a = neighbors_[at(t)][(k + 2) % 3];
  // In `other` the corners run foot, b, a.
  const int foot_a = neighbors_[at(other)][(m + 1) % 3], foot_b = neighbors_[at(other)][(m + 2) % 3];
  triangles_[at(t)] = {apex, a, foot};
  neighbors_[at(t)] = {foot_a, other, beyond_a};
  triangles_[at(other)] = {apex, foot, b};
  neighbors_[at(other)] = {foot_b, beyond_b, t};
  replace_neighbor(foot_a, other, t);
  replace_neighbor(beyond_b, t, other);
}

bool SmallTriangulation::insert(int corner) {
  const int t = locate(point(corner));
  const std::array<int, 3> c = triangles_[at(t)], n = neighbors_[at(t)];
  int edges = 0;
  for (size_t k = 0; k < 3; ++k) {
    const double side = turn(c[(k + 1) % 3], c[(k + 2) % 3], corner);
    const bool on_edge = side <= 1e-12 * turn(c[0], c[1], c[2]);
    if (on_edge && (side < 0 || n[k] < 0)) return false;
    edges += on_edge;
  }
  if (edges > 1) return false;  // on a corner
  const int second = static_cast<int>(triangles_.size()), third = second + 1;
  triangles_[at(t)] = {corner, c[1], c[2]};
  neighbors_[at(t)] = {n[0], second, third};
  triangles_.push_back({c[0], corner, c[2]});
  neighbors_.push_back({t, n[1], third});
  triangles_.push_back({c[0], c[1], corner});
  neighbors_.push_back({t, second, n[2]});
  replace_neighbor(n[1], t, second);
  replace_neighbor(n[2], t, third);
  legalize(corner);
  return true;
}

// Flips edges opposite the new corner until none of them has a point in the circle of its triangle (Lawson).
void SmallTriangulation::legalize(int corner) {
  const int n = static_cast<int>(triangles_.size());
  std::vector<int> stack;
  // After an insertion the new corner is in the last two triangles and the one they came from.
  for (int t = n - 2; t < n; ++t) stack.push_back(t);
  stack.push_back(neighbors_[at(n - 1)][0]);
  for (size_t guard = 0; !stack.empty() && guard < 20 * triangles_.size() + 100; ++guard) {
    const int t = stack.back();
    stack.pop_back();
    size_t k = 0;
    while (k < 3 && triangles_[at(t)][k] != corner) ++k;
    if (k == 3 || neighbors_[at(t)][k] < 0) continue;
    const Vec2d &apex = point(corner), &a = point(triangles_[at(t)][(k + 1) % 3]),
                &b = point(triangles_[at(t)][(k + 2) % 3]), &foot = point(across(t, k));
    // On an edge the new corner has made a triangle without area; the flip takes it away.
    const bool flat = turn_of(apex, a, b) <= 1e-12 * (a - b).sqrnorm();
    const bool in_circle = cosine(apex, a, b) + cosine(foot, a, b) < -delaunay_gain;
    if ((!flat && !in_circle) || !can_flip(t, k)) continue;
    const int other = neighbors_[at(t)][k];
    flip(t, k);
    stack.push_back(t);
    stack.push_back(other);
  }
}

}  // namespace anisomesh::detail
