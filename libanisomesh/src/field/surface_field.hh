// The curvature tensors of a surface in the tangent planes of its vertices, and how they go from one to
// another.
#pragma once

#include <array>
#include <vector>

#include "surface/cut_surface.hh"
#include "surface/unfolded_faces.hh"

namespace anisomesh::detail {

using OpenMesh::Vec6d;

/// (cos, sin) of the rotation that takes coordinates in TangentFrame(from) to those in TangentFrame(to), when
/// the plane is turned by the shortest rotation of the normals.
Vec2d transport(const Vec3d& from, const Vec3d& to);

/// One-sided at features: a node is one side of a vertex.
struct SurfaceField {
  CutSurface cut;
  std::vector<Vec3d> normal;  ///< of each node, unit
  std::vector<Vec3d> tensor;  ///< of each node, (uu, uv, vv) in TangentFrame(normal), 1/length
};

/// Normals and tensors of the nodes of the cut surface. A vertex off all features has the normal that
/// estimate_curvature() gave it; a side of one on a feature that of the faces around it there, and the mean
/// of the tensors of its neighbours off the feature. [ACDLD03, section 2.5] Reads: normal, and the tensors
/// from `tensors`, one for each vertex.
SurfaceField surface_field(const SurfaceRef& surface, const std::vector<Vec6d>& tensors);

/// The tensors the stages after smoothing work with: surface_tensor. \throw InvalidInput if it is missing
std::vector<Vec6d> read_surface_tensors(const SurfaceRef& surface);

/// (cos, sin) that takes coordinates in the TangentFrame of each corner's normal to those in its face's
/// frame.
std::vector<std::array<Vec2d, 3>> turns_into_faces(const SurfaceRef& surface, const SurfaceField& field);

/// The tensors at the corners of each face, in its own frame.
std::vector<std::array<Vec3d, 3>> corner_tensors_in_faces(const SurfaceRef& surface,
                                                          const SurfaceField& field);

}  // namespace anisomesh::detail
