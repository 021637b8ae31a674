// From one region to polygons that are convex and have few corners. [ACDLD03, section 4.3, figure 9]
#pragma once

#include <vector>

#include "mesher/polygon_judge.hh"

namespace anisomesh::detail {

struct PartitionOptions {
  int max_degree = 4;  ///< 0: no bound
  bool convex = true;
};

/// Cuts the loop of a simple region into polygons, given as indices into its corners, counter-clockwise.
std::vector<std::vector<int>> partition_region(const RegionCorners& region, const PolygonJudge& judge,
                                               const PartitionOptions& options);

/// The partition of the loop into triangles and, if asked for, quads that costs least; empty if there is
/// none, which only rounding explains. For few corners: all partitions are considered.
std::vector<std::vector<int>> best_partition(const RegionCorners& region, const PolygonJudge& judge,
                                             bool quads);

/// Cuts the loop into triangles: ears of the polygon in the plane, widest first.
std::vector<std::vector<int>> cut_ears(const RegionCorners& region);

/// Joins triangles to polygons over their common edges, best first; for regions that are not simple, where a
/// corner occurs once although the border passes it more than once.
std::vector<std::vector<int>> join_triangles(const RegionCorners& region,
                                             std::vector<std::vector<int>> triangles,
                                             const PolygonJudge& judge, const PartitionOptions& options);

}  // namespace anisomesh::detail
