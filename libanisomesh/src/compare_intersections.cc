// Faces that cross or overlap others of the same result: what neither distances nor normals show where a
// result lies twice over a flat part of its reference.
#include <algorithm>

#include "compare_parts.hh"
#include "numerics/self_intersections.hh"

namespace anisomesh::detail {

void measure_intersections(const PolygonSoup& result, Comparison& comparison) {
  const std::vector<int> place = merge_by_place(result.points);
  std::vector<Triangle> triangles = result.triangles;
  for (Triangle& corners : triangles)
    for (int& corner : corners) corner = place[static_cast<size_t>(corner)];
  std::vector<char> found(result.faces.size(), 0);
  for (const auto& [t, u] : self_intersections(result.points, triangles)) {
    const auto a = static_cast<size_t>(result.face_of[static_cast<size_t>(t)]);
    const auto b = static_cast<size_t>(result.face_of[static_cast<size_t>(u)]);
    if (a != b) found[a] = found[b] = 1;
  }
  comparison.self_intersecting_faces = static_cast<size_t>(std::count(found.begin(), found.end(), 1));
}

}  // namespace anisomesh::detail
