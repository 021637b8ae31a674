// The cells of a network on the surface, by flooding the triangulation that it is embedded in.
#pragma once

#include "mesher/cells.hh"
#include "network/mesh_embedding.hh"

namespace anisomesh::detail {

/// A cell that is no disc (a whole sphere, an annulus, a handle, or one with an edge that ends inside) comes
/// as its triangles, each a cell of its own.
std::vector<Cell> surface_cells(const NetworkGraph& network, const SurfaceRef& surface,
                                const MeshEmbedding& embedding, bool probes);

}  // namespace anisomesh::detail
