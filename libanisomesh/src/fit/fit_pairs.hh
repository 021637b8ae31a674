// Samples of either mesh with the places of the other that they stand beside.
#pragma once

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <vector>

namespace anisomesh::detail {

using OpenMesh::Vec3d;

/// Squared distance of one sample to the other mesh, as the fit sees it: it changes by
/// weight * (direction | step of the place in the triangle).
struct FitPair {
  int triangle = -1;           ///< of the result
  int face = -1;               ///< of the input
  Vec3d barycentric{0, 0, 0};  ///< in the triangle
  Vec3d direction{0, 0, 0};    ///< unit, from the result to the input
  double distance = 0;         ///< along `direction`, >= 0
  double weight = 0;           ///< share of the area of the mesh it was sampled on
};

/// Pairs of both ways, and which of them each triangle of the result has.
struct FitPairs {
  std::vector<FitPair> pair;    ///< those of the input's samples first
  size_t n_input = 0;           ///< so many
  std::vector<int> first;       ///< of each triangle, into of_input; one more than there are triangles
  std::vector<int> of_input;    ///< pairs of the input by triangle, ascending
  std::vector<int> first_own;   ///< of each triangle, its own samples: pairs n_input + first_own[t] ...
  double squared = 0;           ///< sum of weight * distance^2; each way's weights add up to 1
  double mean = 0, weight = 0;  ///< sums of weight * distance and weight

  /// Sorts the pairs of the input by triangle.
  void sort_input(size_t n_triangles);
  void add_up();

  /// Calls visit(pair) for all pairs of a triangle.
  template <class Visit>
  void for_each(size_t triangle, Visit visit) const {
    for (int i = first[triangle]; i < first[triangle + 1]; ++i)
      visit(pair[static_cast<size_t>(of_input[static_cast<size_t>(i)])]);
    for (int i = first_own[triangle]; i < first_own[triangle + 1]; ++i)
      visit(pair[n_input + static_cast<size_t>(i)]);
  }
};

}  // namespace anisomesh::detail
