// Smoothing of the 2D tensor field.
#pragma once

#include <array>
#include <vector>

#include "anisomesh/progress.hh"
#include "anisomesh/surface.hh"

namespace anisomesh {

struct SmoothingOptions {
  int iterations = 3;               ///< passes of the filter, >= 0
  double radius_fraction = 0.0125;  ///< support of the Gaussian, fraction of SurfaceRef::extent(); > 0
  bool anisotropic = false;         ///< weigh neighbours also by likeness of their tensors: keeps more detail
  void validate() const;            ///< \throw InvalidOption
};

struct SmoothingReport {
  double mean_change = 0;  ///< mean Frobenius norm of the change over the mean norm of the field
  double seconds = 0;
};

/// Gaussian filter of the 2D curvature tensors, coefficient by coefficient, clipped at features. [ACDLD03,
/// section 2.3, 2.5] A support that holds no other vertex leaves the tensor as it is.
///
/// Reads: uv, area_stretch, tensor2d, features; writes: tensor2d. Without uv: tensor, normal; surface_tensor.
/// \throw InvalidOption, InvalidInput, Cancelled; the mesh is then as it was
SmoothingReport smooth_tensors(const SurfaceRef& surface, const SmoothingOptions& options = {},
                               const Progress& progress = {});

/// The one-sided 2D tensors at the three corners of every face, in the order of SurfaceRef::corners(): that
/// of the vertex, except at a vertex on a feature, where it is the mean over its neighbours off the feature
/// on the same side. [ACDLD03, section 2.5] Reads: tensor2d, edge feature status.
/// \throw InvalidInput
std::vector<std::array<Vec3d, 3>> corner_tensors(const SurfaceRef& surface);

}  // namespace anisomesh
