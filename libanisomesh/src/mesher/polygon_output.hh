// The polygons of a network as an OpenMesh mesh with its properties.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>
#include <vector>

#include "network/network_graph.hh"

namespace anisomesh::detail {

/// \throw CannotProcess if OpenMesh cannot take a polygon
OpenMesh::PolyMesh make_mesh(const NetworkGraph& network, const std::vector<std::vector<int>>& polygons);

}  // namespace anisomesh::detail
