#include "fit/fit_pairs.hh"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace anisomesh::detail {

namespace {

constexpr size_t at_once = 4096;  // pairs added up together: the sums do not depend on the number of threads

}  // namespace

void FitPairs::sort_input(size_t n_triangles) {
  first.assign(n_triangles + 1, 0);
  for (size_t i = 0; i < n_input; ++i)
    if (pair[i].triangle >= 0) ++first[static_cast<size_t>(pair[i].triangle) + 1];
  for (size_t t = 0; t < n_triangles; ++t) first[t + 1] += first[t];
  of_input.resize(static_cast<size_t>(first.back()));
  std::vector<int> next(first.begin(), first.end() - 1);
  for (size_t i = 0; i < n_input; ++i)
    if (pair[i].triangle >= 0)
      of_input[static_cast<size_t>(next[static_cast<size_t>(pair[i].triangle)]++)] = static_cast<int>(i);
}

void FitPairs::add_up() {
  const size_t n_parts = (pair.size() + at_once - 1) / at_once;
  std::vector<OpenMesh::Vec3d> sums(n_parts, Vec3d(0, 0, 0));
  tbb::parallel_for(size_t{0}, n_parts, [&](size_t part) {
    const size_t end = std::min(pair.size(), (part + 1) * at_once);
    for (size_t i = part * at_once; i < end; ++i) {
      const double far = pair[i].weight * pair[i].distance;
      sums[part] += Vec3d(far * pair[i].distance, far, pair[i].weight);
    }
  });
  Vec3d total(0, 0, 0);
  for (const Vec3d& sum : sums) total += sum;
  squared = total[0];
  mean = total[1];
  weight = total[2];
}

}  // namespace anisomesh::detail
