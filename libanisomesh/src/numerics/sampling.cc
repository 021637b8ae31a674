#include "numerics/sampling.hh"

#include <algorithm>
#include <cmath>
#include <random>

namespace anisomesh::detail {

std::vector<AreaSample> sample_by_area(const std::vector<Vec3d>& points,
                                       const std::vector<Triangle>& triangles, size_t count, unsigned seed) {
  std::vector<double> area_up_to(triangles.size());
  double total = 0;
  for (size_t t = 0; t < triangles.size(); ++t) {
    const Vec3d &a = points[static_cast<size_t>(triangles[t][0])],
                &b = points[static_cast<size_t>(triangles[t][1])],
                &c = points[static_cast<size_t>(triangles[t][2])];
    total += 0.5 * cross(b - a, c - a).norm();
    area_up_to[t] = total;
  }
  std::vector<AreaSample> samples;
  if (!(total > 0)) return samples;
  samples.reserve(count);
  // Not a std::*_distribution: those differ from one standard library to the next.
  std::mt19937 generator(seed);
  const auto uniform = [&generator] { return (static_cast<double>(generator()) + 0.5) / 4294967296.0; };
  size_t t = 0;
  for (size_t i = 0; i < count; ++i) {
    const double share = (static_cast<double>(i) + uniform()) / static_cast<double>(count) * total;
    while (t + 1 < triangles.size() && area_up_to[t] <= share) ++t;
    const double before = t > 0 ? area_up_to[t - 1] : 0, here = area_up_to[t] - before;
    // Where the share falls within the triangle is uniform in [0, 1): it serves as the first coordinate, and
    // keeps consecutive samples of one triangle apart.
    const double r = std::sqrt(here > 0 ? std::clamp((share - before) / here, 0.0, 1.0) : 0.5);
    const double s = uniform();
    const Vec3d &a = points[static_cast<size_t>(triangles[t][0])],
                &b = points[static_cast<size_t>(triangles[t][1])],
                &c = points[static_cast<size_t>(triangles[t][2])];
    samples.push_back({static_cast<int>(t), a + r * (1 - s) * (b - a) + r * s * (c - a)});
  }
  return samples;
}

}  // namespace anisomesh::detail
