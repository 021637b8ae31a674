// Symmetric positive definite sparse systems. The heavy headers behind it are in one source.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace anisomesh::detail {

/// A symmetric matrix while it is put together: entries of the lower triangle and the diagonal; equal places
/// add up.
class SymmetricEntries {
 public:
  /// One entry beside the diagonal, row > column.
  class Entry {
   public:
    Entry(int row, int col, double value) : row_(row), col_(col), value_(value) {}
    int row() const { return row_; }
    int col() const { return col_; }
    double value() const { return value_; }

   private:
    int row_, col_;
    double value_;
  };

  explicit SymmetricEntries(std::size_t size) : diagonal_(size, 0.0) {}

  void reserve(std::size_t entries) { entries_.reserve(entries + size()); }

  void add(int i, int j, double v) {
    if (i == j)
      diagonal_[static_cast<std::size_t>(i)] += v;
    else
      entries_.emplace_back(i < j ? j : i, i < j ? i : j, v);
  }

  std::size_t size() const { return diagonal_.size(); }
  const std::vector<double>& diagonal() const { return diagonal_; }
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::vector<double> diagonal_;
  std::vector<Entry> entries_;
};

/// The Cholesky factor of a symmetric positive definite matrix, eliminated by minimum degree: CHOLMOD's where
/// it was found at build time, Eigen's otherwise. The result does not depend on the number of threads.
class CholeskySolver {
 public:
  /// \pre positive definite \throw SolverFailure if the factorization breaks down
  explicit CholeskySolver(const SymmetricEntries& matrix);
  ~CholeskySolver();
  CholeskySolver(const CholeskySolver&) = delete;
  CholeskySolver& operator=(const CholeskySolver&) = delete;

  /// \throw SolverFailure if the system is singular
  std::vector<double> solve(const std::vector<double>& right_hand_side) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace anisomesh::detail
