// Vertices off the surface: the lowest error that a mesh of this connectivity can have.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>

#include "anisomesh/progress.hh"
#include "anisomesh/surface.hh"

namespace anisomesh {

struct FitOptions {
  bool enabled = true;  ///< remesh() fits only then; fit_vertices() does not look at it
  int passes = 4;  ///< matched and solved at most so often, three quarters as often after a balance; >= 1
  /// Weight of the normals: the squared height of an edge against the surface's normal, relative to the
  /// squared distance, more where a triangle is small or the edge short beside it; >= 0
  double normal_weight = 0.012;
  double planarity_weight = 0.01;  ///< of the squared height of a quad's corners over their plane; >= 0
  /// Of the squared sine of the angle from a side to the nearer principal direction, relative to the
  /// square of the mean distance there is, and up to 2.75 times that where the result has over a fifth as
  /// many vertices as the input; >= 0
  double alignment_weight = 30;
  double damping = 0.02;  ///< of the squared step, which is what holds vertices of flat places; > 0
  void validate() const;  ///< \throw InvalidOption
};

struct FitReport {
  /// Two-sided rms distance by the matching, fraction of the bounding box diagonal.
  double rms_before = 0, rms_after = 0;
  int passes = 0;
  size_t moved = 0;  ///< vertices
  size_t held = 0;   ///< vertices held back in some pass, as a polygon at them would have been unsound
  double seconds = 0;
};

/// Moves the vertices of a result off the surface to where the squared distance between the two is least,
/// with the connectivity held. [ACDLD03, section 5, names it as what is missing] Reads: points, edge feature
/// status, tensor and follow where they are there; of `result` origin, source_face, source_barycentric, edge
/// feature status. Writes: the points of `result`, never to a larger rms. \pre `result` was built by
/// build_polygons() from `surface` \throw InvalidOption, InvalidInput, SolverFailure, Cancelled
FitReport fit_vertices(const SurfaceRef& surface, OpenMesh::PolyMesh& result, const FitOptions& options = {},
                       const Progress& progress = {});

}  // namespace anisomesh
