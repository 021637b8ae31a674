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

std::vector<int> elimination_positions(const SymmetricEntries& entries) {
  std::vector<std::pair<int, int>> adjacent;
  for (size_t k = 0; k < entries.value.size(); ++k)
    if (entries.row[k] != entries.column[k]) adjacent.emplace_back(entries.row[k], entries.column[k]);
  const auto order = nested_dissection(entries.size, adjacent);
  std::vector<int> position(order.size());
  for (size_t i = 0; i < order.size(); ++i) position[static_cast<size_t>(order[i])] = static_cast<int>(i);
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
