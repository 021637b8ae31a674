#include "numerics/sparse_solver.hh"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "anisomesh/errors.hh"
#include "catch.hh"
#include "numerics/dissection.hh"

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

TEST_CASE("dissection orders every unknown once, and its parts touch nothing but separators", "[sparse]") {
  auto pairs = grid(40, 25);
  for (const auto& pair : grid(10, 10))
    pairs.emplace_back(1000 + pair.first, 1000 + pair.second);  // a second part
  const auto dissected = nested_dissection(1100, pairs, 50);
  auto sorted = dissected.order;
  std::sort(sorted.begin(), sorted.end());
  std::vector<int> all(1100);
  std::iota(all.begin(), all.end(), 0);
  CHECK(sorted == all);
  std::vector<int> part(1100, -1);
  for (size_t p = 0; p < dissected.parts.size(); ++p) {
    CHECK(dissected.parts[p].second - dissected.parts[p].first <= 50);
    for (size_t i = dissected.parts[p].first; i < dissected.parts[p].second; ++i)
      part[dissected.order[i]] = static_cast<int>(p);
  }
  int touching = 0;
  for (const auto& [a, b] : pairs) touching += part[a] >= 0 && part[b] >= 0 && part[a] != part[b] ? 1 : 0;
  CHECK(touching == 0);
}

TEST_CASE("sparse systems are solved, small ones and dissected ones", "[sparse]") {
  const int side = GENERATE(1, 7, 330);  // 330 squared is above the size where dissection begins
  const auto pairs = grid(side, side);
  SymmetricEntries matrix;
  matrix.size = static_cast<size_t>(side) * side;
  for (int i = 0; i < side * side; ++i) matrix.add(i, i, 1);
  for (const auto& [i, j] : pairs) {
    matrix.add(i, i, 1);
    matrix.add(j, j, 1);
    matrix.add(i, j, -1);
  }
  std::vector<double> b(matrix.size);
  for (size_t i = 0; i < b.size(); ++i) b[i] = std::sin(static_cast<double>(i));
  const auto x = CholeskySolver(matrix).solve(b);
  CHECK(residual(pairs, x, b) < 1e-11);
}

TEST_CASE("a singular system is a solver failure, not a vector of infinities", "[sparse]") {
  SymmetricEntries matrix;
  matrix.size = 2;
  matrix.add(0, 0, 1);
  matrix.add(1, 1, 1);
  matrix.add(0, 1, -1);
  CHECK_THROWS_AS(CholeskySolver(matrix).solve({1, 1}), SolverFailure);
}
