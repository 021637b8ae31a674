#include "anisomesh/compare.hh"

#include <chrono>
#include <string>

#include "anisomesh/properties.hh"
#include "compare/compare_parts.hh"
#include "surface/unfit_mesh.hh"

namespace anisomesh {

namespace {

std::vector<detail::Triangle> triangles_of(const SurfaceRef& surface) {
  std::vector<detail::Triangle> triangles;
  triangles.reserve(surface.connectivity().n_faces());
  for (const auto face : surface.connectivity().faces()) {
    const auto corners = surface.corners(face);
    triangles.push_back({corners.vertex[0].idx(), corners.vertex[1].idx(), corners.vertex[2].idx()});
  }
  return triangles;
}

template <class T>
std::vector<T> values_of(const SurfaceRef& surface,
                         const PropertyDeclaration<OpenMesh::VPropHandleT<T>>& declaration) {
  auto& mesh = surface.connectivity();
  const auto handle = require_property(mesh, declaration);
  std::vector<T> values;
  values.reserve(mesh.n_vertices());
  for (const auto vertex : mesh.vertices()) values.push_back(mesh.property(handle, vertex));
  return values;
}

bool has_curvature(const SurfaceRef& surface) {
  const auto& mesh = surface.connectivity();
  return has_property(mesh, property::k_min) && has_property(mesh, property::k_max) &&
         has_property(mesh, property::gamma_min) && has_property(mesh, property::gamma_max);
}

}  // namespace

namespace detail {

ReferenceSurface::ReferenceSurface(const SurfaceRef& surface)
    : tree(surface.points(), triangles_of(surface)),
      diagonal(surface.diagonal()),
      has_curvature(anisomesh::has_curvature(surface)) {
  normals.reserve(tree.triangles().size());
  for (const Triangle& corner : tree.triangles()) {
    const Vec3d &a = tree.points()[static_cast<size_t>(corner[0])],
                &b = tree.points()[static_cast<size_t>(corner[1])],
                &c = tree.points()[static_cast<size_t>(corner[2])];
    const Vec3d normal = cross(b - a, c - a);
    const double length = normal.norm();
    normals.push_back(length > 0 ? normal / length : Vec3d(0, 0, 0));
  }
  if (!has_curvature) return;
  k_min = values_of(surface, property::k_min);
  k_max = values_of(surface, property::k_max);
  gamma_min = values_of(surface, property::gamma_min);
  gamma_max = values_of(surface, property::gamma_max);
}

}  // namespace detail

void CompareOptions::validate() const {
  if (samples < 1000) throw InvalidOption("samples must be at least 1000, not " + std::to_string(samples));
  if (!(anisotropy_threshold >= 0 && anisotropy_threshold < 1))
    throw InvalidOption("anisotropy_threshold must lie in [0, 1), not " +
                        std::to_string(anisotropy_threshold));
}

Comparison compare(const SurfaceRef& reference, OpenMesh::PolyMesh& result, const CompareOptions& options,
                   const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  options.validate();
  detail::refuse_unfit_result(result);
  const detail::ReferenceSurface surface(detail::unchanged(reference));
  const detail::PolygonSoup soup(result, options.diagonal);

  Comparison comparison;
  std::vector<double> vertex_errors, face_errors;
  measure_distances(surface, soup, options, progress, comparison, vertex_errors, face_errors);
  measure_faces(soup, comparison);
  measure_folds(surface, soup, comparison);
  measure_intersections(soup, comparison);
  measure_alignment(surface, soup, result, options.anisotropy_threshold, comparison);
  measure_topology(reference.connectivity(), soup, result, comparison);
  report_progress(progress, 1);

  const auto vertex_error = provide_property(result, property::error);
  for (const auto vertex : result.vertices())
    result.property(vertex_error, vertex) = vertex_errors[static_cast<size_t>(vertex.idx())];
  const auto face_error = provide_property(result, property::face_error);
  for (const auto face : result.faces())
    result.property(face_error, face) = face_errors[static_cast<size_t>(face.idx())];
  comparison.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return comparison;
}

}  // namespace anisomesh
