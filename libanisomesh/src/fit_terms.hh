// What one pass of the fit minimizes.
#pragma once

#include <vector>

#include "anisomesh/fit.hh"
#include "fit_matching.hh"
#include "fit_system.hh"

namespace anisomesh::detail {

/// The squared distances of the pairs, the heights of the triangles' sides against the input's normals, and
/// the turn of the polygons' sides away from the principal directions.
/// \param energy squared distances, both ways, that the turn is weighed against
void add_surface_terms(const FitMesh& mesh, const FitTriangles& triangles, const FitInput& input,
                       const FitPairs& pairs, const std::vector<Vec3d>& points, const FitOptions& options,
                       double energy, FitSystem& system);

/// How far quads leave their plane.
void add_planarity(const FitMesh& mesh, const std::vector<Vec3d>& points, double weight, double total_area,
                   FitSystem& system);

}  // namespace anisomesh::detail
