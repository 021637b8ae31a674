// Lines of curvature of the half torus (R = 1), which are circles, for tests and benchmarks.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "anisomesh/lines.hh"
#include "anisomesh/surface.hh"

/// A circle of curvature: constant in one angle, radians, over a range of the other.
struct CircleArc {
  double at = 0, from = 0, to = 0;
};

/// The circle that most of a line lies on.
inline CircleArc circle_arc(const anisomesh::SurfaceRef& surface, const anisomesh::Line& line) {
  const bool max = line.kind == anisomesh::LineKind::max;
  std::vector<double> across, along;
  for (const auto& point : line.points) {
    const auto p = position(surface, point);
    const double tube = std::atan2(p[2], std::hypot(p[0], p[1]) - 1), around = std::atan2(p[1], p[0]);
    across.push_back(max ? around : tube);
    along.push_back(max ? tube : around);
  }
  std::nth_element(across.begin(), across.begin() + across.size() / 2, across.end());
  const auto ends = std::minmax_element(along.begin(), along.end());
  return {across[across.size() / 2], *ends.first, *ends.second};
}
