// Repartitions where the result lies farthest from the input, judged by distances in space.
#pragma once

#include <vector>

#include "balance/patch_moves.hh"
#include "compare/compare_parts.hh"
#include "fit/fit_state.hh"

namespace anisomesh::detail {

/// Where the polygons hang in the air, as over the opening of a mouth or from one side of a fold to the
/// other, what stands beside them faces all ways, and no view along one normal tells which partition is
/// better. There the pieces' distances from the whole input count, as the ruler takes them, and the input's
/// from them.
class FarMoves {
 public:
  FarMoves(const ReferenceSurface& reference, const FitState& fit, const BalanceOptions& options);
  /// Those that lower the largest distance of their patch by a fifth, and the error, the farthest first.
  std::vector<PatchMove> repartitions(const PatchMesh& mesh) const;
  /// Farther is far, model units.
  double limit() const { return limit_; }

 private:
  struct Error {
    double squared = 0, largest = 0;
    bool operator<(const Error& o) const { return squared < o.squared && largest < o.largest; }
  };
  struct Place;
  void measure(const std::vector<int>& polygon_of);
  std::vector<std::vector<int>> places(const PatchMesh& mesh) const;
  PatchMove partition(const PatchMesh& mesh, const PatchMesh::Patch& patch, Place& place) const;
  double cost(const Vec3d& a, const Vec3d& b, const Vec3d& c, double most) const;
  Error own_error(const PatchMesh& mesh, const Triangle& t, Place& place) const;
  Error error(const PatchMesh& mesh, const PatchMesh::Patch& patch,
              const std::vector<std::vector<int>>& pieces, const Error& most, Place& place) const;

  const ReferenceSurface& reference_;
  const FitState& fit_;
  const bool quads_;
  const double triangle_cost_;
  double limit_ = 0;                   // farther is far
  double area_ = 0;                    // of the result
  std::vector<double> far_;            // largest distance of each polygon, both ways, if beyond the limit
  std::vector<std::vector<int>> own_;  // samples of the input beside each polygon that is far
};

}  // namespace anisomesh::detail
