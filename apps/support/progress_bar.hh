// One line on a terminal's stderr that says what is going on and how far it is.
#pragma once

#include <chrono>
#include <string>

namespace apps {

/// Draws at most ten times a second, and nothing at all where stderr is no terminal.
class ProgressBar {
 public:
  explicit ProgressBar(bool enabled);
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void draw(const std::string& what, double fraction);
  void clear();

 private:
  bool enabled_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace apps
