// One state of the fit: where the vertices are, and what that means.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>
#include <vector>

#include "anisomesh/fit.hh"
#include "balance/border_twins.hh"
#include "fit/fit_curves.hh"
#include "fit/fit_matching.hh"
#include "fit/fit_system.hh"
#include "fit/fit_terms.hh"

namespace anisomesh::detail {

class FitState {
 public:
  /// \throw InvalidInput if the result was made from another surface
  FitState(const SurfaceRef& surface, const FitInput& input, const OpenMesh::PolyMesh& result,
           const FitOptions& options);
  /// Goes on with a result in which polygons have changed, and uses up what was known.
  /// \param heirs of each polygon, those in its place; none where it was changed twice
  FitState(FitState&& earlier, const OpenMesh::PolyMesh& result, const std::vector<PolygonRange>& heirs);

  /// Twice the squared rms.
  double energy() const { return pairs_.squared; }
  const std::vector<Vec3d>& points() const { return points_; }
  const FitMesh& mesh() const { return mesh_; }
  const FitTriangles& triangles() const { return triangles_; }
  const FitMatching& matching() const { return matching_; }
  const std::vector<FitPair>& pairs() const { return pairs_.pair; }
  const FitCurves& curves() const { return curves_; }
  /// Groups of vertices that stay together.
  const std::vector<std::vector<int>>& twins() const { return twins_; }

  /// How many times more alignment counts than on a result that is far coarser than its input. With more
  /// vertices than a fifth of the input's, what a result gains in distance is more and more how the input was
  /// sampled.
  double alignment_factor() const;

  /// Takes one step, if there is one that lowers the energy. \return vertices that were held back
  size_t improve();
  /// At most so often, until little is gained. \return how often
  int improve_often(int passes, size_t* held = nullptr, const Progress& progress = {});

 private:
  std::vector<Vec3d> solve() const;
  void keep_together(std::vector<Vec3d>& step) const;

  const SurfaceRef& surface_;
  const FitOptions& options_;
  const FitInput& input_;
  const FitMesh mesh_;
  const std::vector<char> free_;
  const std::vector<std::vector<int>> twins_;  // vertices on the border, in one place
  const FitPattern pattern_;
  std::vector<Vec3d> points_;
  FitTriangles triangles_;
  FitMatching matching_;
  FitPairs pairs_, spare_;
  std::vector<TriangleForm> forms_;
  FitCurves curves_;
};

}  // namespace anisomesh::detail
