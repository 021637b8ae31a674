#include "numerics/sparse_solver.hh"

#include <Eigen/Sparse>
#ifdef ANISOMESH_WITH_CHOLMOD
#include <Eigen/CholmodSupport>
#else
#include <Eigen/SparseCholesky>
#endif
#include <string>

#include "anisomesh/errors.hh"

#if defined(ANISOMESH_WITH_CHOLMOD) && defined(__ELF__)
// There only if CHOLMOD was built with OpenMP, or if the BLAS it calls is OpenBLAS.
extern "C" {
[[gnu::weak]] int omp_get_max_active_levels();
[[gnu::weak]] void omp_set_max_active_levels(int levels);
[[gnu::weak]] int openblas_get_num_threads();
[[gnu::weak]] void openblas_set_num_threads(int threads);
}
#define ANISOMESH_TAMES_THREADS
#endif

namespace anisomesh::detail {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

Matrix assemble(const SymmetricEntries& matrix) {
  auto entries = matrix.entries();
  for (size_t i = 0; i < matrix.size(); ++i)
    entries.emplace_back(static_cast<int>(i), static_cast<int>(i), matrix.diagonal()[i]);
  const auto n = static_cast<Eigen::Index>(matrix.size());
  Matrix result(n, n);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

/// Keeps CHOLMOD and the BLAS below it in this thread while it lives. CHOLMOD wakes a team of threads for
/// every few columns, which takes longer than it saves; and a BLAS that divides its work among threads may
/// round differently for each number of them.
class OneThread {
 public:
  OneThread() {
#ifdef ANISOMESH_TAMES_THREADS
    if (omp_get_max_active_levels && omp_set_max_active_levels) {
      levels_ = omp_get_max_active_levels();
      omp_set_max_active_levels(0);
    }
    if (openblas_get_num_threads && openblas_set_num_threads) {
      threads_ = openblas_get_num_threads();
      if (threads_ > 1) openblas_set_num_threads(1);
    }
#endif
  }
  ~OneThread() {
#ifdef ANISOMESH_TAMES_THREADS
    if (levels_ > 0) omp_set_max_active_levels(levels_);
    if (threads_ > 1) openblas_set_num_threads(threads_);
#endif
  }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int levels_ = 0, threads_ = 0;
};

#ifdef ANISOMESH_WITH_CHOLMOD
// CHOLMOD itself takes the simplicial method for small systems and the supernodal one, which is several times
// faster, for large ones.
using Backend = Eigen::CholmodDecomposition<Matrix, Eigen::Lower>;
void configure(Backend& backend) {
  auto& common = backend.cholmod();
  common.print = 0;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_AMD;
}
#else
using Backend = Eigen::SimplicialLLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<int> >;
void configure(Backend&) {}
#endif

}  // namespace

struct CholeskySolver::Factor {
  Backend backend;
};

CholeskySolver::CholeskySolver(const SymmetricEntries& matrix) : factor_(std::make_unique<Factor>()) {
  const OneThread one_thread;
  configure(factor_->backend);
  factor_->backend.compute(assemble(matrix));
  if (factor_->backend.info() != Eigen::Success)
    throw SolverFailure("a sparse system of " + std::to_string(matrix.size()) +
                        " unknowns is not positive definite; look for degenerate triangles in the input");
}

CholeskySolver::~CholeskySolver() = default;

std::vector<double> CholeskySolver::solve(const std::vector<double>& right_hand_side) const {
  const OneThread one_thread;
  const auto n = static_cast<Eigen::Index>(right_hand_side.size());
  const Eigen::VectorXd x = factor_->backend.solve(Eigen::VectorXd::Map(right_hand_side.data(), n));
  if (!x.allFinite()) throw SolverFailure("a sparse system has no finite solution");
  return {x.begin(), x.end()};
}

}  // namespace anisomesh::detail
