// Points spread over a triangle soup by area.
#pragma once

#include <vector>

#include "numerics/bvh.hh"

namespace anisomesh::detail {

struct AreaSample {
  int triangle = 0;
  Vec3d point{0, 0, 0};
};

/// `count` points, stratified: the soup's area is cut into `count` equal shares in the order of the
/// triangles, and each share gets one random point. The same seed gives the same points everywhere. Empty if
/// the soup has no area.
std::vector<AreaSample> sample_by_area(const std::vector<Vec3d>& points,
                                       const std::vector<Triangle>& triangles, size_t count, unsigned seed);

}  // namespace anisomesh::detail
