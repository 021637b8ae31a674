// The search for a count against results that are made up: a law of the count, and refusals where a test
// says.
#include "remesh/epsilon_search.hh"

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "anisomesh/errors.hh"
#include "catch.hh"

using namespace anisomesh;

namespace {

/// Counts by a law, refuses where it is told to, and remembers what it was asked for.
struct MadeUp {
  std::function<double(double)> count = [](double epsilon) { return 1.8 / epsilon; };
  std::function<bool(double epsilon, size_t attempt)> refused = [](double, size_t) { return false; };
  bool only_near = false;  ///< results far from the target are but a count
  std::function<bool(double)> sound = [](double) { return false; };  ///< ... but those that are sound at once
  std::vector<double> asked;
  double least = 0;           ///< no count is below
  double last = 0, kept = 0;  ///< epsilon
  int keeps = 0;
  double enough_below = 0, enough_above = 0;
  size_t spent_after = 0;  ///< attempts; 0: never
  double coarsest = std::numeric_limits<double>::infinity();

  detail::FoundEpsilon search(double wanted, int max_attempts = 8) {
    TargetOptions options;
    options.max_attempts = max_attempts;
    detail::EpsilonSearch steps;
    steps.crossings = [](double epsilon) { return 1 / epsilon; };
    steps.make = [this, wanted](double epsilon, bool any) {
      asked.push_back(epsilon);
      if (refused(epsilon, asked.size() - 1)) throw CannotProcess("made up");
      last = epsilon;
      const double made = count(epsilon);
      const bool far = only_near && !any && std::abs(made / wanted - 1) > 0.3 && !sound(epsilon);
      return detail::EpsilonSearch::Made{static_cast<size_t>(std::lround(made)), !far, made <= least};
    };
    steps.keep = [this] {
      kept = last;
      ++keeps;
    };
    if (spent_after > 0) steps.is_spent = [this] { return asked.size() >= spent_after; };
    steps.enough_below = enough_below;
    steps.enough_above = enough_above;
    steps.coarsest = coarsest;
    return detail::search_epsilon(wanted, options, steps);
  }
};

}  // namespace

TEST_CASE("where the count is what the density promises, the first epsilon meets it", "[epsilon_search]") {
  MadeUp made;
  const auto found = made.search(1000);
  CHECK(found.met);
  CHECK(found.attempts == 1);
  CHECK(made.kept == Approx(0.0018));
}

TEST_CASE("where there can be no fewer, a larger epsilon is not tried for fewer", "[epsilon_search]") {
  MadeUp made;
  made.least = 4000;
  made.count = [](double) { return 4000; };
  auto found = made.search(1000);
  CHECK(found.attempts == 1);
  CHECK(made.keeps == 1);
  CHECK_FALSE(found.met);
  made.count = [](double epsilon) { return std::max(4000.0, 1.8 / epsilon); };
  found = made.search(5000);
  CHECK(found.met);
}

TEST_CASE("a count that goes by another law is met all the same", "[epsilon_search]") {
  for (const double power : {0.6, 0.8, 1.3, 2.0}) {
    MadeUp made;
    made.count = [power](double epsilon) { return 0.4 * std::pow(epsilon, -power); };
    const auto found = made.search(1000);
    INFO("power " << power << ", " << found.attempts << " attempts");
    CHECK(found.met);
    CHECK(made.count(made.kept) == Approx(1000).epsilon(0.1));
  }
}

TEST_CASE("what is near enough may be farther below a target than above it", "[epsilon_search]") {
  for (const double off : {0.91, 0.93, 1.05, 1.07}) {
    MadeUp made;
    made.count = [off](double epsilon) { return 1.8 * off / epsilon; };
    made.enough_below = 0.08;
    made.enough_above = 0.06;
    INFO(off);
    CHECK(made.search(1000).attempts == (off == 0.93 || off == 1.05 ? 1 : 2));
  }
}

TEST_CASE("a refused epsilon is followed by 0.85 of it, and the search goes on from there",
          "[epsilon_search]") {
  for (const size_t refusals : {1, 2, 3, 4}) {
    MadeUp made;
    made.refused = [refusals](double, size_t attempt) { return attempt < refusals; };
    const auto found = made.search(1000);
    INFO(refusals << " refusals");
    REQUIRE(made.asked.size() > refusals);
    for (size_t i = 1; i <= refusals; ++i) CHECK(made.asked[i] == Approx(0.85 * made.asked[i - 1]));
    CHECK(found.met);  // the refusals are over: the first guess has a result now
    CHECK(found.attempts == static_cast<int>(made.asked.size()));
    CHECK(found.tried.size() + refusals == made.asked.size());
    CHECK(made.count(made.kept) == Approx(1000).epsilon(0.1));
  }
}

