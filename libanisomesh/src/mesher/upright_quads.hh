// Quads that would be drawn with a triangle that stands upright on them.
#pragma once

#include <vector>

#include "network/network_graph.hh"

namespace anisomesh::detail {

/// At the rim of a hole three corners of a quad of its wall may be as good as in line, and the shorter
/// diagonal, which a viewer draws, would lay a triangle over the hole or over the face around it. Such quads
/// are split along the other diagonal, unless that is a side of other polygons.
/// \return how many were split
size_t split_upright_quads(std::vector<std::vector<int>>& polygons, const NetworkGraph& network);

}  // namespace anisomesh::detail
