// A straight-line graph in the plane that is edited while it is decimated: nodes keep their index for good,
// edges are linked into a list at each of their two nodes.
#pragma once

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <array>
#include <cstddef>
#include <vector>

namespace anisomesh::detail {

class PlanarGraph {
 public:
  struct Edge {
    std::array<int, 2> node;
    int kind;  ///< what the caller says it is; carried along when an edge is split or replaced
    int tag;   ///< which input it came from; carried along too
    std::array<int, 2> next{-1, -1};
    bool alive = true;
  };

  int add_node(const OpenMesh::Vec2d& uv) {
    uv_.push_back(uv);
    first_.push_back(-1);
    degree_.push_back(0);
    return static_cast<int>(uv_.size()) - 1;
  }
  int add_edge(int a, int b, int kind, int tag) {
    const int edge = static_cast<int>(edges_.size());
    edges_.push_back({{a, b}, kind, tag, {first_[at(a)], first_[at(b)]}, true});
    first_[at(a)] = first_[at(b)] = edge;
    ++degree_[at(a)];
    ++degree_[at(b)];
    return edge;
  }
  void remove_edge(int edge) {
    for (const int n : edges_[at(edge)].node) unlink(n, edge);
    edges_[at(edge)].alive = false;
  }
  /// Puts `node` into an edge; its two halves have the edge's kind and tag.
  void split_edge(int edge, int node) {
    const Edge old = edges_[at(edge)];
    remove_edge(edge);
    add_edge(old.node[0], node, old.kind, old.tag);
    add_edge(node, old.node[1], old.kind, old.tag);
  }
  /// The edge between two nodes, or -1.
  int find_edge(int a, int b) const {
    for (int e = first_[at(a)]; e >= 0; e = next_edge(e, a))
      if (other(e, a) == b) return e;
    return -1;
  }

  size_t n_nodes() const { return uv_.size(); }
  size_t n_edges() const { return edges_.size(); }  ///< removed ones counted
  const OpenMesh::Vec2d& uv(int node) const { return uv_[at(node)]; }
  int degree(int node) const { return degree_[at(node)]; }
  const Edge& edge(int e) const { return edges_[at(e)]; }
  void set_kind(int e, int kind, int tag) {
    edges_[at(e)].kind = kind;
    edges_[at(e)].tag = tag;
  }
  int other(int e, int node) const {
    const auto& n = edges_[at(e)].node;
    return n[0] == node ? n[1] : n[0];
  }
  /// First edge of a node and the next one after `e` in its list; -1 ends it.
  int first_edge(int node) const { return first_[at(node)]; }
  int next_edge(int e, int node) const { return edges_[at(e)].next[edges_[at(e)].node[0] == node ? 0 : 1]; }

 private:
  static size_t at(int index) { return static_cast<size_t>(index); }
  void unlink(int node, int edge) {
    const int after = next_edge(edge, node);
    if (first_[at(node)] == edge) {
      first_[at(node)] = after;
    } else {
      int e = first_[at(node)];
      while (next_edge(e, node) != edge) e = next_edge(e, node);
      edges_[at(e)].next[edges_[at(e)].node[0] == node ? 0 : 1] = after;
    }
    --degree_[at(node)];
  }

  std::vector<OpenMesh::Vec2d> uv_;
  std::vector<int> first_, degree_;
  std::vector<Edge> edges_;
};

}  // namespace anisomesh::detail
