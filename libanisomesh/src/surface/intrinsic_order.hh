// Orders that follow the shape of a surface, not how its elements are numbered.
#pragma once

#include <array>
#include <vector>

#include "surface/rounding.hh"
#include "surface/surface_arrays.hh"

namespace anisomesh::detail {

/// Indices by the first of three measures, where these are equal by the next, and where all are by the index.
using Measures = std::array<double, 3>;
std::vector<int> intrinsic_order(const std::vector<Measures>& measures);

/// How far places are from their weighted mean: tells congruent parts of a surface apart.
std::vector<double> distances_from_middle(const std::vector<Vec3d>& places,
                                          const std::vector<double>& weights);

/// Vertices by the area of the faces around them, then by the squared lengths of their edges.
std::vector<int> intrinsic_vertex_order(const SurfaceArrays& surface);

}  // namespace anisomesh::detail
