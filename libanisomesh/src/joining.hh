// Pairs of triangles made quads, over the whole mesh.
#pragma once

#include <vector>

#include "network_graph.hh"
#include "polygon_judge.hh"

namespace anisomesh::detail {

/// Joins neighbouring triangles where the quad is better by the judge's costs: over conforming edges, but not
/// those between two isotropic samples, and over edges of lines where `join_lines`; never over a feature.
void join_pairs(std::vector<std::vector<int>>& polygons, const NetworkGraph& network,
                const PolygonJudge& judge, bool join_lines);

}  // namespace anisomesh::detail
