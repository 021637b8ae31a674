// Degenerate points of the tensor field on the surface itself.
#pragma once

#include <vector>

#include "field/surface_field.hh"

namespace anisomesh::detail {

struct SurfaceUmbilics {
  std::vector<int> doubled_index;  ///< of each face
  std::vector<Vec3d> position;     ///< barycentric; (0, 0, 0) where the index is 0
  /// Full turns of the field along the borders and both sides of the features, the total curvature of the
  /// surface included: what the indices add up to.
  double turning = 0;
};

/// The index of the field in each triangle: the turning of the deviator around it, from vertex to vertex by
/// the shortest rotations of the normals, and the rotation that these make on the way around. The latter is
/// known up to full turns, which are taken from the angles of the triangles, those around a vertex scaled to
/// a full turn; so the indices add up to the Euler characteristic of a closed surface without features,
/// exactly, and whatever its shape. [Knoeppel, Crane, Pinkall and Schroeder 2013, section 6]
SurfaceUmbilics umbilics_on_surface(const SurfaceRef& surface, const SurfaceField& field);

}  // namespace anisomesh::detail
