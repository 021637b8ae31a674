// When a polygon counts as turned over: the same for what makes polygons and for the ruler.
#pragma once

#include <algorithm>

namespace anisomesh::detail {

/// Cosine: a wall beside a flat face faces neither way, whichever side rounding puts it on.
constexpr double at_right_angles = 0.03;
/// Cosine: the surface faces the other way.
constexpr double opposite = -0.5;

/// How far beyond the nearest point the surface may turn to a polygon's side for the polygon still to be
/// right: half its diameter; where the nearest point faces the other way no farther than ten times the
/// polygon's own distance from the surface. One that lies on the wrong side of a plate, and exactly there,
/// does not stand for the other side.
struct FoldReach {
  double far = 0, near = 0;

  FoldReach() = default;
  /// \param distance largest of a few places in the polygon from the surface
  FoldReach(double diameter, double distance)
      : far(0.5 * diameter), near(std::min(far, 10 * distance + 1e-6 * diameter)) {}

  /// \param cosine between the normals of the polygon and of the surface at the nearest point
  double beyond(double cosine) const { return cosine < opposite ? near : far; }
};

}  // namespace anisomesh::detail
