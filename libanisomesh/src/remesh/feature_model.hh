// How many vertices features need, before a polygon is built.
#pragma once

#include <vector>

#include "anisomesh/surface.hh"

namespace anisomesh::detail {

/// The number of vertices on features that are followed within a tolerance, as the decimation straightens
/// them (Ramer 1972, Douglas and Peucker 1973). Reads: points, edge feature status.
class FeatureModel {
 public:
  FeatureModel(const SurfaceRef& surface, double corner_angle_degrees);

  /// Besides the corners. \param tolerance model units
  double count(double tolerance) const;
  /// Those that stay however large the tolerance is.
  double corners() const { return static_cast<double>(corners_); }

 private:
  /// Of every vertex that is no corner the tolerance from which on it goes, ascending, model units.
  std::vector<double> goes_at_;
  size_t corners_ = 0;
};

}  // namespace anisomesh::detail
