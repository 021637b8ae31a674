// Conformal maps of a patch that are one to one, and what they do to its triangles.
#pragma once

#include <optional>
#include <vector>

#include "anisomesh/flatten.hh"
#include "numerics/patch.hh"
#include "numerics/triangle_jacobian.hh"

namespace anisomesh::detail {

/// The first map that is one to one: the free border, then borders ever more like a circle as long as they
/// cross themselves, then the disc. \throw CannotProcess if there is none; SolverFailure; Cancelled
std::vector<Vec2d> valid_map(const Patch& patch, FlattenReport& report, const Progress& progress);

/// The map with the free border, which distorts areas least, if it is one to one, or is after the repair of a
/// few triangles. \throw SolverFailure
std::optional<std::vector<Vec2d>> free_map(const Patch& patch, FlattenReport& report);

std::vector<TriangleJacobian> jacobians(const Patch& patch, const std::vector<Vec2d>& map);

/// Centres the map on its border, turns its longer axis to u and scales it to the area of the surface.
void normalize(const Patch& patch, std::vector<Vec2d>& map);

/// Area in the plane over area on the surface, around each vertex.
std::vector<double> area_stretches(const Patch& patch, const std::vector<TriangleJacobian>& faces);

/// Fills in the distortions.
void measure(const std::vector<TriangleJacobian>& faces, const std::vector<double>& stretch,
             FlattenReport& report);

}  // namespace anisomesh::detail
