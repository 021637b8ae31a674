#include "surface/surface_normals.hh"

namespace anisomesh::detail {

SurfaceNormals::SurfaceNormals(const SurfaceRef& surface)
    : surface_(surface), normals_(surface.connectivity().n_vertices(), Vec3d(0, 0, 0)) {
  for (const auto f : surface.connectivity().faces()) {
    const auto c = surface.corners(f);
    const Vec3d n = cross(surface.point(c.vertex[1]) - surface.point(c.vertex[0]),
                          surface.point(c.vertex[2]) - surface.point(c.vertex[0]));
    for (const auto v : c.vertex) normals_[static_cast<size_t>(v.idx())] += n;
  }
  for (Vec3d& n : normals_) {
    const double length = n.norm();
    if (length > 0) n /= length;
  }
}

Vec3d SurfaceNormals::at(const SurfacePoint& point) const {
  const auto c = surface_.corners(point.face);
  Vec3d n(0, 0, 0);
  for (size_t k = 0; k < 3; ++k) n += point.barycentric[k] * normals_[static_cast<size_t>(c.vertex[k].idx())];
  const double length = n.norm();
  return length > 0 ? n / length : n;
}

}  // namespace anisomesh::detail
