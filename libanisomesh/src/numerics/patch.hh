// A disc of triangles as plain arrays, and the angles and cotangents of its triangles.
#pragma once

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <array>
#include <vector>

namespace anisomesh::detail {

using OpenMesh::Vec2d;
using OpenMesh::Vec3d;

/// A triangulated disc.
struct Patch {
  std::vector<Vec3d> points;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from outside
  std::vector<int> border;                    ///< the loop, with the surface on its left
  Vec3d origin{0, 0, 0};                      ///< of the points, for messages
};

/// What flattening needs of one triangle: nothing but its three edge lengths go in.
struct TriangleShape {
  std::array<double, 3> angle;      ///< at corner i, radians
  std::array<double, 3> cotangent;  ///< of that angle
  double area = 0;
};

/// Shapes of all triangles. A triangle flatter than about `thickness` (height over longest edge) is counted
/// as one with slightly longer short edges, so that cotangents stay finite: an intrinsic "mollification"
/// after Sharp and Crane (A Laplacian for Nonmanifold Triangle Meshes, 2020), here per triangle.
std::vector<TriangleShape> triangle_shapes(const Patch& patch, double thickness = 1e-5);

}  // namespace anisomesh::detail
