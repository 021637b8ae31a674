// The place of a segment that is nearest to another place, in the plane and in space.
#pragma once

#include <algorithm>

namespace anisomesh::detail {

/// As a parameter in [0, 1] from a to b; 0 where the segment has no length.
template <class V>
double nearest_parameter(const V& p, const V& a, const V& b) {
  const V along = b - a;
  const double squared = along | along;
  return squared > 0 ? std::clamp(((p - a) | along) / squared, 0.0, 1.0) : 0.0;
}

/// From that place to p.
template <class V>
V off_segment(const V& p, const V& a, const V& b) {
  return p - a - nearest_parameter(p, a, b) * (b - a);
}

}  // namespace anisomesh::detail
