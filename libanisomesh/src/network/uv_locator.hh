// Finds the face under a point of the parameter plane by walking from a face nearby.
#pragma once

#include <vector>

#include "surface/surface_locator.hh"

namespace anisomesh::detail {

class UvLocator final : public SurfaceLocator {
 public:
  /// Reads: uv. The surface must outlive the locator.
  explicit UvLocator(const SurfaceRef& surface);

  const Vec2d& uv(OpenMesh::VertexHandle v) const { return uv_[static_cast<size_t>(v.idx())]; }
  Vec2d uv(const SurfacePoint& point) const;

  /// The point of the surface at `uv`. Outside the domain, and beyond a dent of the border that the walk does
  /// not get around, the place where the walk met the border, with `inside` false.
  SurfacePoint locate(const Vec2d& uv, OpenMesh::FaceHandle start, bool* inside = nullptr) const;
  SurfacePoint locate(const Vec2d& uv, const Vec3d&, OpenMesh::FaceHandle start,
                      bool* inside = nullptr) const override {
    return locate(uv, start, inside);
  }
  /// The same, and if the walk fails a search through all faces; for points that are known to be inside.
  SurfacePoint locate_surely(const Vec2d& uv, OpenMesh::FaceHandle start) const;

 private:
  struct FaceData {
    int corner[3];
    int neighbor[3];  // opposite the corner
  };
  Vec3d barycentric(const FaceData& face, const Vec2d& uv) const;

  std::vector<Vec2d> uv_;
  std::vector<FaceData> faces_;
};

}  // namespace anisomesh::detail
