#include "fit_system.hh"

#include <algorithm>

namespace anisomesh::detail {

FitSystem::FitSystem(const std::vector<char>& free, size_t blocks)
    : unknown_(free.size(), -1),
      entries_(3 *
               static_cast<size_t>(std::count_if(free.begin(), free.end(), [](char f) { return f != 0; }))),
      right_(entries_.size(), 0) {
  for (size_t v = 0; v < free.size(); ++v)
    if (free[v]) unknown_[v] = n_++;
  entries_.reserve(9 * blocks);
}

void FitSystem::add(int v, int w, const Vec6d& b) {
  const int i = unknown_[static_cast<size_t>(v)], j = unknown_[static_cast<size_t>(w)];
  if (i < 0 || j < 0) return;
  const double full[3][3] = {{b[0], b[1], b[2]}, {b[1], b[3], b[4]}, {b[2], b[4], b[5]}};
  for (int r = 0; r < 3; ++r)
    for (int c = v == w ? r : 0; c < 3; ++c) entries_.add(3 * i + r, 3 * j + c, full[r][c]);
}

void FitSystem::add_right(int v, const Vec3d& value) {
  const int i = unknown_[static_cast<size_t>(v)];
  if (i < 0) return;
  for (int r = 0; r < 3; ++r) right_[static_cast<size_t>(3 * i + r)] += value[r];
}

std::vector<Vec3d> FitSystem::solve() const {
  std::vector<Vec3d> step(unknown_.size(), Vec3d(0, 0, 0));
  if (n_ == 0) return step;
  const std::vector<double> x = CholeskySolver(entries_).solve(right_);
  for (size_t v = 0; v < step.size(); ++v)
    if (unknown_[v] >= 0)
      for (int r = 0; r < 3; ++r) step[v][r] = x[static_cast<size_t>(3 * unknown_[v] + r)];
  return step;
}

}  // namespace anisomesh::detail
