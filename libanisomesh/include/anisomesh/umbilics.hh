// Umbilic points of the 2D tensor field.
#pragma once

#include "anisomesh/surface.hh"

namespace anisomesh {

struct UmbilicReport {
  size_t wedges = 0;      ///< index +1/2
  size_t trisectors = 0;  ///< index -1/2
  double index_sum = 0;   ///< sum of the indices of all faces
  /// Full turns of the field along the border loop, counter-clockwise in the plane, and along both sides of
  /// the features; measured independently of the indices, and equal to their sum.
  double border_turning = 0;
  double seconds = 0;
};

/// Finds the umbilics of the piecewise linear tensor field: at most one in a face. [ACDLD03, section 2.4]
/// Reads: uv, tensor2d, or without uv surface_tensor, normal; features. Writes: umbilic, umbilic_position.
/// \throw InvalidInput
UmbilicReport find_umbilics(const SurfaceRef& surface);

}  // namespace anisomesh
