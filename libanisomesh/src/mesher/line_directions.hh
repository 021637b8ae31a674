// The directions that lines follow, at any point of the surface: what edges that are no lines are held
// against.
#pragma once

#include <vector>

#include "anisomesh/lines.hh"
#include "anisomesh/surface.hh"

namespace anisomesh::detail {

class LineDirections {
 public:
  /// Reads surface_tensor, or else tensor, of the vertices, and follow; without them no direction is known.
  explicit LineDirections(const SurfaceRef& surface);

  /// sin^2 of twice the angle between an edge, seen in the tangent plane, and the nearer direction: 0 along
  /// one, 1 in the middle between two. Less where the anisotropy is low, so that the directions mean little;
  /// 0 where none are known.
  double misalignment(const SurfacePoint& point, const Vec3d& along) const;

 private:
  const SurfaceRef& surface_;
  Follow follow_ = Follow::curvature;
  std::vector<OpenMesh::Vec6d> tensors_;  ///< of the vertices, 1/length
};

}  // namespace anisomesh::detail
