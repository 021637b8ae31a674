#include "numerics/sparse_solver.hh"

#include <algorithm>
#include <cmath>

#include "anisomesh/errors.hh"
#include "catch.hh"

using namespace anisomesh;
using namespace anisomesh::detail;

namespace {

/// The pairs of a grid of so many columns and rows.
std::vector<std::pair<int, int>> grid(int columns, int rows) {
  std::vector<std::pair<int, int>> pairs;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      if (i + 1 < columns) pairs.emplace_back(j * columns + i, j * columns + i + 1);
      if (j + 1 < rows) pairs.emplace_back((j + 1) * columns + i, j * columns + i);
    }
  return pairs;
}

/// The largest difference of A x from b, with A = Laplacian of the pairs + identity.
double residual(const std::vector<std::pair<int, int>>& pairs, const std::vector<double>& x,
                const std::vector<double>& b) {
  std::vector<double> ax = x;
  for (const auto& [i, j] : pairs) {
    ax[i] += x[i] - x[j];
    ax[j] += x[j] - x[i];
  }
  double worst = 0;
  for (size_t i = 0; i < x.size(); ++i) worst = std::max(worst, std::abs(ax[i] - b[i]));
  return worst;
}

}  // namespace

TEST_CASE("sparse systems are solved, small ones and large ones", "[sparse]") {
  const int side = GENERATE(1, 7, 330);
  const auto pairs = grid(side, side);
  SymmetricEntries matrix(static_cast<size_t>(side) * side);
  for (int i = 0; i < side * side; ++i) matrix.add(i, i, 1);
  for (const auto& [i, j] : pairs) {
    matrix.add(i, i, 1);
    matrix.add(j, j, 1);
    matrix.add(i, j, -1);
  }
  std::vector<double> b(matrix.size());
  for (size_t i = 0; i < b.size(); ++i) b[i] = std::sin(static_cast<double>(i));
  const auto x = CholeskySolver(matrix).solve(b);
  CHECK(residual(pairs, x, b) < 1e-11);
}

TEST_CASE("a singular system is a solver failure, not a vector of infinities", "[sparse]") {
  SymmetricEntries matrix(2);
  matrix.add(0, 0, 1);
  matrix.add(1, 1, 1);
  matrix.add(0, 1, -1);
  CHECK_THROWS_AS(CholeskySolver(matrix).solve({1, 1}), SolverFailure);
}
