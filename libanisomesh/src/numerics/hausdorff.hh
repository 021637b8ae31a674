// How far one triangle soup at most is from another: not by samples, but for all of its points.
#pragma once

#include <vector>

#include "numerics/bvh.hh"

namespace anisomesh::detail {

struct DistanceBounds {
  double at_least = 0;  ///< some point is as far away
  double at_most = 0;   ///< no point is farther
};

/// Bounds of the largest distance of a point of `from` to `to`. Triangles are divided until `at_most` is
/// within the limit, or some point is found to be beyond it; then `at_most` is still a bound, but no tight
/// one. Triangles whose last two corners are the same vertex are segments. Infinite if there is nothing in
/// `to`, 0 if there is nothing in `from`.
DistanceBounds farthest_distance(const TriangleTree& from, const TriangleTree& to, double limit);

}  // namespace anisomesh::detail
