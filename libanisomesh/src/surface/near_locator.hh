// Finds the surface point nearest to a place in space by going downhill from a face nearby.
#pragma once

#include "surface/surface_arrays.hh"
#include "surface/surface_locator.hh"

namespace anisomesh::detail {

/// Never leaves the sheet it starts on: what is near in space but far along the surface is not found.
class NearLocator final : public SurfaceLocator {
 public:
  explicit NearLocator(const SurfaceRef& surface) : mesh_(surface) {}
  SurfacePoint locate(const Vec2d& uv, const Vec3d& place, OpenMesh::FaceHandle start,
                      bool* inside = nullptr) const override;
  Vec3d position(const SurfacePoint& point) const {
    const int face = point.face.idx();
    return point.barycentric[0] * mesh_.corner_point(face, 0) +
           point.barycentric[1] * mesh_.corner_point(face, 1) +
           point.barycentric[2] * mesh_.corner_point(face, 2);
  }

 private:
  SurfaceArrays mesh_;
};

}  // namespace anisomesh::detail
