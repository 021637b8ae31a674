// The way from one surface point to another one nearby: what a segment of a line is on the surface.
#pragma once

#include <optional>
#include <vector>

#include "surface/surface_flood.hh"
#include "surface/surface_walk.hh"

namespace anisomesh::detail {

/// Finds ways between the consecutive points of a line: straight across the unfolded triangles where there is
/// such a way, else the one that bends least within the triangles through which the end is reached. One
/// thread at a time.
class SurfacePaths {
 public:
  SurfacePaths(const SurfaceRef& surface, const UnfoldedFaces& faces)
      : surface_(surface), faces_(faces), flood_(faces) {}

  /// The pieces of the way, from face to face, the first in the face of `from`, the last in that of `to`.
  /// Empty where no way is shorter than some times the distance in space: a fence lies between. What it
  /// returns is good until the next call.
  const std::vector<PathPiece>& find(const SurfacePoint& from, const SurfacePoint& to);

  /// The end of the way as seen from its start, in the frame of the start's face: the vector that walks there
  /// where the way is straight.
  std::optional<Vec2d> vector_to(const SurfacePoint& from, const SurfacePoint& to);

 private:
  bool reach(const SurfacePoint& from, const SurfacePoint& to);
  bool lay_through_strip(const Vec2d& start, const Vec2d& vector);
  bool lay_straight(const SurfacePoint& from, const SurfacePoint& to, const Vec2d& vector);

  const SurfaceRef& surface_;
  const UnfoldedFaces& faces_;
  SurfaceFlood flood_;
  std::vector<SurfaceFlood::Visit> strip_;
  std::vector<PathPiece> pieces_, tried_;
};

}  // namespace anisomesh::detail
