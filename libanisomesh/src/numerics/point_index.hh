// A static k-d tree over points in the plane, of which points are struck out one after the other: is there
// one left in this triangle?
#pragma once

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <array>
#include <vector>

namespace anisomesh::detail {

class PointIndex {
 public:
  /// `alive[i]` false leaves point i out from the start.
  PointIndex(const std::vector<OpenMesh::Vec2d>& points, const std::vector<char>& alive);

  void remove(int point);
  /// True if no point is left in the closed triangle but its own corners. A point that rounding does not
  /// allow to call outside counts as inside.
  bool triangle_is_empty(int a, int b, int c) const;

 private:
  struct Node {
    OpenMesh::Vec2d low, high;
    int begin, end;  // range in order_
    int left = -1, right = -1;
    int parent = -1;
    int count = 0;  // points left
  };
  int build(int begin, int end, int parent);

  std::vector<OpenMesh::Vec2d> points_;
  std::vector<char> alive_;
  std::vector<int> order_, leaf_;
  std::vector<Node> nodes_;
};

}  // namespace anisomesh::detail
