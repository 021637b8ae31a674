#include "remesh/epsilon_search.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "anisomesh/errors.hh"

namespace anisomesh::detail {

namespace {

/// Where polygons cannot be made, those of an epsilon so much smaller often can, a few times.
constexpr double kNextAfterRefusal = 0.85;
constexpr size_t kMostRefusals = 4, kFewRefusals = 3;
constexpr int kMostSteps = 3;   ///< of 2, to both sides, where all else was refused
constexpr double kSame = 1e-3;  ///< logarithm: an epsilon so near to another one gives the same
/// A count that falls by a smaller power of epsilon is not the density's any more: features, the border or
/// what the tolerances ask for need as many, and a larger epsilon only spoils what is there.
constexpr double kStalled = 0.2;
/// But one step may also have met a bump in the count, or epsilon be far below what the features ask for: a
/// longer one shows which it is.
constexpr double kLongStep = 2;
constexpr double kLowest = 1e-8, kHighest = 0.5;  ///< epsilon, fraction of the extent

struct Trial {
  double log_epsilon = 0;
  double log_ratio = 0;  ///< log of count over target
  bool stalled = false;  ///< a smaller one has nearly the same
  double off() const { return std::abs(std::exp(log_ratio) - 1); }
};

const Trial& nearest_of(const std::vector<Trial>& trials) {
  return *std::min_element(trials.begin(), trials.end(), [](const auto& a, const auto& b) {
    return std::abs(a.log_ratio) < std::abs(b.log_ratio);
  });
}

/// Where to look next: the secant through the two attempts that enclose the target, kept inside what is
/// known, or the model scaled to one attempt.
double next_epsilon(const std::vector<Trial>& attempts, const std::function<double(double)>& crossings) {
  const Trial *above = nullptr, *below = nullptr;  // the tightest attempts with too many and too few
  for (const Trial& a : attempts) {
    if (a.log_ratio > 0 && (!above || a.log_epsilon > above->log_epsilon)) above = &a;
    if (a.log_ratio <= 0 && (!below || a.log_epsilon < below->log_epsilon)) below = &a;
  }
  if (above && below && above->log_epsilon < below->log_epsilon) {
    const double t = std::clamp(above->log_ratio / (above->log_ratio - below->log_ratio), 0.1, 0.9);
    return std::exp(above->log_epsilon + t * (below->log_epsilon - above->log_epsilon));
  }
  // Beyond the last one that has too many, or before the first that has too few, however near another comes.
  const Trial& from = above && below ? nearest_of(attempts) : above ? *above : *below;
  const double count_there = crossings(std::exp(from.log_epsilon));
  // Past the first attempts the model has shown to be wrong in the slope too: step further each time.
  const double push = 1 + 0.25 * static_cast<double>(attempts.size() - 1);
  return epsilon_of(count_there * std::exp(-push * from.log_ratio), crossings);
}

/// Whether the last step to a larger epsilon brought next to nothing, though there are still too many. Where
/// another one has given too few, it is the count that goes up and down, and the target lies between.
bool is_stalled(const std::vector<Trial>& attempts) {
  if (attempts.size() < 2) return false;
  if (std::any_of(attempts.begin(), attempts.end(), [](const Trial& t) { return t.log_ratio < 0; }))
    return false;
  const Trial &last = attempts.back(), &before = attempts[attempts.size() - 2];
  const double step = last.log_epsilon - before.log_epsilon;
  return last.log_ratio > 0 && step > 0 && before.log_ratio - last.log_ratio < kStalled * step;
}

/// Between an epsilon that was refused and the nearest one with a result; without any, 0.85 of it.
double after_refusal(double refused, const std::vector<Trial>& trials) {
  if (trials.empty()) return kNextAfterRefusal * refused;
  const double from = std::log(refused);
  const auto nearest = std::min_element(trials.begin(), trials.end(), [from](const auto& a, const auto& b) {
    return std::abs(a.log_epsilon - from) < std::abs(b.log_epsilon - from);
  });
  return std::exp(0.5 * (from + nearest->log_epsilon));
}

bool is_same(double log_epsilon, double other) { return std::abs(log_epsilon - other) < kSame; }

bool is_refused(double epsilon, const std::vector<double>& refused) {
  return std::any_of(refused.begin(), refused.end(),
                     [epsilon](double r) { return is_same(std::log(epsilon), std::log(r)); });
}

bool is_tried(double epsilon, const std::vector<Trial>& trials) {
  return std::any_of(trials.begin(), trials.end(),
                     [epsilon](const Trial& t) { return is_same(std::log(epsilon), t.log_epsilon); });
}

Trial trial_of(double epsilon, size_t count, double wanted) {
  return {std::log(epsilon), std::log(std::max(static_cast<double>(count), 0.5) / wanted), false};
}

/// Where there may be a result after all: the attempts with a count alone, the nearest first, the nearest
/// with its next smaller ones, and last what only spoils; then farther and farther off, to both sides.
std::vector<double> last_resorts(std::vector<Trial> trials, const std::vector<double>& refused) {
  std::vector<double> result;
  std::sort(trials.begin(), trials.end(), [](const Trial& a, const Trial& b) {
    return a.stalled != b.stalled ? b.stalled : std::abs(a.log_ratio) < std::abs(b.log_ratio);
  });
  for (const Trial& trial : trials) {
    result.push_back(std::exp(trial.log_epsilon));
    while (result.size() <= kMostRefusals) result.push_back(kNextAfterRefusal * result.back());
  }
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const auto* tried : std::array<const std::vector<double>*, 2>{&refused, &result})
    for (const double epsilon : *tried) {
      low = std::min(low, epsilon);
      high = std::max(high, epsilon);
    }
  for (int i = 0; i < kMostSteps; ++i) {
    result.push_back(std::max(kLowest, low *= 0.5));
    if ((high *= 2) <= kHighest) result.push_back(high);
  }
  return result;
}

/// Whether no other epsilon is worth the work of one more refusal.
bool is_enough(const std::vector<double>& refused, const EpsilonSearch& search) {
  return refused.size() >= kFewRefusals && search.is_spent && search.is_spent();
}

/// A result where there were only counts or refusals so far: no surface is refused while some epsilon has
/// one. \throw CannotProcess after too many refusals
Trial make_at_any_count(const std::vector<Trial>& trials, std::vector<double> refused, double wanted,
                        const EpsilonSearch& search, FoundEpsilon& found) {
  const std::vector<double> resorts = last_resorts(trials, refused);
  for (size_t i = 0;; ++i) {
    if (i + 1 < resorts.size() && is_refused(resorts[i], refused)) continue;
    ++found.attempts;
    try {
      const size_t count = search.make(resorts[i], true).count;
      search.keep();
      found.tried.push_back({resorts[i], count});
      return trial_of(resorts[i], count, wanted);
    } catch (const CannotProcess&) {
      refused.push_back(resorts[i]);
      if (i + 1 == resorts.size() || is_enough(refused, search)) throw;
    }
  }
}

}  // namespace

