#include "numerics/sparse_solver.hh"

#include <Eigen/Sparse>
#ifdef ANISOMESH_WITH_CHOLMOD
#include <Eigen/CholmodSupport>
#else
#include <Eigen/SparseCholesky>
#endif
#include <algorithm>
#include <string>

#include "anisomesh/errors.hh"
#include "numerics/dissection.hh"

namespace anisomesh::detail {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

Matrix assemble(const SymmetricEntries& entries, const std::vector<int>& position) {
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(entries.value.size());
  for (size_t k = 0; k < entries.value.size(); ++k) {
    const int i = position[static_cast<size_t>(entries.row[k])],
              j = position[static_cast<size_t>(entries.column[k])];
    triplets.emplace_back(std::max(i, j), std::min(i, j), entries.value[k]);
  }
  const auto n = static_cast<Eigen::Index>(entries.size);
  Matrix matrix(n, n);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

/// Orders one part by minimum degree, as if the rest of the matrix were not there.
void order_by_minimum_degree(std::vector<int>& order, std::pair<size_t, size_t> part,
                             const std::vector<std::vector<int>>& lower, std::vector<int>& local) {
  const size_t size = part.second - part.first;
  for (size_t i = 0; i < size; ++i) local[static_cast<size_t>(order[part.first + i])] = static_cast<int>(i);
  std::vector<Eigen::Triplet<double>> entries;
  for (size_t i = 0; i < size; ++i) {
    const int row = static_cast<int>(i);
    entries.emplace_back(row, row, 1);
    for (const int other : lower[static_cast<size_t>(order[part.first + i])]) {
      const int column = local[static_cast<size_t>(other)];
      if (column < 0) continue;
      entries.emplace_back(row, column, 1);
      entries.emplace_back(column, row, 1);
    }
  }
  Matrix pattern(static_cast<int>(size), static_cast<int>(size));
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(pattern, permutation);
  std::vector<int> ordered(size);
  for (size_t i = 0; i < size; ++i)
    ordered[i] = order[part.first + static_cast<size_t>(permutation.indices()[static_cast<int>(i)])];
  for (size_t i = 0; i < size; ++i) {
    local[static_cast<size_t>(ordered[i])] = -1;
    order[part.first + i] = ordered[i];
  }
}

/// Minimum degree is the best order for small systems, but its fill grows too fast: large ones are dissected
/// first, into parts of so many unknowns.
constexpr size_t large_system = 100000, largest_part = 2000;

std::vector<int> elimination_positions(const SymmetricEntries& entries) {
  std::vector<std::pair<int, int>> adjacent;
  std::vector<std::vector<int>> lower(entries.size);
  for (size_t k = 0; k < entries.value.size(); ++k)
    if (entries.row[k] != entries.column[k]) adjacent.emplace_back(entries.row[k], entries.column[k]);
  std::sort(adjacent.begin(), adjacent.end());
  adjacent.erase(std::unique(adjacent.begin(), adjacent.end()), adjacent.end());
  for (const auto& [row, column] : adjacent) lower[static_cast<size_t>(row)].push_back(column);
  auto dissected =
      nested_dissection(entries.size, adjacent, entries.size < large_system ? large_system : largest_part);
  std::vector<int> local(entries.size, -1);
  for (const auto& part : dissected.parts) order_by_minimum_degree(dissected.order, part, lower, local);
  std::vector<int> position(entries.size);
  for (size_t i = 0; i < position.size(); ++i)
    position[static_cast<size_t>(dissected.order[i])] = static_cast<int>(i);
  return position;
}

#ifdef ANISOMESH_WITH_CHOLMOD
// CHOLMOD itself takes the simplicial method for small systems and the supernodal one, which is several times
// faster, for large ones.
using Backend = Eigen::CholmodDecomposition<Matrix, Eigen::Lower>;
void configure(Backend& backend) {
  auto& common = backend.cholmod();
  common.print = 0;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_NATURAL;
}
#else
using Backend = Eigen::SimplicialLLT<Matrix, Eigen::Lower, Eigen::NaturalOrdering<int>>;
void configure(Backend&) {}
#endif

}  // namespace

struct CholeskySolver::Factor {
  Backend backend;
};

CholeskySolver::CholeskySolver(const SymmetricEntries& matrix)
    : factor_(std::make_unique<Factor>()), position_(elimination_positions(matrix)) {
  configure(factor_->backend);
  factor_->backend.compute(assemble(matrix, position_));
  if (factor_->backend.info() != Eigen::Success)
    throw SolverFailure("a sparse system of " + std::to_string(matrix.size) +
                        " unknowns is not positive definite; look for degenerate triangles in the input");
}

CholeskySolver::~CholeskySolver() = default;

std::vector<double> CholeskySolver::solve(const std::vector<double>& right_hand_side) const {
  Eigen::VectorXd b(static_cast<Eigen::Index>(right_hand_side.size()));
  for (size_t i = 0; i < right_hand_side.size(); ++i) b[position_[i]] = right_hand_side[i];
  const Eigen::VectorXd x = factor_->backend.solve(b);
  if (!x.allFinite()) throw SolverFailure("a sparse system has no finite solution");
  std::vector<double> solution(right_hand_side.size());
  for (size_t i = 0; i < solution.size(); ++i) solution[i] = x[position_[i]];
  return solution;
}

}  // namespace anisomesh::detail
