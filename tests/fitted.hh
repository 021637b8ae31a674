// What the tests of the fit and of the balance share.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "anisomesh/features.hh"
#include "anisomesh/remesh.hh"
#include "anisomesh/shapes.hh"

namespace fitted {

using namespace anisomesh;
using OpenMesh::PolyMesh;
using OpenMesh::TriMesh;

inline TriMesh shape(const std::string& name, int vertices = 4000) {
  ShapeOptions options;
  options.vertices = vertices;
  return make_shape(name, options);
}

/// With its vertices on the surface.
inline PolyMesh remeshed(TriMesh& mesh, size_t vertices) {
  RemeshOptions options;
  options.target_vertices = vertices;
  options.fit.enabled = false;
  return remesh(mesh, options);
}

inline std::vector<Vec3d> points_of(const PolyMesh& mesh) {
  std::vector<Vec3d> points;
  for (const auto v : mesh.vertices()) points.push_back(mesh.point(v));
  return points;
}

inline std::vector<std::vector<int>> faces_of(const PolyMesh& mesh) {
  std::vector<std::vector<int>> faces;
  for (const auto f : mesh.faces()) {
    faces.emplace_back();
    for (const auto v : f.vertices()) faces.back().push_back(v.idx());
  }
  return faces;
}

/// The largest distance from a feature or border edge of the surface to the nearest one of the result.
inline double feature_distance(const SurfaceRef& surface, const PolyMesh& result) {
  const auto& mesh = surface.connectivity();
  double largest = 0;
  for (const auto e : mesh.edges()) {
    if (!is_feature_or_border(mesh, e)) continue;
    const Vec3d place = 0.5 * (surface.point(e.v0()) + surface.point(e.v1()));
    double nearest = 1e300;
    for (const auto o : result.edges()) {
      if (!result.is_boundary(o) && !result.status(o).feature()) continue;
      const Vec3d a = result.point(o.v0()), along = result.point(o.v1()) - a;
      const double t = std::clamp(((place - a) | along) / along.sqrnorm(), 0.0, 1.0);
      nearest = std::min(nearest, (place - a - t * along).norm());
    }
    largest = std::max(largest, nearest);
  }
  return largest;
}

}  // namespace fitted
