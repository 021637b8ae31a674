// The arrangement of segments in the plane: a constrained Delaunay triangulation that turns every crossing
// into a vertex and remembers of each constraint which kind of segment it is part of. [ACDLD03, section 4.1]
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "numerics/planar_graph.hh"

namespace anisomesh::detail {

/// Exact predicates decide where a segment runs; only the coordinates of a crossing are rounded. A crossing
/// whose rounded place would turn a triangle over is moved to the nearer end of the segment it crosses, so
/// the triangulation is valid at all times and no tolerance is needed.
class Arrangement {
 public:
  /// All points must lie in the box.
  Arrangement(const OpenMesh::Vec2d& low, const OpenMesh::Vec2d& high);
  ~Arrangement();

  /// The node at `uv`: a new one, or the one that is there already.
  int insert_point(const OpenMesh::Vec2d& uv);
  /// Enters the segment between two nodes. Where it overlaps another, the larger kind stays.
  /// \return false if rounding made it impossible to follow the segment to its end
  bool insert_segment(int a, int b, int kind, int tag);

  struct Crossing {
    int node;
    std::array<int, 2> tag;  ///< of the two segments that cross there
  };

  const PlanarGraph& graph() const;
  const std::vector<Crossing>& crossings() const;

  struct Triangle {
    std::array<int, 3> node;      ///< counter-clockwise; -1 to -4 for a corner of the box
    std::array<int, 3> neighbor;  ///< opposite the node of the same place; -1 outside the box
    std::array<int, 3> edge;      ///< edge of the graph opposite the node of the same place, or -1
  };
  std::vector<Triangle> triangles() const;
  /// Where a corner of the box is.
  OpenMesh::Vec2d box_corner(int node) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace anisomesh::detail
