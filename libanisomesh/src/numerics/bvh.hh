// A tree of axis-aligned boxes, and the closest point of a triangle soup on top of it.
#pragma once

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <array>
#include <limits>
#include <utility>
#include <vector>

namespace anisomesh::detail {

using OpenMesh::Vec3d;

struct Box {
  Vec3d low{std::numeric_limits<double>::infinity()};
  Vec3d high{-std::numeric_limits<double>::infinity()};

  void add(const Vec3d& p) {
    low.minimize(p);
    high.maximize(p);
  }
  void add(const Box& other) {
    low.minimize(other.low);
    high.maximize(other.high);
  }
  /// Whether the two have a point in common.
  bool meets(const Box& other) const {
    for (int i = 0; i < 3; ++i)
      if (low[i] > other.high[i] || other.low[i] > high[i]) return false;
    return true;
  }
  /// Squared distance of a point from the box; 0 inside.
  double squared_distance(const Vec3d& p) const {
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
      const double outside = std::max(std::max(low[i] - p[i], p[i] - high[i]), 0.0);
      sum += outside * outside;
    }
    return sum;
  }
};

/// A binary tree over boxes, split at the median of the longest axis. Immutable, so that any number of
/// threads may ask it at once.
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Box>& boxes);

  /// Calls `refine(item, bound)` for items whose box is nearer to p than sqrt(bound), nearest boxes first;
  /// `refine` may lower the bound.
  template <class Refine>
  void nearest(const Vec3d& p, double bound, Refine refine) const {
    Stack stack;
    stack.push(0, nodes_.empty() ? bound : nodes_[0].box.squared_distance(p));
    while (!stack.empty()) {
      const auto [index, distance] = stack.pop();
      if (!(distance < bound)) continue;
      const Node& node = nodes_[static_cast<size_t>(index)];
      if (node.count > 0) {
        for (int i = 0; i < node.count; ++i)
          refine(items_[static_cast<size_t>(node.first) + static_cast<size_t>(i)], bound);
        continue;
      }
      const int left = index + 1, right = node.first;
      const double to_left = nodes_[static_cast<size_t>(left)].box.squared_distance(p);
      const double to_right = nodes_[static_cast<size_t>(right)].box.squared_distance(p);
      if (to_left < to_right) {
        stack.push(right, to_right);
        stack.push(left, to_left);
      } else {
        stack.push(left, to_left);
        stack.push(right, to_right);
      }
    }
  }

  /// Whether `accept` is true of an item of a leaf that meets a box.
  template <class Accept>
  bool any_near(const Box& box, Accept accept) const {
    Stack stack;
    if (!nodes_.empty()) stack.push(0, 0);
    while (!stack.empty()) {
      const int index = stack.pop().first;
      const Node& node = nodes_[static_cast<size_t>(index)];
      if (!node.box.meets(box)) continue;
      for (int i = 0; i < node.count; ++i)
        if (accept(items_[static_cast<size_t>(node.first) + static_cast<size_t>(i)])) return true;
      if (node.count > 0) continue;
      stack.push(node.first, 0);
      stack.push(index + 1, 0);
    }
    return false;
  }

 private:
  struct Node {
    Box box;
    int first = 0;  // of a leaf: its first item; of an inner node: its right child (the left one follows it)
    int count = 0;  // items of a leaf, 0 in an inner node
  };
  // Depth is at most log2 of the number of items, since the split is at the median: 64 entries are plenty.
  struct Stack {
    std::array<std::pair<int, double>, 64> entries;
    int size = 0;
    bool empty() const { return size == 0; }
    void push(int node, double distance) { entries[static_cast<size_t>(size++)] = {node, distance}; }
    std::pair<int, double> pop() { return entries[static_cast<size_t>(--size)]; }
  };

  Box build(const std::vector<Box>& boxes, const std::vector<Vec3d>& centres, int begin, int end);

  std::vector<Node> nodes_;
  std::vector<int> items_;
};

using Triangle = std::array<int, 3>;

/// Barycentric coordinates of the point of triangle (a, b, c) nearest to p; defined for degenerate triangles
/// too. [Ericson 2005, Real-Time Collision Detection, section 5.1.5]
Vec3d closest_barycentric(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c);

struct ClosestPoint {
  int triangle = -1;  ///< -1 if there is none within the bound
  Vec3d barycentric{0, 0, 0};
  Vec3d point{0, 0, 0};
  double squared_distance = std::numeric_limits<double>::infinity();
};

/// Closest points on a soup of triangles. Of those that are as near but for rounding, as beside a common
/// side, the one with the lowest number is taken, wherever the soup lies.
class TriangleTree {
 public:
  TriangleTree(std::vector<Vec3d> points, std::vector<Triangle> triangles);

  ClosestPoint closest(const Vec3d& p) const {
    return closest_if(p, std::numeric_limits<double>::infinity(), [](int) { return true; });
  }

  /// The closest point among triangles that `accept`(index) lets pass, nearer than sqrt(bound).
  template <class Accept>
  ClosestPoint closest_if(const Vec3d& p, double bound, Accept accept) const {
    ClosestPoint best;
    double least = bound;  // squared distance of the nearest so far
    boxes_.nearest(p, bound, [&](int triangle, double& limit) {
      if (accept(triangle)) try_triangle(triangle, p, least, limit, best);
    });
    if (best.triangle >= 0) best.squared_distance = least;
    return best;
  }

  /// Whether `accept`(index) is true of a triangle whose box meets another.
  template <class Accept>
  bool any_near(const Box& box, Accept accept) const {
    return boxes_.any_near(box, [&](int t) { return box_of(t).meets(box) && accept(t); });
  }
  Box box_of(int triangle) const {
    Box box;
    for (const int corner : triangles_[static_cast<size_t>(triangle)])
      box.add(points_[static_cast<size_t>(corner)]);
    return box;
  }
  std::array<Vec3d, 3> corners_of(int triangle) const {
    const Triangle& corner = triangles_[static_cast<size_t>(triangle)];
    return {points_[static_cast<size_t>(corner[0])], points_[static_cast<size_t>(corner[1])],
            points_[static_cast<size_t>(corner[2])]};
  }

  const std::vector<Vec3d>& points() const { return points_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }

 private:
  void try_triangle(int triangle, const Vec3d& p, double& least, double& limit, ClosestPoint& best) const;

  std::vector<Vec3d> points_;
  std::vector<Triangle> triangles_;
  BoxTree boxes_;
  double rounding_ = 0;  // of a distance
};

}  // namespace anisomesh::detail
