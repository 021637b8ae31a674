#include "near_locator.hh"

#include <limits>

#include "numerics/bvh.hh"

namespace anisomesh::detail {

SurfacePoint NearLocator::locate(const Vec2d&, const Vec3d& place, OpenMesh::FaceHandle start,
                                 bool* inside) const {
  if (inside) *inside = true;
  SurfacePoint best;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](int face) {
    const Vec3d &a = mesh_.corner_point(face, 0), &b = mesh_.corner_point(face, 1),
                &c = mesh_.corner_point(face, 2);
    const Vec3d w = closest_barycentric(place, a, b, c);
    const double squared = (w[0] * a + w[1] * b + w[2] * c - place).sqrnorm();
    if (!(squared < least)) return false;
    least = squared;
    best = {OpenMesh::FaceHandle(face), w};
    return true;
  };
  consider(start.idx());
  if (!best.face.is_valid()) return {start, {1.0 / 3, 1.0 / 3, 1.0 / 3}};  // a face without area
  for (int at = -1; at != best.face.idx();) {  // the distance falls with each round
    at = best.face.idx();
    for (const int v : mesh_.corners[static_cast<size_t>(at)])
      for (int i = 0; i < mesh_.star_size(v); ++i) consider(mesh_.star_of(v)[i]);
  }
  return best;
}

}  // namespace anisomesh::detail
