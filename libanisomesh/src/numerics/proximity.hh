// Distances in the plane to polylines, as seen from a point: a constrained Delaunay triangulation that grows.
#pragma once

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <limits>
#include <memory>
#include <vector>

namespace anisomesh::detail {

using OpenMesh::Vec2d;

/// The nearest point of something, and the tangent there.
struct PlaneNeighbour {
  double distance = std::numeric_limits<double>::infinity();
  Vec2d point{0, 0};
  Vec2d direction{1, 0};  ///< unit, along the polyline
  int line = -1;
  double arc = 0;    ///< interpolated between the ends of the segment
  double scale = 1;  ///< interpolated between the ends of the segment
  /// Squared distance to the middle of the segment: of segments that meet in the nearest point it is that
  /// whose middle is nearer, so that rounding has no say in the direction.
  double middle2 = std::numeric_limits<double>::infinity();
};

/// Distances that differ by so little, squared and over the larger, are the same but for rounding.
constexpr double kSameDistance = 1e-9;

struct PlaneNeighbourhood {
  PlaneNeighbour line;   ///< nearest line that is seen from the point
  PlaneNeighbour fence;  ///< nearest fence that is seen from the point, if it is nearer than the line
};

/// What a query leaves out: the part of one line between two values of its arc parameter.
struct Ignore {
  int line = -1;
  double from = 0, to = 0;
};

/// Polylines and fences in the plane. A line is not seen through a fence or through another line; the nearest
/// point of a set of segments is always seen. Lines may touch but should not cross.
/// Queries that lie close to each other are fast: the search starts from the face of the last one.
/// [ACDLD03, section 3.1.4, proximity queries]
class Proximity {
 public:
  Proximity();
  ~Proximity();
  Proximity(const Proximity&) = delete;
  Proximity& operator=(const Proximity&) = delete;

  /// Enters fences: pairs of points with their scales. Call once, before anything else.
  struct Fence {
    Vec2d from{0, 0}, to{0, 0};
    double from_scale = 1, to_scale = 1;
  };
  void enter_fences(const std::vector<Fence>& fences);

  struct Vertex {
    Vec2d point{0, 0};
    double arc = 0;    ///< parameter along the line, monotonous
    double scale = 1;  ///< any value to be interpolated
  };
  /// Enters a piece of a line.
  void enter_line(int line, const std::vector<Vertex>& vertices);
  /// Enters a single point as a line of its own.
  void enter_point(int line, const Vec2d& point, double scale);

  /// The nearest line within `bound` that is seen from the point, and the nearest fence nearer than it.
  PlaneNeighbourhood nearest(const Vec2d& point, double bound, const Ignore& ignore = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace anisomesh::detail
