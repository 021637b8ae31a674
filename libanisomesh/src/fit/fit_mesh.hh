// A result as flat arrays, for the fit: its polygons, the triangles they stand for, and who is next to whom.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>
#include <array>
#include <vector>

#include "numerics/bvh.hh"

namespace anisomesh::detail {

/// Polygons begin, begin + 1 ... end - 1.
struct PolygonRange {
  int begin = 0, end = 0;
};

/// What does not change while vertices move.
struct FitMesh {
  explicit FitMesh(const OpenMesh::PolyMesh& mesh);

  int n_vertices = 0;
  std::vector<int> first_corner;  ///< of each polygon, into corners; one more than there are polygons
  std::vector<int> corners;
  std::vector<int> first_around;  ///< of each polygon, into around
  std::vector<int> around;        ///< polygons that share a corner and are reached without crossing a feature
  std::vector<int> first_polygon;  ///< of each vertex, into polygons
  std::vector<int> polygons;       ///< at each vertex, ascending

  struct Side {
    int from = -1, to = -1;
    bool on_curve = false;  ///< a feature or the border
  };
  std::vector<Side> sides;                 ///< of polygons, each once
  std::vector<std::array<int, 2>> beside;  ///< for each side, the polygons at it; -1: none
  std::vector<int> first_side;             ///< of each vertex, into sides_at
  std::vector<int> sides_at;               ///< each vertex, ascending
  std::vector<int> corner_side;  ///< for each of corners, the side to the next corner of its polygon
  /// The side from v to w, if they follow each other on the polygon; -1 otherwise.
  int side(int polygon, int v, int w) const;

  void connect_sides();

  int n_polygons() const { return static_cast<int>(first_corner.size()) - 1; }
  int degree(int polygon) const { return first_corner[size_t(polygon) + 1] - first_corner[size_t(polygon)]; }
  const int* begin(int polygon) const { return corners.data() + first_corner[size_t(polygon)]; }
  const int* end(int polygon) const { return corners.data() + first_corner[size_t(polygon) + 1]; }
};

/// The triangles that the polygons stand for where their vertices are now: split as the ruler splits them.
struct FitTriangles {
  FitTriangles(const FitMesh& mesh, const std::vector<Vec3d>& points);

  std::vector<int> first;  ///< of each polygon; one more than there are polygons
  std::vector<Triangle> corner;
  std::vector<Triangle> side;  ///< of the mesh, from each corner to the next; -1: a diagonal
  std::vector<Vec3d> normal;   ///< unit; zero without area
  std::vector<double> area;
  std::vector<Vec3d> height;  ///< over the side opposite to each corner; huge where it is a diagonal
  std::vector<Box> box;
  std::vector<Vec3d> centre;   ///< of each polygon
  std::vector<double> radius;  ///< of the ball around its centre that holds the polygon
};

}  // namespace anisomesh::detail
