// Folded faces: turned over against the reference, and not merely near a place where the reference turns.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "compare/compare_parts.hh"
#include "compare/fold_limits.hh"

namespace anisomesh::detail {

namespace {

/// Two neighbours lie folded onto each other when their normals differ by more than 170 degrees.
const double folded_cosine = std::cos(170.0 / 180 * 3.14159265358979323846);

double cosine(const ReferenceSurface& reference, int triangle, const Vec3d& normal) {
  return dot(reference.normals[static_cast<size_t>(triangle)], normal);
}

/// Whether the reference around p faces the other way than `normal`, everywhere within reach. A thin ear, a
/// nostril or a deep valley has both sides nearby, and a face on one of them whose nearest point happens to
/// be on the other is no fold.
bool is_against(const ReferenceSurface& reference, const Vec3d& p, const Vec3d& normal,
                const FoldReach& reach) {
  const auto agrees = [&](int triangle) { return cosine(reference, triangle, normal) > at_right_angles; };
  const ClosestPoint nearest = reference.tree.closest(p);
  if (agrees(nearest.triangle)) return false;
  const double limit =
      std::sqrt(nearest.squared_distance) + reach.beyond(cosine(reference, nearest.triangle, normal));
  return reference.tree.closest_if(p, limit * limit, agrees).triangle < 0;
}

/// Four places in each triangle of a face.
std::vector<Vec3d> samples_of(const PolygonSoup& result, size_t face) {
  static const double weights[4][3] = {{1.0 / 3, 1.0 / 3, 1.0 / 3},
                                       {2.0 / 3, 1.0 / 6, 1.0 / 6},
                                       {1.0 / 6, 2.0 / 3, 1.0 / 6},
                                       {1.0 / 6, 1.0 / 6, 2.0 / 3}};
  std::vector<Vec3d> samples;
  for (int t = result.first_triangle[face]; t < result.first_triangle[face + 1]; ++t) {
    const Triangle& corner = result.triangles[static_cast<size_t>(t)];
    for (const auto& w : weights)
      samples.push_back(w[0] * result.points[static_cast<size_t>(corner[0])] +
                        w[1] * result.points[static_cast<size_t>(corner[1])] +
                        w[2] * result.points[static_cast<size_t>(corner[2])]);
  }
  return samples;
}

/// Whether most of a face's samples have something nearest that faces elsewhere.
bool is_suspicious(const ReferenceSurface& reference, const PolygonSoup& result, size_t face) {
  const std::vector<Vec3d> samples = samples_of(result, face);
  size_t against = 0, right = 0;
  for (const Vec3d& p : samples) {
    const int nearest = reference.tree.closest(p).triangle;
    ++(cosine(reference, nearest, result.normals[face]) > at_right_angles ? right : against);
    if (2 * right >= samples.size()) return false;
  }
  return 2 * against > samples.size();
}

/// Largest distance of a face's samples from the reference.
double distance_of(const ReferenceSurface& reference, const PolygonSoup& result, size_t face) {
  double squared = 0;
  for (const Vec3d& p : samples_of(result, face))
    squared = std::max(squared, reference.tree.closest(p).squared_distance);
  return std::sqrt(squared);
}

/// Whether the face is against the reference at most of its samples.
bool is_turned_over(const ReferenceSurface& reference, const PolygonSoup& result, size_t face,
                    const FoldReach& reach) {
  const std::vector<Vec3d> samples = samples_of(result, face);
  size_t against = 0;
  for (const Vec3d& p : samples) against += is_against(reference, p, result.normals[face], reach) ? 1 : 0;
  return 2 * against > samples.size();
}

struct InnerEdge {
  int from, to, left, right;  // vertices and faces
};

std::vector<InnerEdge> inner_edges(const PolygonSoup& result) {
  std::map<std::pair<int, int>, int> first_face;
  std::vector<InnerEdge> edges;
  for (size_t f = 0; f < result.faces.size(); ++f) {
    const auto& face = result.faces[f];
    for (size_t i = 0; i < face.size(); ++i) {
      const int a = face[i], b = face[(i + 1) % face.size()];
      const auto opposite = first_face.find({b, a});
      if (opposite != first_face.end())
        edges.push_back({a, b, static_cast<int>(f), opposite->second});
      else
        first_face[{a, b}] = static_cast<int>(f);
    }
  }
  return edges;
}

/// Of the faces that are asked for: suspicious ones, and those at sharp edges. A face may be as near the
/// wrong side of a thin sheet by chance; its neighbours are not.
std::vector<FoldReach> reaches_of(const ReferenceSurface& reference, const PolygonSoup& result,
                                  std::vector<char> asked, const std::vector<InnerEdge>& sharp,
                                  const std::vector<InnerEdge>& edges) {
  const size_t n = result.faces.size();
  for (const InnerEdge& edge : sharp)
    asked[static_cast<size_t>(edge.left)] = asked[static_cast<size_t>(edge.right)] = 1;
  std::vector<char> measured = asked;
  for (const InnerEdge& edge : edges) {
    if (asked[static_cast<size_t>(edge.left)]) measured[static_cast<size_t>(edge.right)] = 1;
    if (asked[static_cast<size_t>(edge.right)]) measured[static_cast<size_t>(edge.left)] = 1;
  }
  std::vector<double> distance(n, 0);
  tbb::parallel_for(size_t{0}, n, [&](size_t face) {
    if (measured[face]) distance[face] = distance_of(reference, result, face);
  });
  std::vector<double> largest = distance;
  for (const InnerEdge& edge : edges) {
    const auto left = static_cast<size_t>(edge.left), right = static_cast<size_t>(edge.right);
    largest[left] = std::max(largest[left], distance[right]);
    largest[right] = std::max(largest[right], distance[left]);
  }
  std::vector<FoldReach> reach;
  for (size_t face = 0; face < n; ++face) reach.emplace_back(result.diameters[face], largest[face]);
  return reach;
}

}  // namespace

std::vector<char> folded_faces(const ReferenceSurface& reference, const PolygonSoup& result) {
  const size_t n = result.faces.size();
  std::vector<char> folded(n, 0), suspicious(n, 0);
  const std::vector<char> degenerate = degenerate_faces(result);
  tbb::parallel_for(size_t{0}, n, [&](size_t face) {
    suspicious[face] = !degenerate[face] && is_suspicious(reference, result, face);
  });
  const std::vector<InnerEdge> edges = inner_edges(result);
  std::vector<InnerEdge> sharp;
  for (const InnerEdge& edge : edges) {
    const auto left = static_cast<size_t>(edge.left), right = static_cast<size_t>(edge.right);
    if (!degenerate[left] && !degenerate[right] &&
        !(dot(result.normals[left], result.normals[right]) > folded_cosine))
      sharp.push_back(edge);
  }
  const std::vector<FoldReach> reach = reaches_of(reference, result, suspicious, sharp, edges);
  tbb::parallel_for(size_t{0}, n, [&](size_t face) {
    if (suspicious[face]) folded[face] = is_turned_over(reference, result, face, reach[face]) ? 1 : 0;
  });
  for (const InnerEdge& edge : sharp) {
    const Vec3d middle =
        0.5 * (result.points[static_cast<size_t>(edge.from)] + result.points[static_cast<size_t>(edge.to)]);
    // The reference may be as sharp here (the rim of an ear): then it shows both sides within reach.
    for (const auto face : {static_cast<size_t>(edge.left), static_cast<size_t>(edge.right)})
      if (is_against(reference, middle, result.normals[face], reach[face])) folded[face] = 1;
  }
  return folded;
}

void measure_folds(const ReferenceSurface& reference, const PolygonSoup& result, Comparison& comparison) {
  const auto folded = folded_faces(reference, result);
  comparison.folded_faces = static_cast<size_t>(std::count(folded.begin(), folded.end(), 1));
}

}  // namespace anisomesh::detail
