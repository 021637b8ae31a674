// A plane for one region of the surface, where its corners are drawn to see which of them are visible from
// which. [ACDLD03, section 4.3 has the parameter plane for that]
#pragma once

#include <array>
#include <vector>

#include "mesher/polygon_judge.hh"
#include "mesher/region_mesher.hh"

namespace anisomesh::detail {

/// Writes `uv` of the corners around some polygons: their projection along the normal where the loop does not
/// cross itself in it, and otherwise the loop on a circle.
void lay_out(RegionCorners& corners);

/// Writes `uv` of the corners and probes of a region: their projection where that turns none of the triangles
/// over, or at least leaves the loop simple, which then gets other triangles; otherwise the loop on a circle
/// with the other corners between their neighbours (Tutte 1963), a drawing without folds for any disc.
void lay_out(Region& region);

}  // namespace anisomesh::detail
