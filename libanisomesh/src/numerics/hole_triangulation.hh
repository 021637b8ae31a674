// The triangles that close a loop of edges in space.
#pragma once

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <array>
#include <functional>
#include <vector>

namespace anisomesh::detail {

using OpenMesh::Vec3d;

/// A closed loop, the hole on its left. `beyond[i]` is the third corner of the face across the edge from
/// corner i to the next one.
struct HoleRim {
  std::vector<Vec3d> corner, beyond;
};

/// The triangulation of the loop whose sharpest bend, rim included, is least, and among those the one of
/// least area. [Barequet and Sharir 1995; Liepa 2003] Empty if each has a bend of more than `most_degrees`, a
/// triangle without area or a forbidden chord. Takes time with the third power of the number of corners.
std::vector<std::array<int, 3>> triangulate_hole(const HoleRim& rim, double most_degrees,
                                                 const std::function<bool(int, int)>& forbidden);

}  // namespace anisomesh::detail
