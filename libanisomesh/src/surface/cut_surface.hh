// The surface cut open along its feature edges, so that what happens on one side never reaches the other.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "anisomesh/surface.hh"

namespace anisomesh::detail {

/// A node is a vertex, or one side of a vertex on a feature. Node v belongs to vertex v; further sides of a
/// vertex follow after all vertices.
struct CutSurface {
  std::vector<std::array<int, 3>> corner_node;  ///< of each face, in the order of SurfaceRef::corners()
  std::vector<int> vertex_of_node;
  std::vector<char> on_feature;  ///< of each vertex: whether a feature edge ends there
  size_t nodes() const { return vertex_of_node.size(); }
};

/// Reads: edge feature status. The border is no feature here.
CutSurface cut_along_features(const SurfaceRef& surface);

/// Whether the edge carries OpenMesh's feature status.
bool is_feature(const OpenMesh::TriConnectivity& mesh, OpenMesh::EdgeHandle edge);

/// The nodes that share a face edge with each node, as one array with offsets.
struct NodeNeighbours {
  std::vector<int> offset, node;
};
NodeNeighbours node_neighbours(const SurfaceRef& surface, const CutSurface& cut);

/// One tensor a node: that of the vertex; on a feature the mean over the node's neighbours off all features.
/// A node that has none takes the mean over its neighbours on features instead, and the vertex's own value
/// where the whole part of the surface between features has no vertex off them. [ACDLD03, section 2.5]
std::vector<Vec3d> one_sided_values(const CutSurface& cut, const NodeNeighbours& neighbours,
                                    const std::vector<Vec3d>& at_vertices);

/// The same where each node has a frame of its own. \param at_nodes what a node has of its vertex, in its
/// frame \param carry takes a tensor from the frame of one node to that of another
std::vector<Vec3d> one_sided_values(
    const CutSurface& cut, const NodeNeighbours& neighbours, std::vector<Vec3d> at_nodes,
    const std::function<Vec3d(size_t from, size_t to, const Vec3d& tensor)>& carry);

}  // namespace anisomesh::detail
