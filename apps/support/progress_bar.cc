#include "support/progress_bar.hh"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace apps {

ProgressBar::ProgressBar(bool enabled) : enabled_(enabled && isatty(STDERR_FILENO) == 1) {}

void ProgressBar::draw(const std::string& what, double fraction) {
  if (!enabled_) return;
  const auto now = std::chrono::steady_clock::now();
  if (drawn_ && now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  drawn_ = true;
  constexpr int width = 40;
  const int done = std::clamp(static_cast<int>(fraction * width), 0, width);
  std::string bar(static_cast<size_t>(done), '=');
  bar.resize(width, ' ');
  std::fprintf(stderr, "\r%-24s [%s] %3d %%", what.c_str(), bar.c_str(), static_cast<int>(100 * fraction));
  std::fflush(stderr);
}

void ProgressBar::clear() {
  if (drawn_) std::fputs("\r\033[K", stderr);
  drawn_ = false;
}

}  // namespace apps
