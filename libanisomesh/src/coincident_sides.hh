// Sides of polygons in one place that are not one side. Where the surface touches itself in a point, as where
// reading has duplicated a vertex, sides from there to the same neighbour would be an edge of four polygons
// for whoever puts together what lies in one place.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "network_graph.hh"

namespace anisomesh::detail {

class CoincidentSides {
 public:
  CoincidentSides() = default;
  CoincidentSides(const std::vector<std::vector<int>>& polygons, const NetworkGraph& network);

  /// Whether a side between the nodes would lie on one between other nodes.
  bool lies_on_another(int a, int b) const;
  /// Whether that is so of a side of the polygon which need not be there: that is no feature and no border.
  bool has_one(const std::vector<int>& polygon, const NetworkGraph& network) const;

 private:
  using Pair = std::array<int, 2>;
  Pair place_of(int a, int b) const;

  std::vector<int> place_;  // of each node, the first node in the same place; empty where each has its own
  std::map<Pair, std::vector<Pair>> sides_;  // by place, the lower first; those with an end in a shared place
};

}  // namespace anisomesh::detail
