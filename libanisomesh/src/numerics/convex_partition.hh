// Convex decomposition of a simple polygon. [ACDLD03, section 4.3; Greene 1983]
#pragma once

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <vector>

namespace anisomesh::detail {

/// Cuts a simple counter-clockwise polygon into convex ones with as few cuts as possible: Greene's dynamic
/// programming, as CGAL has it, and beyond `exact_limit` corners Hertel and Mehlhorn's approximation.
/// \return the pieces as indices into `polygon`, counter-clockwise; empty if the polygon is too degenerate
std::vector<std::vector<int>> convex_partition(const std::vector<OpenMesh::Vec2d>& polygon,
                                               size_t exact_limit = 30);

}  // namespace anisomesh::detail
