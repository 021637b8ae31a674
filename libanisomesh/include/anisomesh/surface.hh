// The one seam between a user's OpenMesh triangle mesh, whatever its Traits, and the compiled library.
#pragma once

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <OpenMesh/Core/Mesh/TriConnectivity.hh>
#include <type_traits>
#include <utility>
#include <vector>

namespace anisomesh {

using OpenMesh::Vec2d;
using OpenMesh::Vec3d;

namespace detail {
class CanonicalCopy;
}

/// A non-owning view of a triangle mesh, like std::span: the mesh's own connectivity and a copy of its points
/// in double.
///
/// Any mesh that derives from OpenMesh::TriConnectivity fits. Properties are read from and written to the
/// mesh itself. The mesh must outlive the view; after points of the mesh are moved, or elements added or
/// deleted, make a new view. \throw InvalidInput if the mesh has no faces, has deleted elements or a point
/// that is not finite, or is smaller than 1e-60 or larger than 1e60 (its diagonal).
class SurfaceRef {
 public:
  template <class TriMesh, class = std::enable_if_t<std::is_base_of_v<OpenMesh::TriConnectivity, TriMesh>>>
  SurfaceRef(TriMesh& mesh)
      : SurfaceRef(mesh, points_of(mesh)) {}  // NOLINT: implicit by design, like std::span

  OpenMesh::TriConnectivity& connectivity() const { return *connectivity_; }
  const Vec3d& point(OpenMesh::VertexHandle vertex) const {
    return points_[static_cast<size_t>(vertex.idx())];
  }
  const std::vector<Vec3d>& points() const { return points_; }

  /// Length of the diagonal of the axis-aligned bounding box: the unit of distances that are asked for or
  /// reported. It changes by up to a factor of sqrt(3) where the surface is turned.
  double diagonal() const { return diagonal_; }

  /// Diameter of the smallest sphere around all points: the unit of what the stages choose by themselves, the
  /// same however the surface lies. At most the diagonal; as much for a box, 0.7 to 0.95 of it for most
  /// scans.
  double extent() const { return extent_; }

  /// The corners of a face, starting at the to-vertex of its halfedge: the order barycentric coordinates
  /// refer to.
  struct Corners {
    OpenMesh::VertexHandle vertex[3];
  };
  Corners corners(OpenMesh::FaceHandle face) const {
    const auto first = connectivity_->halfedge_handle(face);
    const auto second = connectivity_->next_halfedge_handle(first);
    return {{connectivity_->to_vertex_handle(first), connectivity_->to_vertex_handle(second),
             connectivity_->from_vertex_handle(first)}};
  }

  /// For the library alone: what this is a view of where elements are numbered by the shape of the surface;
  /// none for a mesh of the caller's.
  const detail::CanonicalCopy* canonical_copy() const { return canonical_copy_; }

 private:
  friend class detail::CanonicalCopy;
  SurfaceRef(OpenMesh::TriConnectivity& connectivity, std::vector<Vec3d> points);

  template <class TriMesh>
  static std::vector<Vec3d> points_of(const TriMesh& mesh) {
    std::vector<Vec3d> points;
    points.reserve(mesh.n_vertices());
    for (size_t i = 0; i < mesh.n_vertices(); ++i) {
      const auto& p = mesh.point(OpenMesh::VertexHandle(static_cast<int>(i)));
      points.emplace_back(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
    }
    return points;
  }

  OpenMesh::TriConnectivity* connectivity_;
  std::vector<Vec3d> points_;
  double diagonal_ = 0, extent_ = 0;
  const detail::CanonicalCopy* canonical_copy_ = nullptr;
};

/// A point on the surface: a face and barycentric coordinates with respect to SurfaceRef::corners(face),
/// summing to 1.
struct SurfacePoint {
  OpenMesh::FaceHandle face;
  Vec3d barycentric{0, 0, 0};
};

/// The position of a surface point in space, in model units.
Vec3d position(const SurfaceRef& surface, const SurfacePoint& point);

}  // namespace anisomesh
