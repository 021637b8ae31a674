// The network of lines on the surface itself, from the overlay.
#pragma once

#include "network/network_graph.hh"
#include "network/overlay.hh"

namespace anisomesh::detail {

/// Nodes are those of the overlay; most have no edge and are there for the triangles only.
NetworkGraph network_of(const SurfaceRef& surface, const SurfaceNormals& normals, const Overlay& overlay);

}  // namespace anisomesh::detail
