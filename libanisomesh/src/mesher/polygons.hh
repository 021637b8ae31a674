// Polygons for the cells of the decimated network. [ACDLD03, section 4.3]
#pragma once

#include <vector>

#include "mesher/cells.hh"

namespace anisomesh::detail {

struct PolygonSet {
  std::vector<std::vector<int>> polygons;  ///< nodes of the network, counter-clockwise
  size_t convexity_splits = 0;             ///< cuts of regions that were not convex
  size_t conforming_edges = 0;             ///< other cuts, edges at isotropic samples included
  size_t added_samples = 0;                ///< isotropic vertices where a cell lay too far from the surface
  size_t dropped_samples = 0;              ///< isotropic samples in cells that are near enough without
};

/// Adds the vertices that it needs to the network.
PolygonSet extract_polygons(NetworkGraph& network, std::vector<Cell> cells, const SurfaceRef& surface,
                            const SurfaceNormals& normals, const PolygonJudge& judge,
                            const RegionOptions& options);

}  // namespace anisomesh::detail
