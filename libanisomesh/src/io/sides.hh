// Which faces of a soup share which edge.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "io/soup.hh"

namespace anisomesh::detail {

/// The sides of all faces, those of one edge beside each other. Side i runs from corner i to the next one.
struct Sides {
  explicit Sides(const Soup& soup) : next(soup.corners.size()), face(soup.corners.size()) {
    for (size_t f = 0; f < soup.n_faces(); ++f)
      for (size_t i = soup.begins[f]; i < soup.begins[f + 1]; ++i) {
        next[i] = i + 1 == soup.begins[f + 1] ? soup.begins[f] : i + 1;
        face[i] = f;
      }
    std::vector<size_t> begin(soup.points.size() + 1, 0);
    const auto low = [&](size_t i) { return static_cast<size_t>(std::min(from(soup, i), to(soup, i))); };
    for (size_t i = 0; i < next.size(); ++i) ++begin[low(i) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    sorted.resize(next.size());
    std::vector<size_t> fill(begin.begin(), begin.end() - 1);
    for (size_t i = 0; i < next.size(); ++i) sorted[fill[low(i)]++] = i;
    for (size_t v = 0; v + 1 < begin.size(); ++v)
      std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(begin[v]),
                sorted.begin() + static_cast<std::ptrdiff_t>(begin[v + 1]), [&](size_t a, size_t b) {
                  const int high_a = std::max(from(soup, a), to(soup, a));
                  const int high_b = std::max(from(soup, b), to(soup, b));
                  return high_a != high_b ? high_a < high_b : a < b;
                });
  }

  int from(const Soup& soup, size_t side) const { return soup.corners[side]; }
  int to(const Soup& soup, size_t side) const { return soup.corners[next[side]]; }

  /// Calls `visit(a, b)` for the two sides of every edge that has exactly two.
  template <class Visit>
  void for_each_pair(const Soup& soup, Visit visit) const {
    const auto same_edge = [&](size_t a, size_t b) {
      return (from(soup, a) == from(soup, b) && to(soup, a) == to(soup, b)) ||
             (from(soup, a) == to(soup, b) && to(soup, a) == from(soup, b));
    };
    for (size_t i = 0; i < sorted.size();) {
      size_t j = i + 1;
      while (j < sorted.size() && same_edge(sorted[i], sorted[j])) ++j;
      if (j - i == 2) visit(sorted[i], sorted[i + 1]);
      i = j;
    }
  }

  std::vector<size_t> next;
  std::vector<size_t> face;
  std::vector<size_t> sorted;
};

}  // namespace anisomesh::detail
