// Two jobs at once that the caller's thread stays in touch with.
#pragma once

#include <functional>

#include "anisomesh/progress.hh"

namespace anisomesh::detail {

/// Calls its argument now and then with the fraction done, and returns soon after that said false.
using Job = std::function<void(const std::function<bool(double)>& going_on)>;

/// Runs two jobs, at once where a second thread is there. Progress, the mean of both, is asked on the calling
/// thread alone, while that works and while it waits for the other.
/// \throw Cancelled if progress said false; what the first job throws, else what the second does
void run_both(const Job& first, const Job& second, const Progress& progress);

}  // namespace anisomesh::detail
