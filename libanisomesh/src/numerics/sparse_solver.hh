// Symmetric positive definite sparse systems. The heavy headers behind it are in one source.
#pragma once

#include <memory>
#include <vector>

namespace anisomesh::detail {

/// A symmetric matrix while it is put together: entries of the lower triangle (row >= column) and the
/// diagonal; equal places add up.
struct SymmetricEntries {
  size_t size = 0;
  std::vector<int> row, column;
  std::vector<double> value;
  void add(int i, int j, double v) {
    row.push_back(i < j ? j : i);
    column.push_back(i < j ? i : j);
    value.push_back(v);
  }
};

/// The Cholesky factor of a symmetric positive definite matrix: CHOLMOD's where it was found at build time,
/// Eigen's otherwise. The result does not depend on the number of threads.
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
  std::vector<int> position_;  ///< of each unknown in the order of elimination
};

}  // namespace anisomesh::detail
