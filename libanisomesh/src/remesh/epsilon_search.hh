// The search in count over epsilon, whatever makes the results.
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "anisomesh/remesh.hh"

namespace anisomesh::detail {

/// Faces or vertices for each crossing that the density asks for: the median over the nine discs of the
/// benchmarks at 1,000 and 4,000 faces. Above 1 since spacings may change only slowly from place to place.
constexpr double kFirstRatio = 1.8;
constexpr double kMet = 0.1;  ///< a count within this fraction of the target meets it

struct EpsilonSearch {
  /// How many crossings a density asks for, and what else needs as many faces or vertices, epsilon in the
  /// unit of make(): falls as epsilon grows.
  std::function<double(double epsilon)> crossings;
  struct Made {
    size_t count = 0;  ///< faces or vertices
    bool has_result = true;
    bool is_least = false;  ///< no epsilon can give much less
  };
  /// Makes a result; unless one is wanted at `any` count, it may be the count alone where that is far from
  /// the target. \throw CannotProcess where there can be none with this epsilon
  std::function<Made(double epsilon, bool any)> make;
  /// The result that was made last is the best so far.
  std::function<void()> keep;
  /// Whether refusals have taken so much work that a few are enough; none: never.
  std::function<bool()> is_spent;
  /// Fractions of the target by which a count may be below and above it, if these are more than the
  /// tolerance.
  double enough_below = 0, enough_above = 0;
  /// No epsilon above this is tried: where its count is above the target it is what was looked for.
  double coarsest = std::numeric_limits<double>::infinity();
};

struct FoundEpsilon {
  std::vector<Attempt> tried;  ///< those with a result
  int attempts = 0;            ///< those without a result too
  bool met = false;            ///< the best result is within 10 % of the target, or the coarsest there may be
};

/// The epsilon for which the density asks for so many crossings, in [1e-8, 0.5].
double epsilon_of(double wanted, const std::function<double(double epsilon)>& crossings);

/// Seeks the epsilon whose result has `wanted` faces or vertices: a guess from the density, then a secant.
/// One that is refused is followed by a smaller one, a few times; where no attempt has a result, coarser and
/// finer ones are tried, past the number of attempts too. \throw CannotProcess of the last attempt if none
/// had a result; what `make` throws else
FoundEpsilon search_epsilon(double wanted, const TargetOptions& options, const EpsilonSearch& search);

}  // namespace anisomesh::detail
