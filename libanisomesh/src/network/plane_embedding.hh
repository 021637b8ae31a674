// The network as a drawing in the parameter plane. [ACDLD03, section 4.2: "no new intersection"]
#pragma once

#include "network/embedding.hh"
#include "network/network_graph.hh"
#include "numerics/point_index.hh"

namespace anisomesh::detail {

/// A change is allowed if the triangles it sweeps over hold no other node: the graph stays planar in (u, v).
class PlaneEmbedding final : public Embedding {
 public:
  explicit PlaneEmbedding(const NetworkGraph& network) : index_(places(network), in_use(network)) {}

  bool straighten(int a, int node, int b) override {
    if (!index_.triangle_is_empty(a, node, b)) return false;
    index_.remove(node);
    return true;
  }
  bool contract(int keep, int gone, const std::vector<int>& others) override {
    for (const int other : others)
      if (!index_.triangle_is_empty(keep, gone, other)) return false;
    index_.remove(gone);
    return true;
  }
  void drop(const std::vector<int>& nodes) override {
    for (const int node : nodes) index_.remove(node);
  }

 private:
  static std::vector<Vec2d> places(const NetworkGraph& network) {
    std::vector<Vec2d> result;
    result.reserve(network.graph.n_nodes());
    for (size_t n = 0; n < network.graph.n_nodes(); ++n)
      result.push_back(network.graph.uv(static_cast<int>(n)));
    return result;
  }
  static std::vector<char> in_use(const NetworkGraph& network) {
    std::vector<char> result(network.graph.n_nodes());
    for (size_t n = 0; n < result.size(); ++n)
      result[n] = network.graph.degree(static_cast<int>(n)) > 0 || network.fixed[n];
    return result;
  }

  PointIndex index_;
};

}  // namespace anisomesh::detail