double epsilon_of(double wanted, const std::function<double(double)>& crossings) {
  double low = std::log(kLowest), high = std::log(kHighest);
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (crossings(std::exp(middle)) > wanted ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

FoundEpsilon search_epsilon(double wanted, const TargetOptions& options, const EpsilonSearch& search) {
  FoundEpsilon found;
  std::vector<Trial> trials;
  std::vector<double> refused;
  double best_off = std::numeric_limits<double>::infinity();
  int stalls = 0;
  double epsilon = epsilon_of(wanted / kFirstRatio, search.crossings);
  bool at_coarsest = false;
  for (;;) {
    const bool is_last = ++found.attempts >= options.max_attempts;
    const bool is_coarsest = epsilon >= search.coarsest;
    epsilon = std::min(epsilon, search.coarsest);
    EpsilonSearch::Made made;
    try {
      made = search.make(epsilon, is_last || is_coarsest);
    } catch (const CannotProcess&) {
      refused.push_back(epsilon);
      if (refused.size() > kMostRefusals || is_last) break;
      if (is_enough(refused, search)) {
        if (trials.empty()) throw;
        break;
      }
      epsilon = after_refusal(epsilon, trials);
      continue;
    }
    found.tried.push_back({epsilon, made.count});
    trials.push_back(trial_of(epsilon, made.count, wanted));
    const double off = trials.back().off();
    const bool stalled = trials.back().stalled = is_stalled(trials);
    const bool enough = off <= (trials.back().log_ratio < 0 ? search.enough_below : search.enough_above);
    at_coarsest = is_coarsest && !stalled && trials.back().log_ratio > 0;
    const bool met =
        off <= options.tolerance || enough || at_coarsest || (found.attempts >= 3 && off <= kMet);
    if (made.has_result && (met || (!stalled && off < best_off))) {
      best_off = off;
      search.keep();
    }
    epsilon = next_epsilon(trials, search.crossings);
    const bool looks_farther = stalled && ++stalls == 1 && !is_coarsest;
    if (looks_farther)
      epsilon = std::min(kHighest, std::exp(trials.back().log_epsilon +
                                            std::max(std::log(kLongStep), trials.back().log_ratio)));
    while (is_refused(epsilon, refused) && !is_tried(epsilon, trials))
      epsilon = after_refusal(epsilon, trials);
    const bool stuck = is_tried(epsilon, trials) || (made.is_least && trials.back().log_ratio > 0);
    if (met || is_last || stuck || (stalled && !looks_farther) || (found.attempts >= 3 && best_off <= kMet))
      break;
  }
  if (!std::isfinite(best_off)) best_off = make_at_any_count(trials, refused, wanted, search, found).off();
  found.met = best_off <= kMet || at_coarsest;
  return found;
}

}  // namespace anisomesh::detail
