// Closing small holes before anything else is done.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <vector>

#include "anisomesh/surface.hh"

namespace anisomesh {

struct FillOptions {
  size_t max_edges = 0;   ///< border loops of up to so many edges are closed; 0: none; 0 or 3 to 1000
  void validate() const;  ///< \throw InvalidOption
};

struct FillReport {
  size_t closed = 0;           ///< holes
  size_t triangles = 0;        ///< added
  size_t joined_vertices = 0;  ///< of the input, at one place, made one because a hole touched itself there
  /// Border loops that are left: longer than asked for; closing them would fold the surface onto itself;
  /// it would make an edge of more than two faces, or the loop crosses itself.
  size_t left_long = 0, left_folding = 0, left_non_manifold = 0;
  std::vector<int> vertex_of;  ///< vertex of the result for each vertex of the input
  double seconds = 0;
};

/// A copy of the surface in which the small holes are closed with triangles of the vertices that are there:
/// those that bend least, then those of least area. [Barequet and Sharir 1995; Liepa 2003]
///
/// Holes that touch each other at a vertex, where read_surface() has cut the surface open, are told apart and
/// closed one by one. No edge gets more than two faces and nothing is folded; what cannot be closed so is
/// left. Faces keep their numbers, new ones follow. Reads: points, edge feature status, which the copy keeps;
/// it has no other property. \throw InvalidOption
OpenMesh::TriMesh fill_holes(const SurfaceRef& surface, const FillOptions& options,
                             FillReport* report = nullptr);

}  // namespace anisomesh
