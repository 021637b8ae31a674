// What one pass of the fit minimizes.
#pragma once

#include <array>
#include <vector>

#include "anisomesh/fit.hh"
#include "fit/fit_matching.hh"
#include "fit/fit_system.hh"

namespace anisomesh::detail {

/// What the pairs of one triangle add: a quadratic form of the steps of its three corners.
struct TriangleForm {
  std::array<Vec6d, 6> block;  ///< corners (0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)
  std::array<Vec3d, 3> right;
  Vec6d normals;                ///< sum of weight * n n^T
  Vec3d normal_sum{0, 0, 0};    ///< sum of weight * n
  std::array<Vec6d, 3> tensor;  ///< curvature at side k, from corner k to k + 1
  std::array<double, 3> side_weight{};
  double weight = 0;

  TriangleForm();
  void add(const FitPair& pair, const FitInput& input);
  /// \param factor of each side
  void add_heights(const std::array<double, 3>& factor, const std::array<Vec3d, 3>& place);
};

/// The squared distances of the pairs, the heights of the triangles' sides against the input's normals, and
/// the damping.
void sum_forms(const FitTriangles& triangles, const FitInput& input, const FitPairs& pairs,
               const std::vector<Vec3d>& points, const FitOptions& options, std::vector<TriangleForm>& forms);

/// The forms of all triangles, how far quads leave their plane, and the turn of the polygons' sides away from
/// the principal directions. \param energy squared distances, both ways, that the turn is weighed against
void add_surface_terms(const FitMesh& mesh, const FitTriangles& triangles, const FitInput& input,
                       const std::vector<TriangleForm>& forms, const std::vector<Vec3d>& points,
                       const FitOptions& options, double energy, FitSystem& system);

}  // namespace anisomesh::detail
