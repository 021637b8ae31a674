#include "lines/make_domain.hh"

#include "anisomesh/errors.hh"
#include "anisomesh/flatten.hh"
#include "lines/plane_domain.hh"
#include "lines/surface_domain.hh"

namespace anisomesh::detail {

namespace {

// There lines would have no room, and be drawn all the same.
void refuse_without_area(const SurfaceRef& surface) {
  for (const auto f : surface.connectivity().all_faces()) {
    const auto c = surface.corners(f);
    const Vec3d& p = surface.point(c.vertex[0]);
    const Vec3d normal = (surface.point(c.vertex[1]) - p) % (surface.point(c.vertex[2]) - p);
    if (normal.sqrnorm() > 0) return;
  }
  throw InvalidInput("no face of the surface has an area");
}

}  // namespace

std::unique_ptr<FaceDomain> make_domain(const SurfaceRef& surface, const DensityOptions& density,
                                        Follow follow) {
  refuse_without_area(surface);
  if (is_flattened(surface))
    return std::make_unique<PlaneDomain>(surface, read_plane_input(surface), density, follow);
  return std::make_unique<SurfaceDomain>(surface, read_surface_input(surface), density, follow);
}

}  // namespace anisomesh::detail
