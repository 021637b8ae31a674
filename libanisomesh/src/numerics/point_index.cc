#include "numerics/point_index.hh"

#include <algorithm>
#include <cmath>

namespace anisomesh::detail {

using OpenMesh::Vec2d;

namespace {

constexpr int leaf_size = 8;
constexpr double rounding = 1e-15;  // relative bound for a 2x2 determinant of differences, with room to spare

size_t at(int i) { return static_cast<size_t>(i); }

// A line through two points; certainly_right says that a point is on its right beyond rounding.
struct HalfPlane {
  Vec2d origin, direction;
  bool certainly_right(const Vec2d& p) const {
    const double left = direction[0] * (p[1] - origin[1]), right = direction[1] * (p[0] - origin[0]);
    return left - right < -rounding * 8 * (std::abs(left) + std::abs(right));
  }
  bool box_is_right(const Vec2d& low, const Vec2d& high) const {
    const Vec2d corner(direction[1] > 0 ? low[0] : high[0], direction[0] > 0 ? high[1] : low[1]);
    return certainly_right(corner);
  }
};

}  // namespace

PointIndex::PointIndex(const std::vector<Vec2d>& points, const std::vector<char>& alive)
    : points_(points), alive_(alive), leaf_(points.size(), -1) {
  for (size_t i = 0; i < points.size(); ++i)
    if (alive[i]) order_.push_back(static_cast<int>(i));
  nodes_.reserve(order_.size() / 2 + 2);
  if (!order_.empty()) build(0, static_cast<int>(order_.size()), -1);
}

int PointIndex::build(int begin, int end, int parent) {
  const int index = static_cast<int>(nodes_.size());
  Node node{points_[at(order_[at(begin)])], points_[at(order_[at(begin)])], begin, end};
  for (int i = begin; i < end; ++i) {
    node.low.minimize(points_[at(order_[at(i)])]);
    node.high.maximize(points_[at(order_[at(i)])]);
  }
  node.parent = parent;
  node.count = end - begin;
  nodes_.push_back(node);
  if (end - begin <= leaf_size) {
    for (int i = begin; i < end; ++i) leaf_[at(order_[at(i)])] = index;
    return index;
  }
  const Vec2d extent = node.high - node.low;
  const size_t axis = extent[0] > extent[1] ? 0 : 1;
  const int middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](int a, int b) {
    const double x = points_[at(a)][axis], y = points_[at(b)][axis];
    return x != y ? x < y : a < b;
  });
  const int left = build(begin, middle, index);
  const int right = build(middle, end, index);
  nodes_[at(index)].left = left;
  nodes_[at(index)].right = right;
  return index;
}

void PointIndex::remove(int point) {
  if (!alive_[at(point)]) return;
  alive_[at(point)] = 0;
  for (int n = leaf_[at(point)]; n >= 0; n = nodes_[at(n)].parent) --nodes_[at(n)].count;
}

bool PointIndex::triangle_is_empty(int a, int b, int c) const {
  if (nodes_.empty()) return true;
  const Vec2d &pa = points_[at(a)], &pb = points_[at(b)], &pc = points_[at(c)];
  const Vec2d ab = pb - pa, ac = pc - pa;
  const bool clockwise = ab[0] * ac[1] - ab[1] * ac[0] < 0;
  const Vec2d &q = clockwise ? pc : pb, &r = clockwise ? pb : pc;
  const std::array<HalfPlane, 3> sides{HalfPlane{pa, q - pa}, HalfPlane{q, r - q}, HalfPlane{r, pa - r}};
  Vec2d low = pa, high = pa;
  low.minimize(pb).minimize(pc);
  high.maximize(pb).maximize(pc);

  std::array<int, 128> stack;
  int size = 0;
  stack[at(size++)] = 0;
  while (size > 0) {
    const Node& node = nodes_[at(stack[at(--size)])];
    if (node.count == 0 || node.low[0] > high[0] || node.low[1] > high[1] || node.high[0] < low[0] ||
        node.high[1] < low[1])
      continue;
    if (std::any_of(sides.begin(), sides.end(),
                    [&](const HalfPlane& side) { return side.box_is_right(node.low, node.high); }))
      continue;
    if (node.left >= 0) {
      stack[at(size++)] = node.left;
      stack[at(size++)] = node.right;
      continue;
    }
    for (int i = node.begin; i < node.end; ++i) {
      const int p = order_[at(i)];
      if (!alive_[at(p)] || p == a || p == b || p == c) continue;
      const Vec2d& x = points_[at(p)];
      if (x[0] < low[0] || x[1] < low[1] || x[0] > high[0] || x[1] > high[1]) continue;
      if (std::none_of(sides.begin(), sides.end(),
                       [&](const HalfPlane& side) { return side.certainly_right(x); }))
        return false;
    }
  }
  return true;
}

}  // namespace anisomesh::detail
