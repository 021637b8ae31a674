// The point of the surface that a place between the corners of a polygon stands for.
#pragma once

#include "anisomesh/surface.hh"

namespace anisomesh::detail {

/// In the plane it is found by its parameters, on the surface itself by where it is in space.
class SurfaceLocator {
 public:
  virtual ~SurfaceLocator() = default;
  /// \param uv, place the same place in the parameter plane and in space
  /// \param start a face near it
  /// \param inside false if the place is beyond the border
  virtual SurfacePoint locate(const Vec2d& uv, const Vec3d& place, OpenMesh::FaceHandle start,
                              bool* inside = nullptr) const = 0;
};

}  // namespace anisomesh::detail
