#include "fit/fit_system.hh"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "anisomesh/errors.hh"

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

// Of the first residual, in the norm of the inverse diagonal blocks. The terms are linearized, so that a
// step need not be nearer to theirs.
constexpr double near_enough = 1e-3;
constexpr int most_iterations = 300;
constexpr int rows_at_once = 256;

double dot(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += a[i] | b[i];
  return sum;
}

/// Of a positive definite one.
Vec6d inverse(const Vec6d& a) {
  const double xx = a[3] * a[5] - a[4] * a[4], xy = a[2] * a[4] - a[1] * a[5], xz = a[1] * a[4] - a[2] * a[3];
  const double determinant = a[0] * xx + a[1] * xy + a[2] * xz;
  return Vec6d(xx, xy, xz, a[0] * a[5] - a[2] * a[2], a[1] * a[2] - a[0] * a[4], a[0] * a[3] - a[1] * a[1]) /
         determinant;
}

}  // namespace

FitPattern::FitPattern(const FitMesh& mesh) {
  std::vector<int> row;
  for (int v = 0; v < mesh.n_vertices; ++v) {
    row.assign(1, v);
    for (int i = mesh.first_polygon[at(v)]; i < mesh.first_polygon[at(v) + 1]; ++i)
      row.insert(row.end(), mesh.begin(mesh.polygons[at(i)]), mesh.end(mesh.polygons[at(i)]));
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    column_.insert(column_.end(), row.begin(), row.end());
    first_.push_back(static_cast<int>(column_.size()));
  }
}

int FitPattern::place(int v, int w) const {
  const auto from = column_.begin() + begin(v), to = column_.begin() + end(v);
  return static_cast<int>(std::lower_bound(from, to, w) - column_.begin());
}

FitSystem::FitSystem(const std::vector<char>& free, const FitPattern& pattern)
    : free_(free),
      pattern_(pattern),
      block_(at(pattern.end(pattern.rows() - 1)), Vec6d(0.0)),
      right_(free.size(), Vec3d(0, 0, 0)) {}

void FitSystem::fill(const std::function<void(int, Row&)>& fill) {
  tbb::parallel_for(tbb::blocked_range<int>(0, pattern_.rows(), rows_at_once), [&](const auto& range) {
    for (int v = range.begin(); v != range.end(); ++v) {
      if (!free_[at(v)]) continue;
      Row row(*this, v);
      fill(v, row);
    }
  });
}

void FitSystem::add(int v, int w, const Vec6d& b) {
  if (!free_[at(v)] || !free_[at(w)]) return;
  block_[at(pattern_.place(v, w))] += b;
  if (v != w) block_[at(pattern_.place(w, v))] += b;
}

void FitSystem::add_right(int v, const Vec3d& value) {
  if (free_[at(v)]) right_[at(v)] += value;
}

std::vector<Vec6d> FitSystem::inverse_diagonal() const {
  std::vector<Vec6d> result(right_.size(), Vec6d(0.0));
  for (int v = 0; v < pattern_.rows(); ++v) {
    if (!free_[at(v)]) continue;
    result[at(v)] = inverse(block_[at(pattern_.place(v, v))]);
    if (!std::isfinite(result[at(v)] | result[at(v)]))
      throw SolverFailure("no step of vertex " + std::to_string(v) +
                          " of the result is best; look for degenerate polygons");
  }
  return result;
}

void FitSystem::multiply(const std::vector<Vec3d>& x, std::vector<Vec3d>& result) const {
  tbb::parallel_for(tbb::blocked_range<int>(0, pattern_.rows(), rows_at_once), [&](const auto& range) {
    for (int v = range.begin(); v != range.end(); ++v) {
      Vec3d sum(0, 0, 0);
      for (int i = pattern_.begin(v); i < pattern_.end(v); ++i)
        sum += apply(block_[at(i)], x[at(pattern_.column(i))]);
      result[at(v)] = sum;
    }
  });
}

// Conjugate gradients. The matrix is that of masses and, less, of springs, so that the number of iterations
// does not grow with that of vertices.
std::vector<Vec3d> FitSystem::solve() const {
  const size_t n = right_.size();
  const std::vector<Vec6d> scale = inverse_diagonal();
  std::vector<Vec3d> step(n, Vec3d(0, 0, 0)), residual = right_, scaled(n), direction(n), image(n);
  for (size_t v = 0; v < n; ++v) direction[v] = scaled[v] = apply(scale[v], residual[v]);
  double square = dot(residual, scaled);
  const double enough = near_enough * near_enough * square;
  int iteration = 0;
  for (; iteration < most_iterations && square > enough; ++iteration) {
    multiply(direction, image);
    const double length = square / dot(direction, image), before = square;
    for (size_t v = 0; v < n; ++v) {
      step[v] += length * direction[v];
      residual[v] -= length * image[v];
      scaled[v] = apply(scale[v], residual[v]);
    }
    square = dot(residual, scaled);
    for (size_t v = 0; v < n; ++v) direction[v] = scaled[v] + (square / before) * direction[v];
  }
  if (!std::isfinite(square)) throw SolverFailure("the system of the fit has no finite solution");
  return step;
}

}  // namespace anisomesh::detail
