// Which sides a step of the fit would take too far from their feature or border.
#pragma once

#include <vector>

#include "fit/fit_curves.hh"

namespace anisomesh::detail {

/// Sides that would leave their curve, for places that are tried one after the other since the last match():
/// looked at anew is only what has moved in between.
class FitStrays {
 public:
  /// \param curves kept
  explicit FitStrays(const FitCurves& curves);
  /// Marks the ends of sides that would leave their curve farther than they may, or farther than before.
  void mark(const std::vector<Vec3d>& points, std::vector<char>& marked);

 private:
  using Sample = FitCurves::Sample;
  std::vector<char> moved_sides(const std::vector<Vec3d>& points) const;
  bool shares_vertex(int side, int other) const;

  const FitCurves& curves_;
  std::vector<Vec3d> points_;   // tried last
  std::vector<Sample> now_;     // nearest sides there
  std::vector<char> is_stray_;  // from the sample before to each
};

}  // namespace anisomesh::detail
