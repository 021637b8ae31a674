// What keeps the network a drawing without crossings while it is decimated: the plane, or a triangulation.
#pragma once

#include <vector>

namespace anisomesh::detail {

/// Asked before each change of the network; what it allows it takes as done.
class Embedding {
 public:
  virtual ~Embedding() = default;
  /// Whether the chain a - node - b may become the edge a - b: nothing else lies between the two.
  virtual bool straighten(int a, int node, int b) = 0;
  /// Whether the edges from `gone` to `others` may end in `keep` instead.
  virtual bool contract(int keep, int gone, const std::vector<int>& others) = 0;
  /// No edge leads to these nodes any more, and they need not stay.
  virtual void drop(const std::vector<int>& nodes) = 0;
};

}  // namespace anisomesh::detail
