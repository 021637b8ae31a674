// The surface itself as a domain for tracing: no parameterization, any topology.
#pragma once

#include <memory>
#include <optional>

#include "field/linear_field.hh"
#include "lines/face_domain.hh"
#include "surface/surface_distance.hh"
#include "surface/surface_flood.hh"

namespace anisomesh::detail {

/// What a surface domain is made of.
struct SurfaceInput {
  std::vector<std::array<int, 3>> corner_node;       ///< of each face: sides of vertices
  std::vector<Vec3d> node_tensors;                   ///< of each node, in any frame of its tangent plane
  std::vector<std::array<Vec3d, 3>> corner_tensors;  ///< of each face, in its frame (UnfoldedFaces)
  std::vector<UmbilicPoint> umbilics;
  /// Without charts empty: the corners of each face in its chart, and the turns of UnfoldedFaces.
  std::vector<std::array<Vec2d, 3>> chart_corners, chart_turns;
};

/// Reads the properties that cut_into_charts(), smooth_tensors() and find_umbilics() have written.
SurfaceInput read_surface_input(const SurfaceRef& surface);

/// Walks from triangle to triangle, unfolding at each edge. The local frame is that of the face
/// (UnfoldedFaces); in it the tensors of the corners are joined linearly. [Marinov and Kobbelt 2004]
///
/// Where the surface has charts it walks in these: the triangles are those of the charts, each scaled to its
/// area on the surface, so that a way is straight in a chart, its length that on the surface, and a seam an
/// edge as any other. What is near is measured on the surface.
class SurfaceDomain final : public FaceDomain {
 public:
  SurfaceDomain(const SurfaceRef& surface, SurfaceInput input, const DensityOptions& density,
                Follow follow = Follow::curvature);

  Vec3d place(const SurfacePoint& at) const override { return position(surface_, at); }
  Vec3d tensor(const SurfacePoint& at) const override;
  Vec3d tensor_ahead(const SurfacePoint& from, const Vec2d& vector) const override;
  Reach walk(const SurfacePoint& from, const Vec2d& vector) const override;
  Reach walk_while(const SurfacePoint& from, const Vec2d& vector,
                   const std::function<bool(const WayPiece&)>& visit) const override;
  double turning_length(const SurfacePoint& at) const override;
  std::vector<Vec2d> separatrices(const UmbilicPoint& umbilic, LineKind kind) const override;
  void mark_within(const SurfacePoint& at, double radius, std::vector<char>& marks) const override;
  double area(OpenMesh::FaceHandle face) const override { return unfolded_.area(face.idx()); }
  double side(OpenMesh::FaceHandle face, int corner) const override {
    return (unfolded_.corner(face.idx(), (corner + 2) % 3) - unfolded_.corner(face.idx(), (corner + 1) % 3))
        .norm();
  }
  std::unique_ptr<LineIndex> make_index(
      const std::function<double(const SurfacePoint&)>& reach) const override;

 private:
  void measure_fences();
  LinearField field(OpenMesh::FaceHandle face) const;
  double distance(const SurfacePoint& at, const Vec2d& place) const override;

  const UnfoldedFaces& ground() const { return charts_ ? *charts_ : unfolded_; }

  const SurfaceRef& surface_;
  UnfoldedFaces unfolded_;
  std::optional<UnfoldedFaces> charts_;
  std::vector<std::array<Vec3d, 3>> corner_tensors_;
  std::unique_ptr<SurfaceDistance> fences_;  // none where there are no fences
};

}  // namespace anisomesh::detail
