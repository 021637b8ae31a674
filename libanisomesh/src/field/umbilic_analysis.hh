// What the piecewise linear tensor field does around a degenerate point of one triangle.
#pragma once

#include <array>

#include "anisomesh/surface.hh"

namespace anisomesh::detail {

/// Twice the index of a linear tensor field with these deviators at the corners (counter-clockwise): 1 around
/// a wedge, -1 around a trisector, 0 where there is no degenerate point inside. Decided edge by edge, so that
/// a zero on an edge or a vertex counts in exactly one of the triangles that share it.
int doubled_index(const std::array<Vec2d, 3>& deviators);

/// The part of it that the edge from a to b brings in; that from b to a brings the opposite.
int doubled_index_of_edge(const Vec2d& a, const Vec2d& b);

/// Barycentric coordinates of the zero of the linear field, clamped to the triangle.
Vec3d degenerate_point(const std::array<Vec2d, 3>& deviators);

}  // namespace anisomesh::detail
