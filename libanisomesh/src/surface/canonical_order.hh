// A numbering of a surface that follows its shape, not how its elements happen to be numbered.
#pragma once

#include <vector>

#include "anisomesh/surface.hh"

namespace anisomesh::detail {

/// For each number in the new order, what has it in the mesh.
struct CanonicalOrder {
  std::vector<OpenMesh::VertexHandle> vertices;
  std::vector<OpenMesh::HalfedgeHandle> edges;  ///< the halfedge that comes first
  std::vector<OpenMesh::HalfedgeHandle> faces;  ///< the halfedge that points to the first corner
};

/// Part by part, each breadth first from the side that is farthest from its middle; where several are, from
/// the one around which the surface is larger, or longer, or in the end from the one around which it differs
/// first on the way. Only what some rotation of the surface takes to another place is told apart by its
/// number.
CanonicalOrder canonical_order(const SurfaceRef& surface);

}  // namespace anisomesh::detail
