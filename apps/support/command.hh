// What all apps share: how they are called, how they report, fail and stop. CLI11 stays inside support/.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "anisomesh/progress.hh"

namespace CLI {
class App;
}

namespace apps {

using Json = nlohmann::ordered_json;

/// Exit codes, the same for every app.
enum Exit {
  exit_done = 0,
  exit_internal = 1,
  exit_usage = 2,
  exit_bad_input = 3,
  exit_cannot = 4,
  exit_cancelled = 130
};

/// Of a file's name, with its dot and in small letters; empty where it has none.
std::string ending_of(const std::string& path);

class Command {
 public:
  Command(const std::string& name, const std::string& description);
  ~Command();
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  /// A required file to read, as a positional argument.
  void input(std::string& path, const std::string& name, const std::string& help);
  /// The required -o, --output, a mesh; looked at before the work begins.
  void output(std::string& path, const std::string& help);
  /// A -o, --output that may be left out.
  void optional_output(std::string& path, const std::string& help);
  /// For the options of a stage, see options.hh.
  CLI::App& arguments() { return *app_; }

  /// Parses, works, reports; turns exceptions into one line on stderr and an exit code.
  int run(int argc, char* argv[], const std::function<void()>& work);

  // --- for the work
  /// The callback for a stage: draws the bar on a terminal and cancels after Ctrl-C.
  anisomesh::Progress progress(const std::string& what);
  /// \throw Cancelled after Ctrl-C. Called before anything is written.
  void stop_if_cancelled() const;
  bool cancelled() const;
  /// The options by name, as given or by default.
  Json options() const;
  /// A line for people: on stdout, unless --quiet or the JSON report goes there.
  void say(const std::string& line) const;
  /// The work goes on and the report is written, but the exit code is 4, with this line.
  void fail_at_end(const std::string& message) { failure_ = message; }
  /// A line on stderr, unless --quiet.
  void warn(const std::string& line) const;
  /// Warns that only .om keeps properties. \param what the file has otherwise
  void warn_unless_om(const std::string& path, const std::string& what = "surface",
                      const std::string& lost = "what this stage has found, for the next one") const;
  /// Warns of options that were given where they change nothing.
  void warn_of_unused(const std::vector<std::string>& options, const std::string& why) const;
  /// What --json writes.
  Json& report() { return *report_; }

 private:
  void add_general_options();
  int work_and_report(const std::function<void()>& work);
  int fail_cancelled() const;
  int fail(int code, const std::string& message, bool about_input = false) const;
  bool names_a_file(const std::string& message) const;
  void refuse_one_file_for_two() const;

  std::string name_;
  std::unique_ptr<CLI::App> app_;
  std::unique_ptr<Json> report_;
  std::string* input_ = nullptr;  ///< the first one: failures of a stage name it
  std::string* output_ = nullptr;
  std::string json_path_, failure_;
  int threads_ = 0;
  bool quiet_ = false;
};

}  // namespace apps
