// Points and triangles in the plane for the synthetic shapes: regular, or jittered and Delaunay.
#pragma once

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <array>
#include <random>
#include <utility>
#include <vector>

namespace anisomesh::detail {

using OpenMesh::Vec2d;

/// A triangulation of a rectangle or a disc; every triangle is counter-clockwise.
struct PlanarSampling {
  std::vector<Vec2d> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::pair<int, int>> creases;  ///< edges along the crease rays
};

/// Uniform in [0, 1), the same on every platform.
double uniform(std::mt19937& generator);
/// Standard normal, the same on every platform up to the rounding of log and cos.
double gaussian(std::mt19937& generator);

/// (columns + 1) x (rows + 1) points on the rectangle (0, 0), (width, height). The diagonals are mirrored in
/// the middle so that each corner has two triangles.
PlanarSampling regular_rectangle(double width, double height, int columns, int rows);
/// Concentric rings on the unit disc: ring k has spokes * k points, the first of each `spokes`-th on a ray.
PlanarSampling regular_disc(int spokes, int rings, int crease_rays);

/// Moves the points of a regular sampling at random (those of the border along the border, those of creases
/// along the crease) and joins them anew by a constrained Delaunay triangulation.
void make_irregular_rectangle(PlanarSampling& sampling, double width, double height, double spacing,
                              std::mt19937& generator);
void make_irregular_disc(PlanarSampling& sampling, int crease_rays, double spacing, std::mt19937& generator);

/// Replaces the triangles by the Delaunay triangulation of the points, constrained to the creases and to the
/// chain of `border` points. In a source of its own because of CGAL's weight.
void triangulate_delaunay(PlanarSampling& sampling, const std::vector<int>& border);

}  // namespace anisomesh::detail
