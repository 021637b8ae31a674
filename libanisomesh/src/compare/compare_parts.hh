// What the parts of compare() share: both meshes as plain arrays, and one function a part.
#pragma once

#include <limits>
#include <vector>

#include "anisomesh/compare.hh"
#include "numerics/bvh.hh"

namespace anisomesh::detail {

/// The reference: its triangles in a tree, their normals, and the curvature at its vertices if it was
/// estimated.
struct ReferenceSurface {
  explicit ReferenceSurface(const SurfaceRef& surface);

  TriangleTree tree;
  std::vector<Vec3d> normals;  // unit, of each triangle; zero where it has no area
  double diagonal;
  bool has_curvature = false;
  std::vector<double> k_min, k_max;
  std::vector<Vec3d> gamma_min, gamma_max;
};

/// The result: its polygons, what is derived from each, and a triangulation to measure distances on.
struct PolygonSoup {
  PolygonSoup(const OpenMesh::PolyMesh& mesh, FaceDiagonal diagonal);
  PolygonSoup(std::vector<Vec3d> points, std::vector<std::vector<int>> faces, FaceDiagonal diagonal);

  std::vector<Vec3d> points;
  std::vector<std::vector<int>> faces;
  std::vector<Vec3d> normals;     // unit normal of the plane of best fit; zero where the face has no area
  std::vector<double> diameters;  // largest distance of two corners
  std::vector<double> areas;      // in the plane of best fit
  std::vector<Triangle> triangles;
  std::vector<int> face_of;         // of each triangle
  std::vector<int> first_triangle;  // of each face, and one past the end

 private:
  void measure(FaceDiagonal diagonal);
};

/// Splits a polygon into triangles by cutting ears in its plane of best fit, the one with the shortest (or
/// longest) diagonal first. Indices into `corners`.
std::vector<Triangle> triangulate_polygon(const std::vector<Vec3d>& corners, const Vec3d& normal,
                                          FaceDiagonal diagonal);

/// Vertices at the very same place get the same number. OpenMesh duplicates vertices where a file is not
/// manifold; put together again, the file shows as it was.
std::vector<int> merge_by_place(const std::vector<Vec3d>& points);

/// Whether each face is turned over against the reference, or lies folded onto its neighbour.
std::vector<char> folded_faces(const ReferenceSurface& reference, const PolygonSoup& result);
/// Whether each face has no area to speak of.
std::vector<char> degenerate_faces(const PolygonSoup& result);
/// Whether each face that has an area turns back at a corner by more than 5 degrees, in its plane of best
/// fit.
std::vector<char> concave_faces(const PolygonSoup& result);

/// Pairs of triangles of different faces that have more in common than shared corners and sides; vertices in
/// one place are one. Past `most` pairs, those of one face counted, no more are looked for.
std::vector<std::pair<int, int>> crossing_triangles(const PolygonSoup& result,
                                                    size_t most = std::numeric_limits<size_t>::max());

// Each part fills its own fields of the comparison.
void measure_distances(const ReferenceSurface& reference, const PolygonSoup& result,
                       const CompareOptions& options, const Progress& progress, Comparison& comparison,
                       std::vector<double>& vertex_errors, std::vector<double>& face_errors);
void measure_faces(const PolygonSoup& result, Comparison& comparison);
void measure_folds(const ReferenceSurface& reference, const PolygonSoup& result, Comparison& comparison);
void measure_intersections(const PolygonSoup& result, Comparison& comparison);
void measure_alignment(const ReferenceSurface& reference, const PolygonSoup& result,
                       const OpenMesh::PolyMesh& mesh, double anisotropy_threshold, Comparison& comparison);
void measure_topology(const OpenMesh::PolyConnectivity& reference, const PolygonSoup& result,
                      const OpenMesh::PolyMesh& mesh, Comparison& comparison);

}  // namespace anisomesh::detail
