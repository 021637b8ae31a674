// The sparse least squares of one pass of the fit: unknown steps of vertices, three to a vertex.
#pragma once

#include <vector>

#include "numerics/sparse_solver.hh"
#include "numerics/tensor3d.hh"

namespace anisomesh::detail {

/// A quadratic form of the steps x: sum of x_v (A_vw x_w) - 2 b_v x_v.
class FitSystem {
 public:
  /// \param free vertices that may move \param blocks about so many will be added
  FitSystem(const std::vector<char>& free, size_t blocks);

  /// A_vw += block and, where v and w differ, A_wv too.
  void add(int v, int w, const Vec6d& block);
  void add_right(int v, const Vec3d& value);
  /// (direction | sum of factor_i x_i - wanted)^2 * weight
  template <size_t N>
  void add_row(const int (&v)[N], const double (&factor)[N], const Vec3d& direction, double wanted,
               double weight);
  /// The steps with the least value; zero for vertices that are not free. \throw SolverFailure
  std::vector<Vec3d> solve() const;

 private:
  int n_ = 0;
  std::vector<int> unknown_;  // of each vertex, or -1
  SymmetricEntries entries_;
  std::vector<double> right_;
};

template <size_t N>
void FitSystem::add_row(const int (&v)[N], const double (&factor)[N], const Vec3d& direction, double wanted,
                        double weight) {
  const Vec6d square = weight * outer(direction);
  for (size_t i = 0; i < N; ++i) {
    add_right(v[i], weight * wanted * factor[i] * direction);
    for (size_t j = 0; j <= i; ++j) add(v[i], v[j], factor[i] * factor[j] * square);
  }
}

}  // namespace anisomesh::detail
