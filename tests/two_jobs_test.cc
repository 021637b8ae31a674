#include "lines/two_jobs.hh"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "catch.hh"

using namespace anisomesh;
using detail::Job;
using detail::run_both;

namespace {

const Job at_once = [](const auto&) {};

/// Works on until it is told to stop, and counts how often it went on.
Job endless(std::atomic<size_t>& steps) {
  return [&steps](const auto& going_on) {
    while (going_on(0.5)) {
      ++steps;
      std::this_thread::yield();
    }
  };
}

/// Runs with one, two and three threads, also where there is one core.
template <class Function>
void with_threads(const Function& function) {
  for (const int threads : {1, 2, 3}) {
    const tbb::global_control most(tbb::global_control::max_allowed_parallelism,
                                   static_cast<size_t>(threads));
    INFO(threads << " threads");
    tbb::task_arena(threads).execute(function);
  }
}

}  // namespace

TEST_CASE("whichever of two jobs is left, a cancel reaches it, and no more is asked", "[two_jobs]") {
  with_threads([] {
    std::atomic<size_t> steps{0};
    const Job working = endless(steps);
    for (const auto& [first, second] :
         {std::pair(at_once, working), std::pair(working, at_once), std::pair(working, working)}) {
      size_t asked = 0;
      // Without a cancel that is heard, this never ends.
      CHECK_THROWS_AS(run_both(first, second, [&](double) { return ++asked < 50; }), Cancelled);
      CHECK(asked == 50);
    }
    CHECK(steps > 0);
  });
}

TEST_CASE("two jobs are both done, and progress grows, asked on the caller's thread alone", "[two_jobs]") {
  with_threads([] {
    const auto caller = std::this_thread::get_id();
    std::atomic<size_t> calls{0};
    const Job thousand = [&](const auto& going_on) {
      for (int i = 0; i < 1000; ++i) {
        ++calls;
        if (!going_on(i / 1000.0)) return;
      }
    };
    double last = 0;
    bool on_caller = true, grows = true;
    run_both(thousand, thousand, [&](double fraction) {
      on_caller = on_caller && std::this_thread::get_id() == caller;
      grows = grows && fraction >= last && fraction <= 1;
      last = fraction;
      return true;
    });
    CHECK(calls == 2000);
    CHECK(on_caller);
    CHECK(grows);
    run_both(thousand, thousand, {});
    CHECK(calls == 4000);
  });
}

TEST_CASE("what a job or the callback throws ends the other job, and arrives", "[two_jobs]") {
  with_threads([] {
    std::atomic<size_t> steps{0};
    const Job working = endless(steps);
    const Job failing = [](const auto&) { throw std::runtime_error("failed"); };
    CHECK_THROWS_WITH(run_both(failing, working, {}), "failed");
    CHECK_THROWS_WITH(run_both(at_once, failing, {}), "failed");
    const Job later = [](const auto&) { throw std::runtime_error("failed later"); };
    CHECK_THROWS_WITH(run_both(failing, later, {}), "failed");
    size_t asked = 0;
    const auto callback = [&](double) -> bool {
      if (++asked == 20) throw std::logic_error("the callback failed");
      return true;
    };
    for (const auto& [first, second] : {std::pair(at_once, working), std::pair(working, at_once)}) {
      asked = 0;
      CHECK_THROWS_WITH(run_both(first, second, callback), "the callback failed");
    }
  });
}
