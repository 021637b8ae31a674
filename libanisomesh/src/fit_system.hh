// The linear system of one pass of the fit.
#pragma once

#include <vector>

#include "anisomesh/fit.hh"
#include "fit_matching.hh"

namespace anisomesh::detail {

/// Steps of all vertices that lower the sum of squared distances most, if each pair stays as it is; zero for
/// vertices that are not free.
std::vector<Vec3d> solve_fit(const FitMesh& mesh, const FitTriangles& triangles,
                             const std::vector<FitPair>& pairs, const std::vector<Vec3d>& points,
                             const std::vector<char>& free, const FitOptions& options);

}  // namespace anisomesh::detail
