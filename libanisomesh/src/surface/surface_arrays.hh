// A surface as flat arrays, for stages that visit every element many times.
#pragma once

#include <array>
#include <vector>

#include "anisomesh/surface.hh"

namespace anisomesh::detail {

/// Corners, neighbours and stars of the faces. Feature edges are walls here, like the border: no neighbour
/// lies beyond them.
struct SurfaceArrays {
  explicit SurfaceArrays(const SurfaceRef& surface);

  const std::vector<Vec3d>& points;
  std::vector<std::array<int, 3>> corners;     ///< of each face, in the order of SurfaceRef::corners()
  std::vector<std::array<int, 3>> neighbours;  ///< face across the edge from corner i to corner i + 1, or -1
  std::vector<int> star_begin;  ///< of each vertex, into star; one more than there are vertices
  std::vector<int> star;        ///< faces around each vertex, ascending
  std::vector<char> at_wall;    ///< whether the vertex is on the border or on a feature

  int n_vertices() const { return static_cast<int>(points.size()); }
  int n_faces() const { return static_cast<int>(corners.size()); }
  const int* star_of(int vertex) const { return star.data() + star_begin[static_cast<size_t>(vertex)]; }
  int star_size(int vertex) const {
    return star_begin[static_cast<size_t>(vertex) + 1] - star_begin[static_cast<size_t>(vertex)];
  }
  const Vec3d& corner_point(int face, int corner) const {
    return points[static_cast<size_t>(corners[static_cast<size_t>(face)][static_cast<size_t>(corner)])];
  }
  /// Which corner of the face the vertex is.
  int corner_of(int face, int vertex) const {
    const auto& c = corners[static_cast<size_t>(face)];
    return c[0] == vertex ? 0 : c[1] == vertex ? 1 : 2;
  }
};

}  // namespace anisomesh::detail
