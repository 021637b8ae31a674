// Borders of the surface that lie on one another, as the two sides of a slit do: each is straightened and met
// by lines on its own, so that a vertex of the one would lie inside an edge of the other.
#pragma once

#include <array>
#include <map>
#include <set>
#include <vector>

#include "mesher/conforming.hh"
#include "network/network_graph.hh"

namespace anisomesh::detail {

class SlitSeams {
 public:
  explicit SlitSeams(const SurfaceRef& surface);

  /// Puts the vertices of polygons on one side into those on the others, too, at the very same places.
  /// Polygons that get too many corners are parted. Nodes are added to the network.
  void zip(std::vector<std::vector<int>>& polygons, NetworkGraph& network, const SurfaceNormals& normals,
           const PolygonJudge& judge, const PartitionOptions& options) const;

 private:
  /// A place on the border: on a halfedge, from 0 at its beginning to 1 at its end.
  struct Place {
    int halfedge = -1;
    double along = 0;
  };
  using Key = std::array<double, 3>;
  struct Wanted;

  Key key_of(OpenMesh::VertexHandle v) const;
  int next(int halfedge) const;
  Place place_of(const SurfacePoint& point) const;
  double along_seam(const Place& place) const;
  Wanted wanted(const std::vector<std::vector<int>>& polygons, NetworkGraph& network) const;
  std::vector<int> between(const Place& from, const Place& to, const Wanted& wanted, NetworkGraph& network,
                           const SurfaceNormals& normals) const;
  int add_node(const SurfacePoint& point, const Vec3d& position, NetworkGraph& network,
               const SurfaceNormals& normals) const;
  SurfacePoint point_at(int halfedge, double along) const;

  const SurfaceRef& surface_;
  size_t seams_ = 0;          // edges of the border in one place
  std::vector<int> seam_of_;  // of each halfedge with a face; -1
  std::set<Key> ends_;        // of seams
};

}  // namespace anisomesh::detail
