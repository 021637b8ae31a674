#include "anisomesh/surface.hh"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "anisomesh/errors.hh"
#include "numerics/enclosing_sphere.hh"
#include "surface/unfit_mesh.hh"

namespace anisomesh {

namespace {

std::string scientific(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

// Beyond these, products of four lengths cannot be told from 0, or from infinity.
constexpr double kLeastExtent = 1e-60, kMostExtent = 1e60;

void refuse_extent(double diagonal) {
  if (diagonal >= kLeastExtent && diagonal <= kMostExtent) return;
  if (diagonal == 0) throw InvalidInput("all vertices lie in one place");
  throw InvalidInput("the bounding box has a diagonal of " + scientific(diagonal) + ", and lengths from " +
                     scientific(kLeastExtent) + " to " + scientific(kMostExtent) +
                     " can be computed with; scale the mesh");
}

}  // namespace

SurfaceRef::SurfaceRef(OpenMesh::TriConnectivity& connectivity, std::vector<Vec3d> points)
    : connectivity_(&connectivity), points_(std::move(points)) {
  detail::refuse_deleted_elements(connectivity, "the mesh");
  if (connectivity.n_faces() == 0) throw InvalidInput("the mesh has no faces");
  Vec3d low = points_.front(), high = points_.front();
  for (size_t i = 0; i < points_.size(); ++i) {
    const Vec3d& p = points_[i];
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      throw InvalidInput("vertex " + std::to_string(i) + " has a coordinate that is not finite");
    low.minimize(p);
    high.maximize(p);
  }
  const Vec3d size = high - low;
  const double longest = std::max({size[0], size[1], size[2]});  // squares may underflow or overflow
  diagonal_ = longest > 0 && std::isfinite(longest) ? longest * (size / longest).norm() : longest;
  refuse_extent(diagonal_);
  extent_ = std::min(detail::enclosing_diameter(points_), diagonal_);
}

Vec3d position(const SurfaceRef& surface, const SurfacePoint& point) {
  const auto corners = surface.corners(point.face);
  const Vec3d a = point.barycentric[0] * surface.point(corners.vertex[0]),
              b = point.barycentric[1] * surface.point(corners.vertex[1]),
              c = point.barycentric[2] * surface.point(corners.vertex[2]);
  // Rounded alike with whichever corner the face begins: the smallest and the largest first.
  Vec3d sum;
  for (size_t k = 0; k < 3; ++k) {
    const double low = std::min({a[k], b[k], c[k]}), high = std::max({a[k], b[k], c[k]});
    const double middle = std::max(std::min(a[k], b[k]), std::min(std::max(a[k], b[k]), c[k]));
    sum[k] = low + high + middle;
  }
  return sum;
}

}  // namespace anisomesh
