// Curvature tensors at the vertices of a triangle mesh.
#pragma once

#include "anisomesh/progress.hh"
#include "anisomesh/surface.hh"

namespace anisomesh {

enum class CurvatureEstimator {
  normal_cycle,             ///< the paper's: edges weighted by dihedral angle [Cohen-Steiner and Morvan 2003]
  corrected_normal_current  ///< interpolated corrected curvature measures [Lachaud, Romon, Thibert 2022]
};

struct CurvatureOptions {
  CurvatureEstimator estimator = CurvatureEstimator::corrected_normal_current;
  /// Radius of the ball around a vertex, fraction of SurfaceRef::extent(); >= 0. 0: by the noise of the
  /// surface, which decides normal_fraction too; 0.0125 where there is little
  double radius_fraction = 0.0125;
  /// Normals are averaged over about this fraction of the ball's radius before anything else, against noise;
  /// [0, 1]
  double normal_fraction = 0;
  void validate() const;  ///< \throw InvalidOption
};

struct CurvatureReport {
  double radius = 0;           ///< in model units
  double normal_fraction = 0;  ///< as used
  double noise = 0;  ///< where the radius is automatic: expected error of curvature in balls of the default
                     ///< radius, relative
  size_t enlarged_balls = 0;    ///< vertices whose ball was enlarged to hold their 1-ring
  size_t degenerate_faces = 0;  ///< faces without area, left out of the sums
  double seconds = 0;
};

/// Estimates the curvature tensor, the normal and the principal curvatures and directions at every vertex.
/// [ACDLD03, section 2.1, equation 1; clipped at features: 2.5]
///
/// Reads: points, edge feature status. Writes: normal, tensor, k_min, k_max, gamma_min, gamma_max
/// (properties.hh). Vertices on a feature get the average of their sides; one-sided values come from
/// corner_tensors() in the plane. Balls that do not hold several edges are enlarged; the same bytes for any
/// number of threads (docs/curvature.md). \throw InvalidOption, InvalidInput, Cancelled; the mesh is then as
/// it was
CurvatureReport estimate_curvature(const SurfaceRef& surface, const CurvatureOptions& options = {},
                                   const Progress& progress = {});

}  // namespace anisomesh
