// The plane of a conformal parameterization as a domain for tracing: the paper's own.
#pragma once

#include <array>

#include "field/linear_field.hh"
#include "lines/face_domain.hh"

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
class PlaneDomain final : public FaceDomain {
 public:
  PlaneDomain(const SurfaceRef& surface, const PlaneInput& input, const DensityOptions& density,
              Follow follow = Follow::curvature);

  Vec3d place(const SurfacePoint& at) const override {
    const Vec2d uv = plane_position(at);
    return {uv[0], uv[1], 0};
  }
  Vec3d tensor(const SurfacePoint& at) const override;
  Vec3d tensor_ahead(const SurfacePoint& from, const Vec2d& vector) const override;
  Reach walk(const SurfacePoint& from, const Vec2d& vector) const override;
  Reach walk_while(const SurfacePoint& from, const Vec2d& vector,
                   const std::function<bool(const WayPiece&)>& visit) const override;
  double turning_length(const SurfacePoint& at) const override;
  std::vector<Vec2d> separatrices(const UmbilicPoint& umbilic, LineKind kind) const override;
  void mark_within(const SurfacePoint& at, double radius, std::vector<char>& marks) const override;
  double area(OpenMesh::FaceHandle face) const override;
  double side(OpenMesh::FaceHandle face, int corner) const override;
  std::unique_ptr<LineIndex> make_index(
      const std::function<double(const SurfacePoint&)>& reach) const override;

  Vec2d plane_position(const SurfacePoint& at) const;
  /// Length in the plane over length on the surface.
  double scale(const SurfacePoint& at) const;

 private:
  using Face = DomainFace;
  // A vertex as seen from one side of the features through it: everything but the position is one-sided.
  struct Node {
    Vec2d uv{0, 0};
    double scale = 1;
    Vec3d tensor{0, 0, 0};
  };

  void make_nodes(const SurfaceRef& surface, const PlaneInput& input);
  template <class Visit>
  Reach walk_visiting(const SurfacePoint& from, const Vec2d& vector, Visit&& visit) const;
  std::vector<int> faces_within(const SurfacePoint& at, double radius, const IsHidden& is_hidden) const;
  LinearField field(const Face& face) const;
  Vec3d barycentric(const Face& face, const Vec2d& point) const;
  double distance(const SurfacePoint& at, const Vec2d& place) const override;
  const Node& node(const Face& face, int corner) const {
    return nodes_[static_cast<size_t>(face.node[corner])];
  }

  std::vector<Node> nodes_;
};

}  // namespace anisomesh::detail
