// Which faces lie on which side of a feature, as seen from a node on it.
#pragma once

#include <vector>

#include "network/network_graph.hh"

namespace anisomesh::detail {

/// The faces of the surface around a node between one edge of a feature or the border and the next,
/// counter-clockwise.
struct FeatureSide {
  std::vector<OpenMesh::FaceHandle> faces;
  std::vector<Vec3d>
      spokes;  ///< unit, along the edges around them; one more, the first and last are features
};

class FeatureSides {
 public:
  FeatureSides() = default;
  /// Of all nodes that an edge of a feature ends at.
  FeatureSides(const SurfaceRef& surface, const NetworkGraph& network);

  /// Of the faces that a node on a feature may be said to lie on, one in the region that has the edges to two
  /// other nodes as its sides. Features of the network leave a node as those of the surface do, in the same
  /// order, so that only which is which has to be told, and that is clear: they differ by angles, not by
  /// rounding. \return the face of the node where it has no sides, or lies on the right one
  OpenMesh::FaceHandle face_between(const NetworkGraph& network, int before, int node, int after) const;

 private:
  std::vector<std::vector<FeatureSide>> sides_;  ///< of each node; none where there are not two or more
};

}  // namespace anisomesh::detail
