// The sparse least squares of one pass of the fit: unknown steps of vertices, three to a vertex.
#pragma once

#include <functional>
#include <vector>

#include "fit/fit_mesh.hh"
#include "numerics/tensor3d.hh"

namespace anisomesh::detail {

/// Which vertices have to do with each other: those of one polygon. It does not change while vertices move.
class FitPattern {
 public:
  FitPattern() = default;
  explicit FitPattern(const FitMesh& mesh);

  int rows() const { return static_cast<int>(first_.size()) - 1; }
  int begin(int v) const { return first_[static_cast<size_t>(v)]; }
  int end(int v) const { return first_[static_cast<size_t>(v) + 1]; }
  int column(int place) const { return column_[static_cast<size_t>(place)]; }
  /// Where in row v the column w is. \pre they have to do with each other
  int place(int v, int w) const;

 private:
  std::vector<int> first_{0}, column_;  // of each vertex, ascending, itself too
};

/// A quadratic form of the steps x: sum of x_v (A_vw x_w) - 2 b_v x_v.
class FitSystem {
 public:
  /// \param free vertices that may move \param pattern is referred to
  FitSystem(const std::vector<char>& free, const FitPattern& pattern);

  /// One row of the matrix and the right side, while they are put together.
  class Row {
   public:
    Row(FitSystem& system, int v) : system_(system), v_(v) {}
    /// A_vw += block.
    void add(int w, const Vec6d& block) {
      system_.block_[static_cast<size_t>(system_.pattern_.place(v_, w))] += block;
    }
    void add_right(const Vec3d& value) { system_.right_[static_cast<size_t>(v_)] += value; }

   private:
    FitSystem& system_;
    int v_;
  };
  /// Calls fill(v, row) for each free vertex, several at a time; what one adds has to be the same each time.
  void fill(const std::function<void(int, Row&)>& fill);

  /// A_vw += block and, where v and w differ, A_wv too.
  void add(int v, int w, const Vec6d& block);
  void add_right(int v, const Vec3d& value);
  /// (direction | sum of factor_i x_i - wanted)^2 * weight
  template <size_t N>
  void add_row(const int (&v)[N], const double (&factor)[N], const Vec3d& direction, double wanted,
               double weight);
  /// The steps with the least value, nearly; zero for vertices that are not free. \throw SolverFailure
  std::vector<Vec3d> solve() const;

 private:
  std::vector<Vec6d> inverse_diagonal() const;
  void multiply(const std::vector<Vec3d>& x, std::vector<Vec3d>& result) const;

  const std::vector<char>& free_;
  const FitPattern& pattern_;
  std::vector<Vec6d> block_;  // of each place of the pattern
  std::vector<Vec3d> right_;
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
