// Progress reports and cancellation, shared by the long stages.
#pragma once

#include <functional>

#include "anisomesh/errors.hh"

namespace anisomesh {

/// Called now and then with the fraction done, in [0, 1]; returning false cancels the stage with Cancelled.
/// Always called from the thread that called the stage, which lets through what the callback throws; the mesh
/// is then as after a cancel.
using Progress = std::function<bool(double fraction)>;

/// Reports `fraction` if there is a callback. \throw Cancelled if the callback returns false.
inline void report_progress(const Progress& progress, double fraction) {
  if (progress && !progress(fraction)) throw Cancelled();
}

/// A callback that maps [0, 1] onto [from, to] of `progress`, for a stage that is made of stages.
inline Progress sub_progress(const Progress& progress, double from, double to) {
  if (!progress) return {};
  return [progress, from, to](double fraction) { return progress(from + fraction * (to - from)); };
}

}  // namespace anisomesh
