// The moves that balance a result: each is judged by the error of the samples it concerns, before and after.
#pragma once

#include <vector>

#include "anisomesh/balance.hh"
#include "fit_state.hh"
#include "patch_mesh.hh"
#include "patch_partition.hh"

namespace anisomesh::detail {

struct PatchMove {
  PatchMesh::Patch patch;
  std::vector<std::vector<int>> pieces;  ///< vertices; -1 is the added one
  double gain = 0;                       ///< error before less error after, and triangles saved
  bool adds = false;
  Vec3d place{0, 0, 0};  ///< of the added vertex
  SurfacePoint source;
};

class PatchMoves {
 public:
  PatchMoves(const SurfaceRef& surface, const FitInput& input, const FitState& fit,
             const BalanceOptions& options);

  /// Moves that keep all vertices, best first.
  std::vector<PatchMove> repartitions(const PatchMesh& mesh) const;
  /// Vertices whose removal costs least, that first.
  std::vector<PatchMove> removals(const PatchMesh& mesh) const;
  /// Vertices to add, best first.
  std::vector<PatchMove> additions(const PatchMesh& mesh) const;

  double mean_error() const { return mean_error_; }

 private:
  struct Situation;
  Situation look_at(const PatchMesh& mesh, const PatchMesh::Patch& patch) const;
  double guess(const PatchMesh& mesh, const PatchMesh::Patch& star, int vertex) const;
  PatchMove partition(const PatchMesh& mesh, const PatchMesh::Patch& patch) const;
  PatchMove addition(const PatchMesh& mesh, const PatchMesh::Patch& patch) const;

  const SurfaceRef& surface_;
  const FitInput& input_;
  const FitState& fit_;
  PatchCosts costs_;
  double mean_error_ = 0;
  std::vector<double> error_;               // of each polygon
  std::vector<int> first_sample_, sample_;  // of the input, for each polygon
};

}  // namespace anisomesh::detail
