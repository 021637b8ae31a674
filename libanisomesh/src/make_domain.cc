#include "make_domain.hh"

#include "anisomesh/flatten.hh"
#include "plane_domain.hh"
#include "surface_domain.hh"

namespace anisomesh::detail {

std::unique_ptr<FaceDomain> make_domain(const SurfaceRef& surface, const DensityOptions& density,
                                        Follow follow) {
  if (is_flattened(surface))
    return std::make_unique<PlaneDomain>(surface, read_plane_input(surface), density, follow);
  return std::make_unique<SurfaceDomain>(surface, read_surface_input(surface), density, follow);
}

}  // namespace anisomesh::detail
