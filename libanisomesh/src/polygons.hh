// The regions between the edges of the decimated network, as polygons. [ACDLD03, section 4.3]
#pragma once

#include <vector>

#include "conforming.hh"
#include "network_graph.hh"

namespace anisomesh::detail {

struct PolygonSet {
  std::vector<std::vector<int>> polygons;  ///< nodes of the network, counter-clockwise in (u, v)
  size_t convexity_splits = 0;             ///< cuts of regions that were not convex
  size_t conforming_edges = 0;             ///< other cuts, edges at isotropic samples included
};

/// \throw CannotProcess if the network is not planar
PolygonSet extract_polygons(const NetworkGraph& network, const PolygonJudge& judge,
                            const PartitionOptions& options);

}  // namespace anisomesh::detail
