// Faces that cross or overlap others of the same result: what neither distances nor normals show where a
// result lies twice over a flat part of its reference.
#include <algorithm>

#include "compare/compare_parts.hh"
#include "numerics/self_intersections.hh"

namespace anisomesh::detail {

std::vector<std::pair<int, int>> crossing_triangles(const PolygonSoup& result, size_t most) {
  const std::vector<int> place = merge_by_place(result.points);
  std::vector<Triangle> triangles = result.triangles;
  for (Triangle& corners : triangles)
    for (int& corner : corners) corner = place[static_cast<size_t>(corner)];
  auto pairs = self_intersections(result.points, triangles, most);
  const auto face_of = [&](int t) { return result.face_of[static_cast<size_t>(t)]; };
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                             [&](const auto& pair) { return face_of(pair.first) == face_of(pair.second); }),
              pairs.end());
  return pairs;
}

void measure_intersections(const PolygonSoup& result, Comparison& comparison) {
  std::vector<char> found(result.faces.size(), 0);
  for (const auto& pair : crossing_triangles(result))
    for (const int t : {pair.first, pair.second})
      found[static_cast<size_t>(result.face_of[static_cast<size_t>(t)])] = 1;
  comparison.self_intersecting_faces = static_cast<size_t>(std::count(found.begin(), found.end(), 1));
}

}  // namespace anisomesh::detail
