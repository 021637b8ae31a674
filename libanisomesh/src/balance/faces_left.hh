// How many faces the balance leaves.
#pragma once

#include <algorithm>
#include <cstddef>

namespace anisomesh::detail {

/// The balance makes quads of triangles, until there are hardly more faces than this for each vertex: on a
/// closed surface of quads alone there is one for each, and one more for each below zero of the Euler
/// characteristic.
constexpr double kFacesLeft = 1.1;

inline size_t faces_left(size_t faces, size_t vertices, double euler) {
  const double quads = std::max(0.0, static_cast<double>(vertices) - euler);
  return std::min(faces, static_cast<size_t>(kFacesLeft * quads));
}

}  // namespace anisomesh::detail