TEST_CASE("where everything is refused the search ends with the refusal, each epsilon tried once",
          "[epsilon_search]") {
  for (const int most : {2, 8}) {
    MadeUp made;
    made.refused = [](double, size_t) { return true; };
    CHECK_THROWS_AS(made.search(1000, most), CannotProcess);
    CHECK(made.asked[1] == Approx(0.85 * made.asked[0]));
    CHECK(made.asked.size() <= 12);  // each of them costs a remesh
    for (size_t i = 0; i < made.asked.size(); ++i)
      for (size_t j = 0; j < i; ++j) CHECK(std::abs(made.asked[i] / made.asked[j] - 1) > 1e-3);
    CHECK(made.keeps == 0);
  }
}

TEST_CASE("where refusals have taken too much work the search ends after a few", "[epsilon_search]") {
  MadeUp made;
  made.refused = [](double, size_t) { return true; };
  made.spent_after = 2;
  CHECK_THROWS_AS(made.search(1000), CannotProcess);
  CHECK(made.asked.size() == 3);

  MadeUp counts;  // what has a count only gets one try for a result
  counts.only_near = true;
  counts.count = [](double) { return 5000.0; };
  counts.refused = [](double, size_t attempt) { return attempt > 0; };
  counts.spent_after = 2;
  CHECK_THROWS_AS(counts.search(1000), CannotProcess);
  CHECK(counts.asked.size() == 5);
}

TEST_CASE("no surface is refused while a coarser or finer epsilon has a result", "[epsilon_search]") {
  for (const double only : {0.3, 0.55, 1.7, 3.0}) {  // times the first guess
    MadeUp made;
    made.refused = [&](double epsilon, size_t) {
      return only < 1 ? epsilon > only * 0.0018 : epsilon < only * 0.0018;
    };
    const auto found = made.search(1000);
    INFO("first result at " << only << " of the first guess");
    CHECK(made.keeps == 1);
    CHECK(found.tried.size() == 1);
    CHECK(found.attempts == static_cast<int>(made.asked.size()));
  }
}

TEST_CASE("where the nearest count has no result, one that is less near has", "[epsilon_search]") {
  MadeUp made;  // counts alone, 3 % fewer at the largest epsilon, and that one cannot be made: as joint's
  made.only_near = true;
  made.count = [](double epsilon) { return epsilon < 0.01 ? 4100.0 : 4000.0; };
  made.refused = [&](double epsilon, size_t) { return made.asked.size() > 2 && epsilon > 0.01; };
  const auto found = made.search(1000);
  CHECK(!found.met);
  CHECK(made.keeps == 1);
  CHECK(made.kept == Approx(0.0018));
}

TEST_CASE("a larger epsilon that brings next to nothing is not taken for being sound at once",
          "[epsilon_search]") {
  MadeUp made;  // as joint's with 40 degrees: the finer one is a count alone at first, and the better result
  made.count = [](double epsilon) { return epsilon < 0.002 ? 2100.0 : 2000.0; };
  made.only_near = true;
  made.sound = [](double epsilon) { return epsilon > 0.002; };
  const auto found = made.search(1000);
  CHECK(!found.met);
  CHECK(made.kept == Approx(0.0018));
}

TEST_CASE("refusals after a result leave that result", "[epsilon_search]") {
  MadeUp made;
  made.count = [](double epsilon) { return 3 / epsilon; };  // too many at first: a larger epsilon is tried
  made.refused = [](double, size_t attempt) { return attempt > 0; };
  const auto found = made.search(1000);
  CHECK(made.keeps == 1);
  CHECK(made.kept == made.asked[0]);
  CHECK(found.tried.size() == 1);
  CHECK(found.attempts == 6);
  CHECK_FALSE(found.met);
}

TEST_CASE("where nothing coarser than a limit has a result, the search comes near to the limit",
          "[epsilon_search]") {
  // 1,000 would be at 0.0018, and nothing above 0.0014, which has 1,286, has a result.
  MadeUp made;
  made.refused = [](double epsilon, size_t) { return epsilon > 0.0014; };
  const auto found = made.search(1000);
  CHECK_FALSE(found.met);
  CHECK(made.kept <= 0.0014);
  CHECK(made.kept > 0.94 * 0.0014);
  for (const Attempt& attempt : found.tried) CHECK(attempt.epsilon_fraction <= made.kept);
  for (size_t i = 0; i < made.asked.size(); ++i)  // each of them costs a whole remesh: none twice
    for (size_t j = 0; j < i; ++j) CHECK(std::abs(made.asked[i] / made.asked[j] - 1) > 1e-3);
}

