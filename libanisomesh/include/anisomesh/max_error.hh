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

struct MaxErrorReport {
  BalanceReport balance;
  bool met = false;  ///< no point of either is farther from the other than the bound
  /// Bounds of the Hausdorff distance both ways, fraction of the diagonal, for all points and not by samples.
  double at_least = 0, at_most = 0;
  int attempts = 0;
  double seconds = 0;
};

/// Removes and adds vertices of a result until no point of it or of the surface is farther from the other
/// than max_error_fraction. Each round fits, verifies, adds vertices where the error is near the bound and
/// removes some where what is left stays far below. Reads, writes: as balance_vertices(). Where the bound is
/// not met the nearest result is left. \pre as fit_vertices(), max_error_fraction above 0 \throw as
/// fit_vertices()
MaxErrorReport bound_error(const SurfaceRef& surface, OpenMesh::PolyMesh& result,
                           const MaxErrorOptions& options, const BalanceOptions& balance = {},
                           const FitOptions& fit = {}, const Progress& progress = {});

}  // namespace anisomesh
