// Orders that follow the shape of a surface, not how its elements are numbered.
#pragma once

#include <array>
#include <vector>

#include "surface_arrays.hh"

namespace anisomesh::detail {

/// What is compared is rounded to so much of its mean first, so that what is the same but for rounding counts
/// as the same.
constexpr double kTie = 1e-6;

/// Indices by the first of two measures, where these are equal by the second, and where these are too by the
/// index.
std::vector<int> intrinsic_order(const std::vector<std::array<double, 2>>& measures);

/// Vertices by the area of the faces around them, then by the squared lengths of their edges.
std::vector<int> intrinsic_vertex_order(const SurfaceArrays& surface);

}  // namespace anisomesh::detail
