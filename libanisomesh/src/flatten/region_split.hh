// One region of a surface made two.
#pragma once

#include <vector>

#include "flatten/chart_patch.hh"

namespace anisomesh::detail {

/// What splitting needs to know of the faces.
struct FaceShapes {
  explicit FaceShapes(const SurfaceRef& surface);
  std::vector<Vec3d> centre, normal;  ///< normals are smooth ones, so that noise is no crease
  std::vector<double> area;
};

/// Two parts that grow from seeds as far from each other as can be, until they meet; creases are far away, so
/// that they meet there where they can. Features are not crossed. A part that is not connected is several.
/// \pre more than one face
std::vector<Region> split_region(const SurfaceRef& surface, const FaceSides& sides, const FaceShapes& shapes,
                                 const Region& region, double crease_weight);

/// The parts of some faces that are connected without crossing features, by their smallest face.
std::vector<Region> connected_regions(const FaceSides& sides, const std::vector<int>& faces);

}  // namespace anisomesh::detail
