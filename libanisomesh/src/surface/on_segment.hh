// Whether a point lies on a segment: what is a T-junction where the one is a vertex and the other a side.
#pragma once

#include "anisomesh/surface.hh"

namespace anisomesh::detail {

/// Of the segment's length: ten times what the ruler counts.
constexpr double on_segment_share = 1e-4;

inline bool is_on_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d along = b - a;
  const double squared = along.sqrnorm(), t = (p - a) | along;
  if (!(t > on_segment_share * squared && t < (1 - on_segment_share) * squared)) return false;
  return (p - a - t / squared * along).sqrnorm() < on_segment_share * on_segment_share * squared;
}

}  // namespace anisomesh::detail
