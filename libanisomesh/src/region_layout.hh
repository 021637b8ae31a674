// A plane for one region of the surface, where its corners are drawn to see which of them are visible from
// which. [ACDLD03, section 4.3 has the parameter plane for that]
#pragma once

#include <array>
#include <vector>

#include "polygon_judge.hh"
#include "region_mesher.hh"

namespace anisomesh::detail {

/// Writes `uv` of all corners: their projection along the region's normal where that turns none of the
/// triangles over, and otherwise the loop on a circle with the other corners between their neighbours (Tutte
/// 1963), which is a drawing without folds for any region that is a disc.
/// \param triangles of the corners, by index; none: the loop alone must not cross itself
void lay_out(RegionCorners& corners, const std::vector<std::array<int, 3>>& triangles);

/// Writes `uv` of the corners of a region and of its probes.
void lay_out(Region& region);

}  // namespace anisomesh::detail
