// When a polygon counts as turned over: the same for what makes polygons and for the ruler.
#pragma once

namespace anisomesh::detail {

/// How far from the nearest point, as a share of the polygon's diameter, the surface may turn to its side for
/// the polygon still to be right.
constexpr double reach = 0.5;
/// Cosine: a wall beside a flat face faces neither way, whichever side rounding puts it on.
constexpr double at_right_angles = 0.03;

}  // namespace anisomesh::detail
