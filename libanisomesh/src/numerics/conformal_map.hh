// Conformal maps of a triangulated disc to the plane.
#pragma once

#include <vector>

#include "numerics/patch.hh"

namespace anisomesh::detail {

/// Free-boundary conformal map by "boundary first flattening" [Sawhney and Crane 2017]: the border keeps its
/// lengths as far as it can, which is the conformal map of least area distortion, and the interior follows
/// harmonically.
///
/// `roundness` in [0, 1] bends the border's curvature from that of the least distorted map (0) to that of a
/// circle (1), still conformally. \throw SolverFailure
std::vector<Vec2d> boundary_first_map(const Patch& patch, const std::vector<TriangleShape>& shapes,
                                      double roundness = 0);

/// Map to the unit disc: the border at the places a conformal map to the disc would give it, the interior
/// with positive weights, so that no triangle flips (Tutte's theorem). \throw SolverFailure
std::vector<Vec2d> disc_map(const Patch& patch, const std::vector<TriangleShape>& shapes);

}  // namespace anisomesh::detail
