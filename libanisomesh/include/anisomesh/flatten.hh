// Conformal parameterization of a disc, and the curvature tensor carried into the plane.
#pragma once

#include "anisomesh/progress.hh"
#include "anisomesh/surface.hh"

namespace anisomesh {

struct FlattenReport {
  double mean_conformal_distortion =
      1;  ///< area-weighted mean of the ratio of singular values; 1 is conformal
  double max_conformal_distortion = 1;
  double min_area_stretch = 1, max_area_stretch = 1;  ///< over the vertices
  bool free_boundary = true;      ///< false if the border had to be mapped to a circle to get a valid map
  double border_roundness = 0;    ///< 0: the border keeps its lengths as far as a conformal map can; above 0:
                                  ///< bent that far towards a circle, since it crossed itself; 1: a circle
  size_t repaired_triangles = 0;  ///< flipped by the free-boundary solution, then repaired
  double seconds = 0;
};

/// Maps a disc-like patch to the plane, conformally as far as possible, with no flipped triangle and no
/// overlap. [ACDLD03, section 2.2; Sawhney and Crane, Boundary First Flattening, 2017]
///
/// Reads: points, tensor, normal. Writes: uv, area_stretch, tensor2d (properties.hh), and the same uv as
/// OpenMesh's 2D texture coordinates where the mesh has them requested. \pre one component with one border
/// loop \throw CannotProcess if the patch is no disc or no valid map was found; SolverFailure; InvalidInput;
/// Cancelled
FlattenReport flatten(const SurfaceRef& surface, const Progress& progress = {});

/// Whether flatten() has run on the mesh: the stages after it then work in the plane, otherwise on the
/// surface.
bool is_flattened(const SurfaceRef& surface);

/// Takes the results of flatten() off the mesh (uv, area_stretch, tensor2d), so that the stages after it work
/// on the surface. Texture coordinates stay.
void unflatten(const SurfaceRef& surface);

}  // namespace anisomesh
