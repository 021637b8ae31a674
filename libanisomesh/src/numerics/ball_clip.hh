// Segments and triangles clipped to a ball around the origin, exactly.
#pragma once

#include <OpenMesh/Core/Geometry/VectorT.hh>

namespace anisomesh::detail {

using OpenMesh::Vec3d;

/// Length of the part of the segment ab inside the ball of the given radius around the origin.
double length_in_ball(const Vec3d& a, const Vec3d& b, double radius);

/// Area of the part of the triangle abc inside the ball of the given radius around the origin.
double area_in_ball(const Vec3d& a, const Vec3d& b, const Vec3d& c, double radius);

/// Whether some point of the segment ab is nearer to the origin than the radius.
bool meets_ball(const Vec3d& a, const Vec3d& b, double radius);

}  // namespace anisomesh::detail
