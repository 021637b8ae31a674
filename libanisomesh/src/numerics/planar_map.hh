// Is a map of a triangulated disc to the plane one to one, and what to do where it is not.
#pragma once

#include <vector>

#include "numerics/patch.hh"

namespace anisomesh::detail {

/// Triangles whose image is not counter-clockwise, or so thin that rounding may say otherwise; ascending.
std::vector<int> invalid_triangles(const Patch& patch, const std::vector<Vec2d>& map);

/// Whether no two border edges meet except neighbours at their common vertex. With no invalid triangle this
/// makes the whole map one to one: the number of times it covers a point is the winding number of its border.
bool border_is_simple(const Patch& patch, const std::vector<Vec2d>& map);

/// Moves the vertices of invalid triangles, and as few others as it takes, until no triangle is invalid:
/// returns whether that was reached.
bool repair(const Patch& patch, const std::vector<TriangleShape>& shapes, std::vector<Vec2d>& map);

/// Plane area of a triangle, positive where counter-clockwise.
double signed_area(const Patch& patch, const std::vector<Vec2d>& map, size_t triangle);

}  // namespace anisomesh::detail
