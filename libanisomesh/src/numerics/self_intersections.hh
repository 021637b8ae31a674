// Where a triangle soup crosses or overlaps itself.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "numerics/bvh.hh"

namespace anisomesh::detail {

/// Pairs of triangles that have more in common than the corners and edges they share by index, the lower
/// number first, in ascending order. Triangles without area are left out.
/// Decided by exact predicates. Past `most` of them no more are looked for. \pre the points are finite.
std::vector<std::pair<int, int>> self_intersections(const std::vector<Vec3d>& points,
                                                    const std::vector<Triangle>& triangles,
                                                    size_t most = std::numeric_limits<size_t>::max());

/// Whether two triangles have more in common than the corners and edges that are in the same places.
bool do_cross(const std::array<Vec3d, 3>& first, const std::array<Vec3d, 3>& second);

}  // namespace anisomesh::detail
