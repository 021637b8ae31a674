#include "balance/quad_splits.hh"

#include <algorithm>
#include <cmath>

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

constexpr double least_fullness = 0.05, least_cosine = 0.35;  // of the triangles that may come of it

double angle(const Vec3d& a, const Vec3d& b) { return std::atan2(cross(a, b).norm(), a | b); }

/// Of each polygon: what its normal is off, by angle times weight, and how much less its triangles' normals.
struct Deviation {
  double of_polygon = 0, saved = 0;
};

std::vector<Deviation> deviations(const FitState& fit, const FitInput& input) {
  const FitTriangles& triangles = fit.triangles();
  std::vector<Deviation> result(at(fit.mesh().n_polygons()));
  std::vector<int> polygon_of(triangles.corner.size());
  std::vector<Vec3d> normal(result.size(), Vec3d(0, 0, 0));
  for (size_t p = 0; p < result.size(); ++p)
    for (int t = triangles.first[p]; t < triangles.first[p + 1]; ++t) {
      polygon_of[at(t)] = static_cast<int>(p);
      normal[p] += triangles.area[at(t)] * triangles.normal[at(t)];
    }
  // The ruler takes normals at samples of the result, whose pairs come after those of the input.
  const auto& pairs = fit.pairs();
  for (size_t i = fit.matching().samples().size(); i < pairs.size(); ++i) {
    const FitPair& pair = pairs[i];
    if (pair.triangle < 0 || pair.face < 0) continue;
    const auto p = at(polygon_of[at(pair.triangle)]);
    const Vec3d& there = input.normal[at(pair.face)];
    const double off = pair.weight * angle(normal[p], there);
    result[p].of_polygon += off;
    result[p].saved += off - pair.weight * angle(triangles.normal[at(pair.triangle)], there);
  }
  return result;
}

bool is_fair_triangle(const FitState& fit, int t, const Vec3d& normal) {
  const Triangle& c = fit.triangles().corner[at(t)];
  double longest = 0;
  for (size_t k = 0; k < 3; ++k)
    longest = std::max(longest, (fit.points()[at(c[(k + 1) % 3])] - fit.points()[at(c[k])]).sqrnorm());
  return 2 * fit.triangles().area[at(t)] > least_fullness * longest &&
         (fit.triangles().normal[at(t)] | normal) > least_cosine * normal.norm();
}

}  // namespace

size_t split_bent_quads(const FitState& fit, const FitInput& input, double gain, double least_quads,
                        PatchMesh& mesh) {
  const std::vector<Deviation> off = deviations(fit, input);
  const FitTriangles& triangles = fit.triangles();
  double total = 0, quads = 0;
  std::vector<int> order;
  for (size_t p = 0; p < off.size(); ++p) {
    total += off[p].of_polygon;
    if (fit.mesh().degree(static_cast<int>(p)) != 4) continue;
    ++quads;
    order.push_back(static_cast<int>(p));
  }
  double polygons = static_cast<double>(off.size());
  const double least = std::max(gain * total / polygons, 0.0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int p, int q) { return off[at(p)].saved > off[at(q)].saved; });
  size_t done = 0;
  for (const int p : order) {
    if (!(off[at(p)].saved > least) || quads - 1 < least_quads * (polygons + 1)) break;
    const int first = triangles.first[at(p)];
    const Vec3d normal = triangles.area[at(first)] * triangles.normal[at(first)] +
                         triangles.area[at(first + 1)] * triangles.normal[at(first + 1)];
    if (!is_fair_triangle(fit, first, normal) || !is_fair_triangle(fit, first + 1, normal)) continue;
    const PatchMesh::Patch patch = mesh.join({p});
    std::vector<std::vector<int>> pieces;
    for (const int t : {first, first + 1})
      pieces.emplace_back(triangles.corner[at(t)].begin(), triangles.corner[at(t)].end());
    if (patch.ring.empty() || !mesh.may_replace(patch, pieces)) continue;
    mesh.replace(patch, pieces);
    --quads, ++polygons, ++done;
  }
  return done;
}

}  // namespace anisomesh::detail
