// Triangles brought together in pairs and made quads, over the whole mesh.
#pragma once

#include <vector>

#include "mesher/polygon_judge.hh"
#include "network/network_graph.hh"

namespace anisomesh::detail {

/// A region with an odd number of corners leaves a triangle. Two triangles with up to `max_between` quads
/// between them are partitioned anew, together with these, where that is better by the judge's costs: over
/// conforming edges, but not those between two isotropic samples, and over edges of lines where `join_lines`;
/// never over a feature. Polygons of more than four corners are left alone.
void pair_triangles(std::vector<std::vector<int>>& polygons, const NetworkGraph& network,
                    const PolygonJudge& judge, bool join_lines, int max_between = 1);

}  // namespace anisomesh::detail
