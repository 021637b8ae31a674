// The smallest sphere around points.
#pragma once

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <vector>

namespace anisomesh::detail {

/// The diameter of the smallest sphere that encloses the points, in their unit, but for rounding. The same
/// bits in whichever order they come. \pre finite, not all in one place
double enclosing_diameter(const std::vector<OpenMesh::Vec3d>& points);

}  // namespace anisomesh::detail
