// The network as edges of a triangulation of the surface that is coarsened with it. [ACDLD03, section 4.2]
#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <array>
#include <vector>

#include "embedding.hh"
#include "network_graph.hh"
#include "overlay.hh"

namespace anisomesh::detail {

struct OverlayTraits : OpenMesh::DefaultTraitsDouble {
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge);
};
using OverlayMesh = OpenMesh::TriMesh_ArrayKernelT<OverlayTraits>;

/// Starts as the overlay and loses a vertex with each change of the network: an edge collapse that keeps the
/// topology ("no new intersection" on a manifold) and turns no triangle over. Nodes keep their index. Copies
/// are independent.
class MeshEmbedding final : public Embedding {
 public:
  MeshEmbedding(const SurfaceRef& surface, const Overlay& overlay, const NetworkGraph& network);

  bool straighten(int a, int node, int b) override;
  bool contract(int keep, int gone, const std::vector<int>& others) override;
  void drop(int node) override;

  /// Takes out the nodes that no edge of the network leads to and that need not stay, as far as the topology
  /// allows.
  void coarsen(const NetworkGraph& network);

  /// Flips edges that are not the network's until the triangles are well shaped (Delaunay's rule, over the two
  /// triangles laid flat).
  void flip(const NetworkGraph& network);

  struct Triangle {
    std::array<int, 3> node;
    int region;  ///< of the network before it was decimated
  };
  std::vector<Triangle> triangles() const;
  /// The region a vertex of the surface lies in, of the network before it was decimated; -1 on an edge of it.
  int region_of_vertex(int vertex) const { return region_of_vertex_[static_cast<size_t>(vertex)]; }

 private:
  enum class Care { shape, turning, topology };

  void label_regions(const NetworkGraph& network);
  bool collapse(OpenMesh::VertexHandle gone, OpenMesh::VertexHandle keep, Care care);
  bool is_topology_kept(OpenMesh::HalfedgeHandle h);
  bool is_shape_kept(OpenMesh::HalfedgeHandle h, Care care) const;
  bool cut_corner(OpenMesh::VertexHandle a, OpenMesh::VertexHandle node, OpenMesh::VertexHandle b);
  bool take_out(OpenMesh::VertexHandle v, Care care);

  OverlayMesh mesh_;
  std::vector<Vec3d> normals_;  ///< of each triangle, unit
  std::vector<int> regions_;    ///< of each triangle
  std::vector<int> region_of_vertex_;
};

}  // namespace anisomesh::detail
