// The diagonal that a quad is drawn with.
#pragma once

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <vector>

namespace anisomesh::detail {

/// 1 if the diagonal from the second corner is the shorter one, else 0. \param quad four indices of positions
inline size_t shorter_diagonal(const std::vector<int>& quad, const std::vector<OpenMesh::Vec3d>& positions) {
  const auto squared = [&](size_t k) {
    return (positions[static_cast<size_t>(quad[k])] - positions[static_cast<size_t>(quad[k + 2])]).sqrnorm();
  };
  return squared(1) < (1 - 1e-9) * squared(0) ? 1 : 0;  // not by rounding
}

}  // namespace anisomesh::detail
