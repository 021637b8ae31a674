// How triangles are sampled for the fit, and what counts as a near match.
#pragma once

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <algorithm>
#include <cmath>

#include "surface/rounding.hh"

namespace anisomesh::detail {

constexpr double least_cosine = 0.05;  ///< what faces elsewhere counts as so much farther at most
constexpr double near_match = 0.1;     ///< of the size of a polygon: such a foot is believed
constexpr double tiny = 1e-9;          ///< of the diagonal: nearer than this there is no direction
constexpr int max_divisions = 24;      ///< of the sides of one triangle

/// Whether a squared distance is less than another. A foot on a common side of two polygons is as far from
/// both, and belongs to the one that is met first: rounding does not choose. \param size of a polygon
inline bool is_nearer(double squared, double than, double size) {
  return squared < (1 - kTie) * than - kRounding * kRounding * size * size;
}

/// Into how many parts the sides of a triangle are divided, so that no piece has more than its share.
inline int divisions(double area, double share) {
  return std::clamp(static_cast<int>(std::ceil(std::sqrt(area / share) * (1 - kRounding))), 1, max_divisions);
}

/// Calls `visit` with the barycentric coordinates of the centres of n * n equal pieces.
template <class Visit>
void for_each_piece(int n, Visit visit) {
  using OpenMesh::Vec3d;
  const double step = 1.0 / n;
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j) {
      const double u = (i + 1.0 / 3) * step, v = (j + 1.0 / 3) * step;
      visit(Vec3d(1 - u - v, u, v));
      if (i + j + 1 >= n) continue;
      const double s = (i + 2.0 / 3) * step, t = (j + 2.0 / 3) * step;
      visit(Vec3d(1 - s - t, s, t));
    }
}

}  // namespace anisomesh::detail
