// What the piecewise linear tensor field does around a degenerate point of one triangle.
#pragma once

#include <array>

#include "anisomesh/lines.hh"

namespace anisomesh::detail {

/// Twice the index of a linear tensor field with these deviators at the corners (counter-clockwise): 1 around
/// a wedge, -1 around a trisector, 0 where there is no degenerate point inside. Decided edge by edge, so that
/// a zero on an edge or a vertex counts in exactly one of the triangles that share it.
int doubled_index(const std::array<Vec2d, 3>& deviators);

/// The part of it that the edge from a to b brings in; that from b to a brings the opposite.
int doubled_index_of_edge(const Vec2d& a, const Vec2d& b);

/// Barycentric coordinates of the zero of the linear field, clamped to the triangle.
Vec3d degenerate_point(const std::array<Vec2d, 3>& deviators);

/// Directions in the plane in which lines of one kind leave a degenerate point straight: three from a
/// trisector, one from a wedge.
struct Separatrices {
  int count = 0;
  std::array<double, 3> angle{};  ///< radians, counter-clockwise from the u axis, ascending
};

/// The rays of lines of `kind` at the degenerate point of the triangle with these corners in the plane and
/// tensors (uu, uv, vv) at them. They are the real roots of a cubic in the tangent of the angle; each root is
/// a ray of max lines one way and of min lines the other. Of a wedge whose cubic has three roots the middle
/// ray is given. [Delmarcelle and Hesselink 1994]
Separatrices separatrices(const std::array<Vec2d, 3>& corners, const std::array<Vec3d, 3>& tensors,
                          LineKind kind);

}  // namespace anisomesh::detail
