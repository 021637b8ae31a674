// How noisy a surface is, and what that asks of the estimate of its curvature.
#pragma once

#include "surface/surface_arrays.hh"

namespace anisomesh::detail {

struct NoiseChoice {
  double radius_fraction = 0.0125, normal_fraction = 0;  ///< of CurvatureOptions
  double noise = 0;  ///< expected error of the curvature in balls of 1 % of the diagonal, relative
};

/// The smallest ball in which noise leaves the curvature nearly as it is.
NoiseChoice choose_by_noise(const SurfaceRef& surface);

/// How often CornerNormals has to average so that normals are those of discs of about a radius.
int smoothing_passes(const SurfaceArrays& surface, double radius);

}  // namespace anisomesh::detail
