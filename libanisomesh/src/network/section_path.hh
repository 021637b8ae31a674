// From one surface point to another, straight ahead, edge after edge.
#pragma once

#include <array>
#include <vector>

#include "anisomesh/surface.hh"
#include "surface/surface_arrays.hh"

namespace anisomesh::detail {

/// Where a path crosses an edge of the mesh: between two vertices, `t` from the one of lower index.
struct EdgeCrossing {
  std::array<int, 2> vertex{-1, -1};  ///< ascending
  double t = 0;                       ///< in (0, 1)
};

/// A surface point by what it lies on: a vertex, an edge or the inside of a face.
struct Place {
  int face = -1;      ///< one that holds it
  int vertex = -1;    ///< the vertex it is, if it is one
  EdgeCrossing edge;  ///< the edge it is on, if it is on one
  Vec3d barycentric{0, 0, 0};
  bool on_edge() const { return edge.vertex[0] >= 0; }
};

/// Barycentric coordinates below 1e-6 are taken for zero.
Place place_of(const SurfaceArrays& mesh, const SurfacePoint& point);

/// The faces that hold a place, in the order they are found around it. Features are no wall here.
std::vector<int> faces_at(const SurfaceArrays& mesh, const Place& place);

/// A face that holds both places, or -1.
int common_face(const SurfaceArrays& mesh, const Place& a, const Place& b);

struct SectionPath {
  bool found = false;
  std::vector<EdgeCrossing> crossings;
  std::vector<int> faces;  ///< one more than there are crossings
};

/// The section of the surface with the plane through both points and along the normal, or where that leads
/// elsewhere the way through the fewest triangles. Never across a feature or the border.
SectionPath section_path(const SurfaceArrays& mesh, const Place& from, const Place& to);

}  // namespace anisomesh::detail
