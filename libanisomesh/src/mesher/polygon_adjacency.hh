// Which polygon lies across which side, and the outline of several of them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include "mesher/polygon_judge.hh"

namespace anisomesh::detail {

class PolygonAdjacency {
 public:
  PolygonAdjacency() = default;
  /// Polygons as nodes of a network, counter-clockwise. Only sides that `may_cross`(node, node) allows count.
  PolygonAdjacency(const std::vector<std::vector<int>>& polygons, size_t n_nodes,
                   std::function<bool(int, int)> may_cross);

  /// A polygon that is to change, or has: without corners it is beside nothing.
  void take_out(const std::vector<std::vector<int>>& polygons, int polygon);
  void put_in(const std::vector<std::vector<int>>& polygons, int polygon);

  /// The polygon across the side that begins at corner `side` of a polygon, or -1.
  int neighbor(int polygon, size_t side) const { return neighbors_[static_cast<size_t>(polygon)][side]; }
  /// Whether the nodes are the ends of a side.
  bool are_joined(int a, int b) const;
  /// How many polygons meet at a node.
  int faces_at(int node) const { return faces_at_[static_cast<size_t>(node)]; }
  /// Counts polygons in (by = 1) or out (by = -1).
  void count(const std::vector<int>& polygon, int by) {
    for (const int n : polygon) faces_at_[static_cast<size_t>(n)] += by;
  }
  /// The polygons around one of a polygon's nodes, each beside the one before it; none if a side that may not
  /// be crossed ends there.
  std::vector<int> fan(const std::vector<std::vector<int>>& polygons, int polygon, int node) const;
  /// The corners around polygons each of which lies beside the one before it; loop is 0 if they enclose a
  /// hole or touch themselves. \param may_drop the nodes that they enclose
  RegionCorners around(const std::vector<std::vector<int>>& polygons, const std::vector<int>& path,
                       const NetworkGraph& network, bool may_drop = false) const;

 private:
  std::vector<int> ring_around(const std::vector<std::vector<int>>& polygons,
                               const std::vector<int>& path) const;
  std::vector<int> take_out_enclosed(std::vector<int>& ring) const;
  void forbid_other_sides(RegionCorners& corners, const std::vector<std::vector<int>>& polygons,
                          const std::vector<int>& path) const;

  struct Side {
    int polygon = -1;
    size_t corner = 0;  // where it begins
  };

  std::unordered_map<std::uint64_t, std::array<Side, 2>> sides_;  // by their nodes
  std::vector<std::vector<int>> neighbors_;
  std::vector<int> faces_at_;
  std::function<bool(int, int)> may_cross_;
};

/// Polygons with indices into the corners instead of nodes; nodes that are no corners are left out.
std::vector<std::vector<int>> in_corners(const RegionCorners& corners,
                                         const std::vector<std::vector<int>>& polygons,
                                         const std::vector<int>& path);

}  // namespace anisomesh::detail
