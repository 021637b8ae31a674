// Polygons for one region between the edges of the network, as near to the surface as is asked for.
#pragma once

#include <array>
#include <vector>

#include "mesher/conforming.hh"
#include "mesher/polygon_judge.hh"

namespace anisomesh::detail {

/// A point of the surface in a region: the polygons should be near it.
struct Probe {
  Vec2d uv;
  Vec3d position;
  SurfacePoint point;
  int triangle = -1;  ///< of the region, and where in it; on the surface, where uv comes from there
  Vec3d barycentric{0, 0, 0};
};

struct Region {
  RegionCorners corners;                      ///< those on its border, then its isotropic samples
  bool simple = true;                         ///< the border is one loop, in order
  size_t isotropic = 0;                       ///< how many of the corners are isotropic samples
  std::vector<std::array<int, 3>> triangles;  ///< of the corners on its border, by index
  std::vector<std::array<int, 2>> walls;      ///< corners at the ends of edges that end inside
  double share = 1;                           ///< of the tolerances that holds here
  bool at_feature = false;                    ///< only where there is no parameter plane
  bool holds_samples = false;                 ///< the triangles are of the isotropic samples as well
  std::vector<Probe> probes;
};

struct RegionOptions {
  PartitionOptions partition;
  double cell_tolerance = 0;  ///< model units, see MeshOptions; infinite: keep all samples and add none
  bool flip_edges = true;
  double feature_cell_tolerance = 0;  ///< no more than that at features, in the surface's own domain
};

struct RegionPolygons {
  std::vector<std::vector<int>> polygons;  ///< indices of corners; beyond those given, the added ones
  std::vector<SurfacePoint> added;
  bool convex = true;  ///< the region was so from the start
};

RegionPolygons mesh_region(Region& region, const PolygonJudge& judge, const RegionOptions& options);

}  // namespace anisomesh::detail