TEST_CASE("refusals in a band are passed over", "[epsilon_search]") {
  MadeUp made;
  made.count = [](double epsilon) { return 2.7 / epsilon; };  // 1,000 is at 0.0027, the first guess at 0.0018
  made.refused = [](double epsilon, size_t) { return epsilon > 0.00265 && epsilon < 0.0028; };
  const auto found = made.search(1000);
  CHECK(found.met);
  CHECK(made.count(made.kept) == Approx(1000).epsilon(0.1));
}

TEST_CASE("a count that goes up and down does not end the search between too many and too few",
          "[epsilon_search]") {
  MadeUp made;  // too few at the first guess of 0.0018, more and more below, and the target between
  made.count = [](double epsilon) {
    return epsilon > 0.00165 ? 600.0 : epsilon > 0.00155 ? 1000.0 : epsilon > 0.0013 ? 1900.0 : 1400.0;
  };
  const auto found = made.search(1000);
  REQUIRE(found.tried.size() > 2);
  CHECK(found.tried[1].count < found.tried[2].count);
  CHECK(found.tried[1].epsilon_fraction < found.tried[2].epsilon_fraction);
  CHECK(found.met);
}

TEST_CASE("a count that no epsilon brings down ends the search with the finer result", "[epsilon_search]") {
  MadeUp made;
  made.count = [](double epsilon) { return 3000 + 1e-4 / epsilon; };
  const auto found = made.search(1000);
  REQUIRE(found.attempts == 3);
  CHECK(made.asked[1] > made.asked[0]);
  CHECK(made.asked[2] > 2.9 * made.asked[1]);  // as many times as there are too many
  CHECK(made.kept == made.asked[0]);
  CHECK_FALSE(found.met);
}

TEST_CASE("tolerances far below what features ask for do not end the search", "[epsilon_search]") {
  MadeUp made;  // as that of a plate with engraved text: 9,941 and 7,318 faces for 2,000, and fewer beyond
  made.count = [](double epsilon) {
    return epsilon < 0.02 ? 4000 * std::pow(0.02 / epsilon, 0.18) : 4000 * std::pow(0.02 / epsilon, 0.8);
  };
  const auto found = made.search(1000);
  REQUIRE(found.tried.size() > 2);
  CHECK(found.tried[1].count > 4000);
  CHECK(found.met);
}

TEST_CASE("a bump in the count near the target does not end the search", "[epsilon_search]") {
  MadeUp made;  // as cheese's: 2,313 and 2,308 faces for 2,000, and fewer beyond
  made.count = [](double epsilon) {
    return epsilon < 0.0021 ? 1160 : 1155 * std::pow(0.0021 / epsilon, 0.5);
  };
  const auto found = made.search(1000);
  REQUIRE(found.tried.size() > 2);
  CHECK(found.tried[1].count > 1150);
  CHECK(found.met);
}

TEST_CASE("the search ends with what else goes wrong at once", "[epsilon_search]") {
  MadeUp made;
  made.refused = [](double, size_t) -> bool { throw Cancelled(); };
  CHECK_THROWS_AS(made.search(1000), Cancelled);
  CHECK(made.asked.size() == 1);
}

TEST_CASE("counts without a result lead to one all the same", "[epsilon_search]") {
  MadeUp made;
  made.only_near = true;
  made.count = [](double epsilon) { return 9 / epsilon; };
  const auto found = made.search(1000);
  CHECK(found.met);
  CHECK(made.count(made.kept) == Approx(1000).epsilon(0.1));
  CHECK(found.tried.front().count == 5000);

  // Where no count comes near, the nearest is made in the end, or one of less.
  made.count = [](double) { return 4000.0; };
  for (const size_t refusals : {0, 2}) {
    made.asked.clear();
    made.keeps = 0;
    size_t in_the_end = 0;
    made.refused = [&](double, size_t) { return made.asked.size() > 3 && in_the_end++ < refusals; };
    const auto far = made.search(1000);
    CHECK(!far.met);
    CHECK(made.keeps == 1);
    CHECK(made.kept == Approx(std::pow(0.85, refusals) * made.asked[0]));
    CHECK(far.attempts == static_cast<int>(made.asked.size()));
  }
}

TEST_CASE("beyond the coarsest epsilon none is tried, and too many there are what was looked for",
          "[epsilon_search]") {
  MadeUp made;
  made.only_near = true;
  made.coarsest = 0.0004;
  auto found = made.search(1000);
  CHECK(found.met);
  CHECK(made.asked == std::vector<double>{0.0004});
  CHECK(made.kept == 0.0004);
  // Where there are too few, the search goes on below it.
  made = MadeUp();
  made.coarsest = 0.0015;
  made.count = [](double epsilon) { return 0.9 / epsilon; };
  found = made.search(1000);
  CHECK(found.met);
  CHECK(made.kept == Approx(0.0009).epsilon(0.1));
  for (const double epsilon : made.asked) CHECK(epsilon <= 0.0015);
}
