// Smooth normals of the surface, for judging which way a polygon faces.
#pragma once

#include <vector>

#include "anisomesh/surface.hh"

namespace anisomesh::detail {

/// Normals at the vertices, weighted by the areas of the faces, and linear in between.
class SurfaceNormals {
 public:
  explicit SurfaceNormals(const SurfaceRef& surface);
  /// Unit length; zero where the surface has no area.
  Vec3d at(const SurfacePoint& point) const;

 private:
  const SurfaceRef& surface_;
  std::vector<Vec3d> normals_;  // of the vertices
};

}  // namespace anisomesh::detail
