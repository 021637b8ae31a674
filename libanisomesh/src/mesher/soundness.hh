// What every result must be: manifold, of the input's topology, and of polygons that are convex, not folded
// and not without area. Checked on the polygons themselves; repaired where that is possible.
#pragma once

#include <string>
#include <vector>

#include "compare/compare_parts.hh"
#include "compare/fold_limits.hh"
#include "mesher/coincident_sides.hh"
#include "mesher/polygon_adjacency.hh"
#include "mesher/polygon_judge.hh"
#include "network/network_graph.hh"

namespace anisomesh::detail {

class Soundness {
 public:
  Soundness(const SurfaceRef& surface, const SurfaceLocator& locator, const PolygonJudge& judge, bool convex)
      : surface_(surface), locator_(locator), judge_(judge), convex_(convex) {}

  /// Partitions anew around polygons that are unsound or touch themselves or each other. \return the unsound
  /// that are left \param may_drop vertices, too, where nothing else helps; otherwise only of polygons that
  /// are very thin
  std::vector<std::vector<int>> repair(std::vector<std::vector<int>>& polygons, const NetworkGraph& network,
                                       int max_degree, bool may_drop);
  /// Those that repair() has left with a side that lies on one between other nodes, and need not.
  std::vector<std::vector<int>> coincident(const std::vector<std::vector<int>>& polygons,
                                           const NetworkGraph& network) const;
  /// Those that compare() calls folded, nearest points being sought in all of the surface, and that are no
  /// triangles of the input.
  std::vector<std::vector<int>> folded(const std::vector<std::vector<int>>& polygons,
                                       const NetworkGraph& network, const ReferenceSurface& reference) const;
  /// \throw CannotProcess if the polygons are not a manifold with the input's Euler characteristic and border
  void require_topology(const std::vector<std::vector<int>>& polygons) const;

 private:
  bool is_of_input(const std::vector<int>& polygon, const NetworkGraph& network) const;
  bool is_divided_of_input(const std::vector<int>& polygon, const NetworkGraph& network) const;
  bool is_sound(const std::vector<int>& polygon, const NetworkGraph& network) const;
  bool is_folded(const std::vector<int>& polygon, const NetworkGraph& network, const Vec3d& normal) const;
  struct Place {
    Vec3d point;
    OpenMesh::FaceHandle below;  ///< of the input
    double distance;             ///< to that face
  };
  Place place_at(const Vec2d& uv, const Vec3d& point, const std::vector<OpenMesh::FaceHandle>& starts) const;
  std::vector<Place> places_in(const std::vector<int>& polygon, const NetworkGraph& network) const;
  static FoldReach reach_of(const std::vector<int>& polygon, const std::vector<Place>& places,
                            const NetworkGraph& network);
  bool is_against(const Place& place, const Vec3d& normal, const FoldReach& reach) const;
  std::vector<int> unsound(const std::vector<std::vector<int>>& polygons, const NetworkGraph& network,
                           bool or_touching) const;
  const std::vector<int>* cheapest(const std::vector<std::vector<int>>& paths,
                                   const PolygonAdjacency& adjacency,
                                   const std::vector<std::vector<int>>& polygons, const NetworkGraph& network,
                                   int max_degree, bool may_drop,
                                   std::vector<std::vector<int>>& best_pieces) const;
  bool repair_one(int polygon, std::vector<std::vector<int>>& polygons, PolygonAdjacency& adjacency,
                  const NetworkGraph& network, int max_degree, bool may_drop) const;

  const SurfaceRef& surface_;
  const SurfaceLocator& locator_;
  const PolygonJudge& judge_;
  bool convex_;
  CoincidentSides coincident_;  // of the polygons that are being repaired
};

}  // namespace anisomesh::detail
