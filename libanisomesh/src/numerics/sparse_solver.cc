#include "numerics/sparse_solver.hh"

#include <Eigen/Sparse>
#ifdef ANISOMESH_WITH_CHOLMOD
#include <Eigen/CholmodSupport>
#else
#include <Eigen/SparseCholesky>
#endif
#include <cmath>
#include <string>

#include "anisomesh/errors.hh"

namespace anisomesh::detail {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

Matrix assemble(const SymmetricEntries& entries) {
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(entries.value.size());
  for (size_t k = 0; k < entries.value.size(); ++k)
    triplets.emplace_back(entries.row[k], entries.column[k], entries.value[k]);
  const auto n = static_cast<Eigen::Index>(entries.size);
  Matrix matrix(n, n);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

#ifdef ANISOMESH_WITH_CHOLMOD
// CHOLMOD's own choice of method takes the simplicial one for small systems and the supernodal one, which is
// several times faster, for large ones.
using Backend = Eigen::CholmodDecomposition<Matrix, Eigen::Lower>;
void configure(Backend& backend, size_t size) {
  auto& common = backend.cholmod();
  common.print = 0;
  common.nmethods = 1;
  // Nested dissection fills less and so grows slower than minimum degree, but takes longer to find.
  common.method[0].ordering = size > 20000 ? CHOLMOD_METIS : CHOLMOD_AMD;
}
#else
using Backend = Eigen::SimplicialLLT<Matrix, Eigen::Lower>;
void configure(Backend&, size_t) {}
#endif

}  // namespace

struct CholeskySolver::Factor {
  Backend backend;
};

CholeskySolver::CholeskySolver(const SymmetricEntries& matrix) : factor_(std::make_unique<Factor>()) {
  configure(factor_->backend, matrix.size);
  factor_->backend.compute(assemble(matrix));
  if (factor_->backend.info() != Eigen::Success)
    throw SolverFailure("a sparse system of " + std::to_string(matrix.size) +
                        " unknowns is not positive definite; look for degenerate triangles in the input");
}

CholeskySolver::~CholeskySolver() = default;

std::vector<double> CholeskySolver::solve(const std::vector<double>& right_hand_side) const {
  const Eigen::Map<const Eigen::VectorXd> b(right_hand_side.data(),
                                            static_cast<Eigen::Index>(right_hand_side.size()));
  const Eigen::VectorXd x = factor_->backend.solve(b);
  if (!x.allFinite()) throw SolverFailure("a sparse system has no finite solution");
  return {x.data(), x.data() + x.size()};
}

}  // namespace anisomesh::detail
