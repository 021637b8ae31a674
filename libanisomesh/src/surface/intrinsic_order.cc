#include "surface/intrinsic_order.hh"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace anisomesh::detail {

std::vector<int> intrinsic_order(const std::vector<Measures>& measures) {
  std::array<std::vector<double>, 3> steps;
  for (size_t k = 0; k < steps.size(); ++k) {
    for (const auto& m : measures) steps[k].push_back(m[k]);
    steps[k] = in_steps(std::move(steps[k]));
  }
  using Entry = std::tuple<double, double, double, int>;
  std::vector<Entry> entries;
  entries.reserve(measures.size());
  for (size_t i = 0; i < measures.size(); ++i)
    entries.emplace_back(steps[0][i], steps[1][i], steps[2][i], static_cast<int>(i));
  std::sort(entries.begin(), entries.end());
  std::vector<int> order;
  order.reserve(entries.size());
  for (const Entry& entry : entries) order.push_back(std::get<3>(entry));
  return order;
}

std::vector<double> distances_from_middle(const std::vector<Vec3d>& places,
                                          const std::vector<double>& weights) {
  Vec3d middle(0, 0, 0);
  double sum = 0;
  for (size_t i = 0; i < places.size(); ++i) {
    middle += weights[i] * places[i];
    sum += weights[i];
  }
  if (sum > 0) middle /= sum;
  std::vector<double> distances;
  distances.reserve(places.size());
  for (const Vec3d& place : places) distances.push_back((place - middle).norm());
  return distances;
}

std::vector<int> intrinsic_vertex_order(const SurfaceArrays& surface) {
  const auto n = static_cast<size_t>(surface.n_vertices());
  std::vector<double> area_of(n, 0), sides_of(n, 0);
  std::vector<Vec3d> place(n, Vec3d(0, 0, 0));
  for (int f = 0; f < surface.n_faces(); ++f) {
    const Vec3d &a = surface.corner_point(f, 0), &b = surface.corner_point(f, 1),
                &c = surface.corner_point(f, 2);
    const double area = 0.5 * ((b - a) % (c - a)).norm();
    const double sides = (b - a).sqrnorm() + (c - b).sqrnorm() + (a - c).sqrnorm();
    for (int k = 0; k < 3; ++k) {
      const auto v = static_cast<size_t>(surface.corners[static_cast<size_t>(f)][static_cast<size_t>(k)]);
      area_of[v] += area;
      sides_of[v] += sides;
      place[v] = surface.corner_point(f, k);
    }
  }
  const auto away = distances_from_middle(place, area_of);
  std::vector<Measures> measures;
  for (size_t v = 0; v < n; ++v) measures.push_back({area_of[v], sides_of[v], away[v]});
  return intrinsic_order(measures);
}

}  // namespace anisomesh::detail
