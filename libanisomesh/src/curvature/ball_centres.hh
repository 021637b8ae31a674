// Where balls are many times larger than faces, only some vertices get a ball of their own.
#pragma once

#include <vector>

#include "surface/surface_arrays.hh"

namespace anisomesh::detail {

/// The vertices that get a ball. A ball's average hardly changes over a fraction of its radius, so a vertex
/// within `reach` of such a centre, on the same side of all walls, can do with interpolation. Where the mesh
/// is coarse against the reach every vertex is a centre; so is each vertex at a wall, which covers no other.
/// \param reach of each vertex
std::vector<int> choose_centres(const SurfaceArrays& surface, const std::vector<double>& reach);

}  // namespace anisomesh::detail
