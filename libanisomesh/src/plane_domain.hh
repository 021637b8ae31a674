// The plane of a conformal parameterization as a domain for tracing: the paper's own.
#pragma once

#include <array>

#include "domain.hh"

namespace anisomesh::detail {

/// What a plane domain is made of.
struct PlaneInput {
  std::vector<Vec2d> uv;             ///< of each vertex
  std::vector<double> area_stretch;  ///< of each vertex: area in the plane over area on the surface
  std::vector<std::array<Vec3d, 3>> corner_tensors;  ///< of each face, one-sided at features
  std::vector<UmbilicPoint> umbilics;
};

/// Reads the properties that flatten(), smooth_tensors() and find_umbilics() have written.
PlaneInput read_plane_input(const SurfaceRef& surface);

/// Walks from triangle to triangle of the parameterization, so that no point is ever looked up; the triangles
/// must not be flipped. The local frame is that of (u, v), scaled to model units.
class PlaneDomain final : public Domain {
 public:
  PlaneDomain(const SurfaceRef& surface, const PlaneInput& input, const DensityOptions& density);

  Vec3d tensor(const SurfacePoint& at) const override;
  Vec3d tensor_ahead(const SurfacePoint& from, const Vec2d& vector) const override;
  Reach walk(const SurfacePoint& from, const Vec2d& vector) const override;
  double spacing(LineKind kind, const SurfacePoint& at) const override;
  double isotropic_spacing(const SurfacePoint& at) const override;
  bool isotropic(const SurfacePoint& at) const override;
  double turning_length(const SurfacePoint& at) const override;
  std::vector<Vec2d> separatrices(const UmbilicPoint& umbilic, LineKind kind) const override;
  const std::vector<UmbilicPoint>& umbilics() const override { return umbilics_; }
  NearUmbilic umbilic_near(LineKind kind, const SurfacePoint& at) const override;
  std::vector<int> faces_within(const SurfacePoint& at, double radius) const override;
  size_t n_faces() const override { return faces_.size(); }
  double area(OpenMesh::FaceHandle face) const override;
  std::unique_ptr<LineIndex> make_index() const override;

  double epsilon() const { return density_.epsilon(); }
  Vec2d plane_position(const SurfacePoint& at) const;
  /// Length in the plane over length on the surface.
  double scale(const SurfacePoint& at) const;

 private:
  // A vertex as seen from one side of the features through it: everything but the position is one-sided.
  struct Node {
    Vec2d uv{0, 0};
    double scale = 1;
    Vec3d tensor{0, 0, 0};
    double spacing[2] = {0, 0};  // by LineKind
  };
  struct Link {
    int node = 0;
    double length = 0;
  };
  // The edge `across[i]` is opposite corner i.
  struct Face {
    int node[3] = {0, 0, 0};
    int across[3] = {0, 0, 0};
  };

  void make_nodes(const SurfaceRef& surface, const PlaneInput& input);
  void make_neighbours(const SurfaceRef& surface);
  void make_spacing();
  void make_links();
  void grade_spacing(int kind);
  void register_umbilics();
  Vec3d barycentric(const Face& face, const Vec2d& point) const;
  const Node& node(const Face& face, int corner) const {
    return nodes_[static_cast<size_t>(face.node[corner])];
  }
  const Face& face(OpenMesh::FaceHandle handle) const { return faces_[static_cast<size_t>(handle.idx())]; }

  std::vector<Node> nodes_;
  std::vector<Face> faces_;
  std::vector<Link> links_;  // only while spacings are graded
  std::vector<int> links_begin_;
  std::vector<UmbilicPoint> umbilics_;
  std::vector<std::pair<int, int>> near_umbilics_;  // (face, umbilic), ascending
  double max_slope_;
  Density density_;
};

}  // namespace anisomesh::detail
