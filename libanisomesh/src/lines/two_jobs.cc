#include "lines/two_jobs.hh"

#include <tbb/task_group.h>

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace anisomesh::detail {

namespace {

class TwoJobs {
 public:
  TwoJobs(const Job& first, const Job& second, const Progress& progress)
      : jobs_{&first, &second}, progress_(progress), caller_(std::this_thread::get_id()) {}

  void run() {
    tbb::task_group helper;
    helper.run([this] { run_unless_taken(1); });
    run_unless_taken(0);
    // No thread may be free; and one that waits inside of oneTBB would hear of no cancel.
    run_unless_taken(1);
    wait_for_other();
    helper.wait();
    for (const auto& error : errors_)
      if (error) std::rethrow_exception(error);
    if (stopped_) throw Cancelled();
  }

 private:
  void run_unless_taken(int k) {
    if (taken_[k].exchange(true)) return;
    try {
      (*jobs_[k])([this, k](double fraction) { return reached(k, fraction); });
      done_[k] = 1;
    } catch (...) {
      errors_[k] = std::current_exception();
      stopped_ = true;
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    ++finished_;
    news_.notify_one();
  }

  bool reached(int k, double fraction) {
    done_[k] = fraction;
    if (std::this_thread::get_id() == caller_) {
      ask();
    } else {
      const std::lock_guard<std::mutex> lock(mutex_);
      has_news_ = true;
      news_.notify_one();
    }
    return !stopped_;
  }

  void ask() {
    if (!stopped_ && progress_ && !progress_(0.5 * (done_[0] + done_[1]))) stopped_ = true;
  }

  void wait_for_other() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (finished_ < 2) {
      news_.wait(lock, [this] { return has_news_ || finished_ == 2; });
      if (finished_ == 2) return;
      has_news_ = false;
      lock.unlock();
      try {
        ask();
      } catch (...) {  // what the caller's own callback threw
        errors_[0] = std::current_exception();
        stopped_ = true;
      }
      lock.lock();
    }
  }

  const Job* jobs_[2];
  const Progress& progress_;
  std::thread::id caller_;
  std::atomic<bool> taken_[2] = {false, false};
  std::atomic<double> done_[2] = {0, 0};
  std::atomic<bool> stopped_{false};
  std::exception_ptr errors_[2];
  std::mutex mutex_;
  std::condition_variable news_;
  bool has_news_ = false;
  int finished_ = 0;
};

}  // namespace

void run_both(const Job& first, const Job& second, const Progress& progress) {
  TwoJobs(first, second, progress).run();
}

}  // namespace anisomesh::detail
