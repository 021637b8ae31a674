// Where a triangle soup crosses or overlaps itself.
#pragma once

#include <utility>
#include <vector>

#include "numerics/bvh.hh"

namespace anisomesh::detail {

/// Pairs of triangles that have more in common than the corners and edges they share by index, the lower
/// number first, in ascending order. Triangles without area are left out.
/// Decided by exact predicates. \pre the points are finite.
std::vector<std::pair<int, int>> self_intersections(const std::vector<Vec3d>& points,
                                                    const std::vector<Triangle>& triangles);

}  // namespace anisomesh::detail
