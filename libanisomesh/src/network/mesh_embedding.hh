// The network as edges of a triangulation of the surface that is coarsened with it. [ACDLD03, section 4.2]
#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <array>
#include <functional>
#include <limits>
#include <vector>

#include "network/embedding.hh"
#include "network/network_graph.hh"
#include "network/overlay.hh"

namespace anisomesh::detail {

struct OverlayTraits : OpenMesh::DefaultTraitsDouble {
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge);
};
using OverlayMesh = OpenMesh::TriMesh_ArrayKernelT<OverlayTraits>;

/// Starts as the overlay and loses a vertex with each change of the network: an edge collapse that keeps the
/// topology ("no new intersection" on a manifold) and turns no triangle over. What goes stays pinned to the
/// triangles that are left, by laying the star of each vertex flat before it goes (Lee et al. 1998, MAPS):
/// the map from the surface to the triangles. Nodes keep their index. Copies are independent.
class MeshEmbedding final : public Embedding {
 public:
  MeshEmbedding(const SurfaceRef& surface, const Overlay& overlay, const NetworkGraph& network);

  bool straighten(int a, int node, int b) override;
  bool contract(int keep, int gone, const std::vector<int>& others) override;
  void drop(const std::vector<int>& nodes) override;

  /// Takes out the nodes that no edge of the network leads to and that need not stay, as far as the topology
  /// allows and what is pinned stays within the tolerance (model units) of the triangles; but no vertex of
  /// the surface where no more than kept_share of the tolerances holds.
  /// \param breathe called often; it may throw to give up
  void coarsen(const NetworkGraph& network, double tolerance, const std::function<void()>& breathe = {});

  /// Flips edges that are not the network's until the triangles are well shaped (Delaunay's rule, over the
  /// two triangles laid flat).
  void flip(const NetworkGraph& network);

  /// A place of the surface inside a triangle that has all corners on features or other sharp edges or that
  /// many lines cross: without it nothing would know where the surface is between them, as in the wall of a
  /// hole between its rims.
  struct Sample {
    SurfacePoint point;
    Vec3d position;
    Vec3d normal;
  };
  /// A vertex of the surface that is gone, or a sample, where it would lie in a triangle.
  struct Pinned {
    int vertex;  ///< from the number of vertices on: of the samples
    Vec3d barycentric;
  };
  struct Triangle {
    std::array<int, 3> node;
    std::array<int, 3> across{-1, -1, -1};  ///< triangle beyond the side from corner k to the next, or -1
    const std::vector<Pinned>* pinned;      ///< good until the next change
  };
  std::vector<Triangle> triangles() const;
  /// The nodes that the edges of the triangulation join a node to.
  std::vector<int> neighbours(int node) const;
  /// The sample that is pinned, or null: it is a vertex.
  const Sample* sample(const Pinned& pinned) const {
    return pinned.vertex < vertices_ ? nullptr : &samples_[static_cast<size_t>(pinned.vertex - vertices_)];
  }

 private:
  enum class Care { shape, turning, topology };
  /// The triangles around a vertex, laid flat, with what is pinned in them.
  struct FlatStar {
    struct Point {
      int vertex;
      Vec2d place;
    };
    std::vector<std::pair<int, Vec2d>> ring;  ///< vertices around it
    std::vector<Point> points;
    bool closed = true;  ///< the last vertex of the ring is a neighbour of the first
    bool has_samples = false;
    std::vector<std::pair<int, size_t>> order;  ///< of a large ring, by vertex: where it is in the ring
    void sort();                                ///< when the ring is complete
    const Vec2d* place_of(int vertex) const;    ///< of a vertex of the ring, or null
  };
  /// A triangle that takes the place of a part of the star.
  struct Candidate {
    std::array<int, 3> node;
    OpenMesh::FaceHandle face;
    std::array<Vec2d, 3> corner{};
    double area = 0;  ///< twice
  };
  struct Landing {
    const Candidate* candidate = nullptr;
    Vec3d barycentric{0, 0, 0};
  };

  void add_samples(const SurfaceRef& surface, const Overlay& overlay, const NetworkGraph& network);
  void lay_flat(OpenMesh::VertexHandle v);
  void lay_flat(OpenMesh::EdgeHandle e);
  std::vector<Candidate> placed(const std::vector<Candidate>& candidates) const;
  Landing land(const FlatStar::Point& x, const std::vector<Candidate>& candidates) const;
  bool is_along(const std::vector<Candidate>& candidates, double least, bool vertices) const;
  std::vector<Candidate> fan_to(OpenMesh::VertexHandle keep) const;
  bool is_surface_kept(OpenMesh::VertexHandle keep, Care care) const;
  bool is_near(const std::vector<Candidate>& candidates) const;
  void add_points(OpenMesh::FaceHandle f);
  void pin_again(const std::vector<Candidate>& candidates);
  std::vector<Candidate> around(OpenMesh::VertexHandle keep) const;
  bool collapse(OpenMesh::VertexHandle gone, OpenMesh::VertexHandle keep, Care care);
  void join(OpenMesh::HalfedgeHandle h);
  bool is_as_at(int step, OpenMesh::VertexHandle v) const;
  bool is_topology_kept(OpenMesh::HalfedgeHandle h);
  bool is_shape_kept(OpenMesh::HalfedgeHandle h, Care care) const;
  Vec3d sampled_normal(OpenMesh::EdgeHandle e) const;
  /// Of a triangle to a normal of the surface, of any length; 0 where one of them has none.
  double cosine(OpenMesh::VertexHandle a, OpenMesh::VertexHandle b, OpenMesh::VertexHandle c,
                const Vec3d& surface) const;
  double cosine_to_surface(OpenMesh::VertexHandle a, OpenMesh::VertexHandle b,
                           OpenMesh::VertexHandle c) const;
  double lowest_cosine(OpenMesh::VertexHandle gone, OpenMesh::VertexHandle keep) const;
  bool cut_corner(OpenMesh::VertexHandle a, OpenMesh::VertexHandle node, OpenMesh::VertexHandle b);
  void flip_edge(OpenMesh::EdgeHandle e);
  bool take_out(OpenMesh::VertexHandle v, Care care);

  OverlayMesh mesh_;
  std::vector<Vec3d> normals_;               ///< of each triangle, unit
  std::vector<Vec3d> node_normals_;          ///< of the surface
  std::vector<std::vector<Pinned>> pinned_;  ///< in each triangle
  int vertices_;                             ///< of the surface; the first nodes
  std::vector<Sample> samples_;
  std::vector<Vec3d> surface_points_;                           ///< of its vertices
  double tolerance_ = std::numeric_limits<double>::infinity();  ///< only while coarsening
  FlatStar star_;                                               ///< only during a collapse
  int step_ = 0;                                                ///< changes so far
  std::vector<int> changed_;                                    ///< of each node: the last change of its star
  std::vector<int> stuck_;                                      ///< where the chain could not be straightened
  OpenMesh::VertexHandle laid_flat_;  ///< what the star is around, if that is so still
};

}  // namespace anisomesh::detail
