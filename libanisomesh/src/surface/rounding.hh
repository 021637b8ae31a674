// Comparisons that rounding does not decide: what differs by less counts as the same, so that a surface that
// is scaled or turned takes the same way.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace anisomesh::detail {

/// A share that says nothing.
constexpr double kRounding = 1e-9;

inline bool is_surely_less(double a, double b) {
  return a < b && (std::isinf(b) || a < b - kRounding * std::abs(b));
}

/// What is compared with others is rounded to so much of their mean first.
constexpr double kTie = 1e-6;

/// In such steps, for sorting: ties then go by what else is compared.
inline std::vector<double> in_steps(std::vector<double> values) {
  double step = 0;
  for (const double v : values) step += std::abs(v);
  step *= kTie / static_cast<double>(std::max<size_t>(values.size(), 1));
  if (step > 0)
    for (double& v : values) v = std::round(v / step);
  return values;
}

}  // namespace anisomesh::detail
