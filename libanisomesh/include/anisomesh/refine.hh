// Dividing long, thin triangles, so that what is known at vertices is known between them too.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <vector>

#include "anisomesh/surface.hh"

namespace anisomesh {

struct RefineOptions {
  /// Triangles are divided until their edges are no longer, fraction of the extent; 0: none; [0, 1].
  double max_edge_fraction = 0.06;
  double min_aspect = 4;     ///< only those so many times as long as they are high; >= 1
  size_t max_triangles = 0;  ///< there will be no more; 0: twice as many as there are, but at least 20,000
  void validate() const;     ///< \throw InvalidOption
};

struct RefineReport {
  size_t divided = 0;          ///< edges; each adds a vertex
  std::vector<int> parent_of;  ///< for each face of the result the face of the input that it lies in
  double seconds = 0;
};

/// A copy of the surface, of the same shape, in which long, thin triangles are divided: their edges are
/// halved, the longest first, with the triangles on both sides.
///
/// Parts from CAD have triangles as long as the part: curvature is estimated at vertices and linear between
/// them, so that what a rounding has at one end of such a triangle goes all the way to the other. [Rivara
/// 1984] Well-shaped triangles stay as they are, however large: they sample a smooth shape, and flat pieces
/// of them would not. Vertices keep their numbers, new ones follow. Reads: points, edge feature status,
/// `feature_tolerance`, `chart`, which the copy has too; it has no other property. \throw InvalidOption
OpenMesh::TriMesh refine(const SurfaceRef& surface, const RefineOptions& options = {},
                         RefineReport* report = nullptr);

}  // namespace anisomesh
