// Every OpenMesh property of the library, declared once: name, type, unit and the stage that writes it.
#pragma once

#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>
#include <string>
#include <vector>

#include "anisomesh/errors.hh"
#include "anisomesh/surface.hh"

namespace anisomesh {

using OpenMesh::Vec6d;

/// A name, the value type, the kind of element (an OpenMesh property handle template) and the writing stage.
template <class PropertyHandle>
struct PropertyDeclaration {
  using Handle = PropertyHandle;
  const char* name;
  const char* writer;
};

namespace property {

template <class T>
using OnVertices = PropertyDeclaration<OpenMesh::VPropHandleT<T>>;
template <class T>
using OnFaces = PropertyDeclaration<OpenMesh::FPropHandleT<T>>;
template <class T>
using OnHalfedges = PropertyDeclaration<OpenMesh::HPropHandleT<T>>;
template <class T>
using OnEdges = PropertyDeclaration<OpenMesh::EPropHandleT<T>>;
template <class T>
using OnMesh = PropertyDeclaration<OpenMesh::MPropHandleT<T>>;

// --- written by estimate_curvature()
// ---------------------------------------------------------------------------
/// Unit outward normal.
inline constexpr OnVertices<Vec3d> normal{"anisomesh:normal", "estimate_curvature"};
/// Curvature tensor k_min g_min g_min^T + k_max g_max g_max^T in space, as (xx, xy, xz, yy, yz, zz),
/// 1/length.
inline constexpr OnVertices<Vec6d> tensor{"anisomesh:tensor", "estimate_curvature"};
/// Principal curvatures, 1/length, positive where convex seen along the outward normal; k_min <= k_max.
inline constexpr OnVertices<double> k_min{"anisomesh:k_min", "estimate_curvature"};
inline constexpr OnVertices<double> k_max{"anisomesh:k_max", "estimate_curvature"};
/// Unit principal directions, tangent, sign arbitrary: gamma_min is the direction along which the normal
/// curvature is k_min.
inline constexpr OnVertices<Vec3d> gamma_min{"anisomesh:gamma_min", "estimate_curvature"};
inline constexpr OnVertices<Vec3d> gamma_max{"anisomesh:gamma_max", "estimate_curvature"};

// --- written by flatten()
// ----------------------------------------------------------------------------------------
/// Conformal parameterization; every face counter-clockwise; scaled so that the area in the plane is the
/// surface area.
inline constexpr OnVertices<Vec2d> uv{"anisomesh:uv", "flatten"};
/// Area in the plane over area on the surface around the vertex, no unit; lengths stretch by its square root.
inline constexpr OnVertices<double> area_stretch{"anisomesh:area_stretch", "flatten"};
/// Curvature tensor in the (u, v) frame, as (uu, uv, vv), 1/length on the surface; its eigenvalues are k_min
/// and k_max and the eigenvector of k_min is the image of gamma_min. Smoothed in place by smooth_tensors().
inline constexpr OnVertices<Vec3d> tensor2d{"anisomesh:tensor2d", "flatten"};

// --- written by cut_into_charts()
// ----------------------------------------------------------------------------------------
/// The chart that the face belongs to, from 0.
inline constexpr OnFaces<int> chart{"anisomesh:chart", "cut_into_charts"};
/// Where the corner that the halfedge points to lies in the plane of its face's chart: on a seam a vertex has
/// several places. Every face counter-clockwise; the area of a chart is that of its faces. (0, 0) on the
/// border.
inline constexpr OnHalfedges<Vec2d> chart_uv{"anisomesh:chart_uv", "cut_into_charts"};

// --- written by smooth_tensors() where the surface is not flattened
// -----------------------------------------------------
/// Smoothed curvature tensor in space, tangent to `normal`, as `tensor` is: (xx, xy, xz, yy, yz, zz),
/// 1/length.
inline constexpr OnVertices<Vec6d> surface_tensor{"anisomesh:surface_tensor", "smooth_tensors"};

// --- written by find_umbilics()
// ------------------------------------------------------------------------------------
/// 0: no umbilic in this face, 1: a wedge (index +1/2), -1: a trisector; on coarse surfaces more halves.
inline constexpr OnFaces<int> umbilic{"anisomesh:umbilic", "find_umbilics"};
/// Barycentric coordinates of the umbilic, in the order of SurfaceRef::corners(); (0, 0, 0) where there is
/// none.
inline constexpr OnFaces<Vec3d> umbilic_position{"anisomesh:umbilic_position", "find_umbilics"};

// --- written by tag_features()
// ------------------------------------------------------------------------------------
/// How near a result is to follow the features at least, whatever epsilon is, fraction of the extent; above
/// epsilon it is no bound.
inline constexpr OnMesh<double> feature_tolerance{"anisomesh:feature_tolerance", "tag_features"};

// --- written by trace_lines(), see lines.hh for the struct they hold
// -------------------------------------------------
/// The epsilon the lines were traced for, in model units.
inline constexpr OnMesh<double> epsilon{"anisomesh:epsilon", "trace_lines"};
/// How near the cells between the lines are to lie, in epsilons; build_polygons() follows it unless told
/// otherwise.
inline constexpr OnMesh<double> cell_tolerance{"anisomesh:cell_tolerance", "trace_lines"};
/// So many vertices or faces balance_vertices() is to leave; both 0: as many vertices as there are. Above 0
/// where trace_and_mesh() was to find the lines for a number, and left what is lacking to the balance.
inline constexpr OnMesh<int> target_vertices{"anisomesh:target_vertices", "trace_lines"};
inline constexpr OnMesh<int> target_faces{"anisomesh:target_faces", "trace_lines"};
/// The directions that the lines follow: a Follow (lines.hh). Where it is missing, those of curvature.
inline constexpr OnMesh<int> follow{"anisomesh:follow", "trace_lines"};
/// Per line: kind (0 min, 1 max), closed (0, 1), reason of its two ends (LineEnd), index of its first point:
/// 5 ints a line.
inline constexpr OnMesh<std::vector<int>> line_table{"anisomesh:line_table", "trace_lines"};
/// Face of each point of each line, one after the other.
inline constexpr OnMesh<std::vector<int>> line_faces{"anisomesh:line_faces", "trace_lines"};
/// Barycentric coordinates of each point of each line: 3 doubles a point.
inline constexpr OnMesh<std::vector<double>> line_barycentrics{"anisomesh:line_barycentrics", "trace_lines"};

// --- written by place_isotropic_samples()
// ------------------------------------------------------------------------------
inline constexpr OnMesh<std::vector<int>> isotropic_faces{"anisomesh:isotropic_faces",
                                                          "place_isotropic_samples"};
inline constexpr OnMesh<std::vector<double>> isotropic_barycentrics{"anisomesh:isotropic_barycentrics",
                                                                    "place_isotropic_samples"};

// --- written by build_polygons() on its result
// -------------------------------------------------------------------------
/// Why the vertex is there: an Origin (mesher.hh).
inline constexpr OnVertices<int> origin{"anisomesh:origin", "build_polygons"};
/// The point of the input surface that the vertex is.
inline constexpr OnVertices<int> source_face{"anisomesh:source_face", "build_polygons"};
inline constexpr OnVertices<Vec3d> source_barycentric{"anisomesh:source_barycentric", "build_polygons"};
/// What the edge is: an EdgeKind (mesher.hh).
inline constexpr OnEdges<int> edge_kind{"anisomesh:edge_kind", "build_polygons"};

// --- written by compare() on its result
// --------------------------------------------------------------------------------
/// Distance of the vertex to the reference, model units.
inline constexpr OnVertices<double> error{"anisomesh:error", "compare"};
/// Root of the mean squared distance between the face and the part of the reference nearest to it, both ways,
/// model units.
inline constexpr OnFaces<double> face_error{"anisomesh:face_error", "compare"};

}  // namespace property

/// The handle of a property that an earlier stage has written. \throw InvalidInput naming the stage to run if
/// it is missing.
template <class PropertyHandle>
PropertyHandle require_property(const OpenMesh::BaseKernel& mesh,
                                const PropertyDeclaration<PropertyHandle>& declaration) {
  PropertyHandle handle;
  if (!mesh.get_property_handle(handle, declaration.name))
    throw InvalidInput(std::string("property '") + declaration.name + "' is missing; run " +
                       declaration.writer + "() first");
  return handle;
}

/// The handle of a property that is there.
template <class PropertyHandle>
bool has_property(const OpenMesh::BaseKernel& mesh, const PropertyDeclaration<PropertyHandle>& declaration) {
  PropertyHandle handle;
  return mesh.get_property_handle(handle, declaration.name);
}

/// The handle of a property to write: found or added, and persistent, so that OpenMesh's .om files keep it.
template <class T>
OpenMesh::VPropHandleT<T> provide_property(
    OpenMesh::BaseKernel& mesh, const PropertyDeclaration<OpenMesh::VPropHandleT<T>>& declaration) {
  OpenMesh::VPropHandleT<T> handle;
  if (!mesh.get_property_handle(handle, declaration.name)) mesh.add_property(handle, declaration.name);
  mesh.property(handle).set_persistent(true);
  return handle;
}
template <class T>
OpenMesh::FPropHandleT<T> provide_property(
    OpenMesh::BaseKernel& mesh, const PropertyDeclaration<OpenMesh::FPropHandleT<T>>& declaration) {
  OpenMesh::FPropHandleT<T> handle;
  if (!mesh.get_property_handle(handle, declaration.name)) mesh.add_property(handle, declaration.name);
  mesh.property(handle).set_persistent(true);
  return handle;
}
template <class T>
OpenMesh::HPropHandleT<T> provide_property(
    OpenMesh::BaseKernel& mesh, const PropertyDeclaration<OpenMesh::HPropHandleT<T>>& declaration) {
  OpenMesh::HPropHandleT<T> handle;
  if (!mesh.get_property_handle(handle, declaration.name)) mesh.add_property(handle, declaration.name);
  mesh.property(handle).set_persistent(true);
  return handle;
}
template <class T>
OpenMesh::EPropHandleT<T> provide_property(
    OpenMesh::BaseKernel& mesh, const PropertyDeclaration<OpenMesh::EPropHandleT<T>>& declaration) {
  OpenMesh::EPropHandleT<T> handle;
  if (!mesh.get_property_handle(handle, declaration.name)) mesh.add_property(handle, declaration.name);
  mesh.property(handle).set_persistent(true);
  return handle;
}
template <class T>
OpenMesh::MPropHandleT<T> provide_property(
    OpenMesh::BaseKernel& mesh, const PropertyDeclaration<OpenMesh::MPropHandleT<T>>& declaration) {
  OpenMesh::MPropHandleT<T> handle;
  if (!mesh.get_property_handle(handle, declaration.name)) mesh.add_property(handle, declaration.name);
  mesh.mproperty(handle).set_persistent(true);
  return handle;
}

}  // namespace anisomesh
