// Running another program: no shell, a time limit, and gone with all its children when we stop.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace view {

/// The full path of a program that can be run, empty where there is none; a name without '/' is looked for on
/// the path.
std::string find_program(const std::string& name);

bool runs_as_root();

struct ProgramRun {
  std::string output;
  int status = 0;  ///< as waitpid() gives it
  bool timed_out = false;
};

/// Runs a program with `home` as its home folder and its standard error in the file `log`.
/// \throw anisomesh::CannotProcess where it cannot be started, anisomesh::Cancelled
ProgramRun run_program(const std::vector<std::string>& command, const std::string& home,
                       const std::string& log, int limit_seconds, const std::function<bool()>& cancelled);

}  // namespace view
