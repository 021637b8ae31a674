// Sides of polygons in one place that are not one side. Where the surface touches itself in a point, as where
// reading has duplicated a vertex, sides from there to the same neighbour would be an edge of four polygons
// for whoever puts together what lies in one place. A side past a node that is beside both its ends, as along
// the straight foot of a fin whose two sides lie on each other, would be a T-junction.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "network/network_graph.hh"

namespace anisomesh::detail {

class CoincidentSides {
 public:
  CoincidentSides() = default;
  CoincidentSides(const std::vector<std::vector<int>>& polygons, const NetworkGraph& network);

  /// Whether a side between the nodes would lie on one between other nodes.
  bool lies_on_another(int a, int b) const;
  /// Whether a side between the nodes would run past one that is joined to both.
  bool passes_a_node(int a, int b, const NetworkGraph& network) const;
  /// Whether either is so of a side of the polygon which need not be there: that is no feature and no border.
  bool has_one(const std::vector<int>& polygon, const NetworkGraph& network) const;

 private:
  using Pair = std::array<int, 2>;
  Pair place_of(int a, int b) const;

  std::vector<Pair> joined_;  // both ways, sorted
  std::vector<int> place_;    // of each node, the first node in the same place; empty where each has its own
  std::map<Pair, std::vector<Pair>> sides_;  // by place, the lower first; those with an end in a shared place
};

}  // namespace anisomesh::detail
