#include "surface/near_locator.hh"

#include <limits>

#include "numerics/bvh.hh"
#include "surface/rounding.hh"

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
    // Of faces as near but for rounding, as at an edge, the one that is met first.
    const double size = kRounding * kRounding * ((b - a).sqrnorm() + (c - a).sqrnorm());
    if (!(squared < (1 - kRounding) * least - size)) return false;
    least = squared;
    best = {OpenMesh::FaceHandle(face), w};
    return true;
  };
  consider(start.idx());
  if (!best.face.is_valid()) return {start, {1.0 / 3, 1.0 / 3, 1.0 / 3}};  // a face without area
  // The nearest point of a face is inside it, or on a side across which there may be a nearer one, or it is a
  // corner. The distance falls with each round.
  for (bool nearer = true; nearer;) {
    nearer = false;
    const auto face = static_cast<size_t>(best.face.idx());
    const Vec3d w = best.barycentric;
    int zero = -1, one = -1;
    for (int k = 0; k < 3; ++k) {
      if (w[k] <= 0) zero = k;
      if (w[k] >= 1) one = k;
    }
    if (one >= 0) {
      const int v = mesh_.corners[face][static_cast<size_t>(one)];
      for (int i = 0; i < mesh_.star_size(v); ++i) nearer |= consider(mesh_.star_of(v)[i]);
    } else if (zero >= 0) {
      const int across = mesh_.neighbours[face][static_cast<size_t>((zero + 1) % 3)];
      if (across >= 0) nearer = consider(across);
    }
  }
  return best;
}

}  // namespace anisomesh::detail
