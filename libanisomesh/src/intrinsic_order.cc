#include "intrinsic_order.hh"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace anisomesh::detail {

std::vector<int> intrinsic_order(const std::vector<std::array<double, 2>>& measures) {
  std::array<double, 2> step{0, 0};
  for (const auto& m : measures)
    for (size_t k = 0; k < 2; ++k) step[k] += std::abs(m[k]);
  for (double& s : step) s *= kTie / static_cast<double>(std::max<size_t>(measures.size(), 1));
  using Entry = std::tuple<double, double, int>;
  std::vector<Entry> entries;
  entries.reserve(measures.size());
  const auto rounded = [&](const std::array<double, 2>& m, size_t k) {
    return step[k] > 0 ? std::round(m[k] / step[k]) : 0.0;
  };
  for (const auto& m : measures)
    entries.emplace_back(rounded(m, 0), rounded(m, 1), static_cast<int>(entries.size()));
  std::sort(entries.begin(), entries.end());
  std::vector<int> order;
  order.reserve(entries.size());
  for (const Entry& entry : entries) order.push_back(std::get<2>(entry));
  return order;
}

std::vector<int> intrinsic_vertex_order(const SurfaceArrays& surface) {
  std::vector<std::array<double, 2>> measures(static_cast<size_t>(surface.n_vertices()), {0, 0});
  for (int f = 0; f < surface.n_faces(); ++f) {
    const Vec3d &a = surface.corner_point(f, 0), &b = surface.corner_point(f, 1),
                &c = surface.corner_point(f, 2);
    const double area = 0.5 * ((b - a) % (c - a)).norm();
    const double sides = (b - a).sqrnorm() + (c - b).sqrnorm() + (a - c).sqrnorm();
    for (const int v : surface.corners[static_cast<size_t>(f)]) {
      measures[static_cast<size_t>(v)][0] += area;
      measures[static_cast<size_t>(v)][1] += sides;
    }
  }
  return intrinsic_order(measures);
}

}  // namespace anisomesh::detail
