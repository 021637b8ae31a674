// The cells of a network in the parameter plane, by flooding its triangulation. [ACDLD03, section 4.3]
#pragma once

#include "mesher/cells.hh"
#include "network/uv_locator.hh"

namespace anisomesh::detail {

/// \param probes whether the vertices of the surface are wanted as probes
/// \throw CannotProcess if the network is not planar
std::vector<Cell> plane_cells(const NetworkGraph& network, const SurfaceRef& surface,
                              const UvLocator& locator, bool probes);

}  // namespace anisomesh::detail
