// As many vertices as a bound on the error takes, and no more.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>

#include "anisomesh/balance.hh"

namespace anisomesh {

struct MaxErrorOptions {
  double max_error_fraction = 0;  ///< of the diagonal; Hausdorff distance, both ways; 0: no bound; >= 0
  int rounds = 10;                ///< of removals and additions; >= 1
  int max_attempts = 4;           ///< remesh() traces lines so often, each time for half the epsilon; >= 1
  void validate() const;          ///< \throw InvalidOption
};

/// Bounds of a Hausdorff distance both ways, fraction of the diagonal, for all points and not by samples.
/// Infinite where only one of the two has such curves.
struct VerifiedDistance {
  double at_least = 0, at_most = 0;
};

struct MaxErrorReport {
  BalanceReport balance;
  bool met =
      false;  ///< no point of either is farther from the other than the bound, of borders and features too
  double at_least = 0, at_most = 0;  ///< between the surfaces, as VerifiedDistance
  VerifiedDistance border;           ///< between the borders
  VerifiedDistance features;         ///< between the feature edges
  int attempts = 0;
  double seconds = 0;
};

/// Removes and adds vertices of a result until no point of it or of the surface is farther from the other
/// than max_error_fraction, nor any point of their borders and of their feature edges from those of the
/// other. Each round fits, verifies, adds vertices where the error is near the bound and removes some where
/// what is left stays far below. Reads, writes: as balance_vertices(). Where the bound is not met the nearest
/// result is left. \pre as fit_vertices(), max_error_fraction above 0 \throw as fit_vertices()
MaxErrorReport bound_error(const SurfaceRef& surface, OpenMesh::PolyMesh& result,
                           const MaxErrorOptions& options, const BalanceOptions& balance = {},
                           const FitOptions& fit = {}, const Progress& progress = {});

}  // namespace anisomesh
