#include "support/command.hh"

#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <cctype>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "anisomesh/errors.hh"
#include "anisomesh/io.hh"
#include "support/progress_bar.hh"

namespace apps {

namespace {

volatile std::sig_atomic_t stop_signal = 0;

void remember_signal(int signal) { stop_signal = signal; }

/// The first Ctrl-C asks to stop at the next report of progress; the second one stops at once.
void catch_signals() {
  struct sigaction action = {};
  action.sa_handler = remember_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text;
}

/// The library's messages name its functions and fields; who calls an app knows apps and options.
std::string in_words_of_apps(std::string message) {
  static const std::vector<std::pair<std::string, std::string>> words{
      {"run estimate_curvature()", "run anisomesh-estimate"},
      {"run flatten()", "run anisomesh-flatten"},
      {"run smooth_tensors()", "run anisomesh-flatten"},
      {"run find_umbilics()", "run anisomesh-flatten"},
      {"run trace_lines()", "run anisomesh-trace"},
      {"run cut_into_charts() first", "bring one, or leave --keep-charts out"},
      {"rho must", "--rho must"},
      {"adaptation must", "--adaptation must"},
      {"samples must", "--samples must"},
      {"anisotropy_threshold", "--anisotropy"},
      {"levels must", "--levels must"},
      {"target_faces", "--target-faces"},
      {"target_vertices", "--target-vertices"},
      {"epsilon_fraction", "--epsilon"},
      {"max_spacing_fraction", "--max-spacing"},
      {"max_slope", "--max-slope"},
      {"stop_fraction", "--stop-fraction"},
      {"seed_fraction", "--seed-fraction"},
      {"min_crossings", "--min-crossings"},
      {"relax_passes", "--relax-passes"},
      {"weld_fraction", "--weld"},
      {"max_edges of a hole", "--fill-holes"},
      {"max_edge_fraction", "--refine"},
      {"corner_angle_degrees", "--corner-angle"},
      {"angle_degrees", "--feature-angle"},
      {"smoothing iterations are", "--smoothing is"},
      {"smoothing radius_fraction", "--smoothing-radius"},
      {"radius_fraction", "--radius"},
      {"max_area_stretch of charts", "--max-area-stretch"},
      {"crease_weight of charts", "--crease-weight"},
      {"max_degree", "--max-degree"},
      {"chain_tolerance", "--chain-tolerance"},
      {"cell_tolerance", "--cell-tolerance"},
      {"alignment_weight", "--alignment-weight"},
      {"feature_tolerance", "--feature-tolerance"},
      {"merge_fraction", "--merge-fraction"},
      {"max_bend_degrees", "--max-bend"},
      {"fit.passes", "--fit-passes"},
      {"balance.rounds", "--balance"},
      {"max_error_fraction", "--max-error"},
  };
  for (const auto& [word, said] : words)
    for (size_t at = 0; (at = message.find(word, at)) != std::string::npos; at += said.size())
      message.replace(at, word.size(), said);
  return message;
}

/// CLI11 makes 18446744073709551615 of -1.
std::string refuse_negative(const std::string& text) {
  return text.rfind('-', 0) == 0 ? "'" + text + "' must not be negative" : std::string();
}

}  // namespace

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

Command::Command(const std::string& name, const std::string& description)
    : name_(name),
      app_(std::make_unique<CLI::App>(description, name)),
      report_(std::make_unique<Json>(Json::object())) {
  app_->get_formatter()->column_width(34);
  app_->option_defaults()->always_capture_default();
  app_->footer(
      "Exit codes: 0 done, 2 usage, 3 bad input or a place that cannot be written, 4 the input cannot be "
      "processed, "
      "130 cancelled.");
}

Command::~Command() = default;

void Command::input(std::string& path, const std::string& name, const std::string& help) {
  app_->add_option(name, path, help)->required()->type_name("FILE")->capture_default_str();
  if (!input_) input_ = &path;
}

void Command::output(std::string& path, const std::string& help) {
  app_->add_option("-o,--output", path, help)->required()->type_name("FILE")->group("Output");
  output_ = &path;
}

/// Last, so that --help lists them last.
void Command::add_general_options() {
  constexpr const char* group = "General";
  app_->add_option("--json", json_path_, "Write the report as JSON to this file; - is the standard output")
      ->type_name("FILE")
      ->group(group);
  app_->add_option("--threads", threads_, "Threads to use; 0: one for each processor; the result is the same")
      ->type_name("N")
      ->group(group);
  app_->add_flag("-q,--quiet", quiet_, "No progress, summary or warnings")->group(group);
  app_->set_help_flag("-h,--help", "Print this help and exit")->group(group);
  app_->set_version_flag("--version", name_ + " " + ANISOMESH_VERSION, "Print the version and exit")
      ->group(group);
}

void Command::optional_output(std::string& path, const std::string& help) {
  app_->add_option("-o,--output", path, help)->type_name("FILE")->group("Output");
  output_ = &path;
}

int Command::run(int argc, char* argv[], const std::function<void()>& work) {
  add_general_options();
  for (auto* option : app_->get_options())
    if (option->get_type_name() == "N") option->check(refuse_negative);
  try {
    app_->parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::cout << app_->help();
    return exit_done;
  } catch (const CLI::CallForVersion& version) {
    std::cout << version.what() << "\n";
    return exit_done;
  } catch (const CLI::ParseError& error) {
    std::cerr << name_ << ": " << one_line(error.what()) << "; " << name_ << " --help lists the options\n";
    return exit_usage;
  }
  catch_signals();
  return work_and_report(work);
}

int Command::work_and_report(const std::function<void()>& work) {
  using namespace anisomesh;
  const auto start = std::chrono::steady_clock::now();
  std::optional<tbb::global_control> limit;
  if (threads_ > 0)
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(threads_));
  try {
    if (threads_ < 0) throw InvalidOption("--threads must be at least 0, but is " + std::to_string(threads_));
    // What cannot end well does not begin.
    if (output_ && !output_->empty()) require_writable_mesh(*output_);
    if (!json_path_.empty() && json_path_ != "-") require_writable(json_path_);
    refuse_one_file_for_two();
    work();
    if (!json_path_.empty()) {
      (*report_)["options"] = options();
      (*report_)["seconds"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      const std::string text = report_->dump(2) + "\n";
      if (json_path_ == "-")
        std::cout << text << std::flush;
      else
        write_text(text, json_path_);
    }
    if (!std::cout.flush()) return fail(exit_bad_input, "the standard output cannot be written");
    return failure_.empty() ? exit_done : fail(exit_cannot, failure_, true);
  } catch (const Cancelled&) {
    return fail_cancelled();
  } catch (const InvalidOption& error) {
    return fail(exit_usage, error.what());
  } catch (const InvalidInput& error) {
    if (cancelled()) return fail_cancelled();  // while a pipe was waited for
    return fail(exit_bad_input, error.what(), true);
  } catch (const CannotProcess& error) {
    return fail(exit_cannot, error.what(), true);
  } catch (const SolverFailure& error) {
    return fail(exit_cannot, error.what(), true);
  } catch (const std::bad_alloc&) {
    return fail(exit_cannot, "there is not enough memory for this input and these options", true);
  } catch (const std::exception& error) {
    return fail(exit_internal, std::string("internal error: ") + error.what(), true);
  }
}

int Command::fail(int code, const std::string& message, bool about_input) const {
  const bool names_input = about_input && input_ && !input_->empty() && !names_a_file(message);
  const bool of_library = code == exit_usage || message.find("() first") != std::string::npos;
  const std::string line = one_line(message);
  std::cerr << name_ << ": " << (names_input ? *input_ + ": " : "")
            << (of_library ? in_words_of_apps(line) : line) << "\n";
  return code;
}

int Command::fail_cancelled() const {
  return fail(stop_signal == SIGTERM ? 128 + SIGTERM : exit_cancelled, "cancelled; nothing was written");
}

/// The report would take the place of what was written before it.
void Command::refuse_one_file_for_two() const {
  std::error_code none;
  const auto place = [&](const std::string& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path, none), none);
  };
  for (const char* name : {"--output", "--report", "--png", "--svg"}) {
    const auto* option = app_->get_option_no_throw(name);
    if (!option || option->count() == 0 || json_path_.empty() || json_path_ == "-") continue;
    const std::string other = option->as<std::string>();
    if (place(other) == place(json_path_) && !std::filesystem::is_other(other, none))
      throw anisomesh::InvalidOption(std::string("--json and ") + name + " name the same file, " + other);
  }
}

/// Whether the message is about a file that was given.
bool Command::names_a_file(const std::string& message) const {
  for (const auto* option : app_->get_options())
    for (const auto& word : option->results())
      if (message.rfind(word + ":", 0) == 0) return true;
  return false;
}

anisomesh::Progress Command::progress(const std::string& what) {
  auto bar = std::make_shared<ProgressBar>(!quiet_);
  return [bar, what](double fraction) {
    bar->draw(what, fraction);
    return stop_signal == 0;
  };
}

void Command::stop_if_cancelled() const {
  if (stop_signal != 0) throw anisomesh::Cancelled();
}

bool Command::cancelled() const { return stop_signal != 0; }

Json Command::options() const {
  Json values = Json::object();
  for (const auto* option : app_->get_options()) {
    const std::string name = option->get_name();
    if (name == "--help" || name == "--version") continue;
    std::string given;
    for (const auto& word : option->results()) given += (given.empty() ? "" : " ") + word;
    values[name] = option->count() > 0 ? given : option->get_default_str();
  }
  return values;
}

void Command::say(const std::string& line) const {
  if (!quiet_ && json_path_ != "-") std::cout << line << "\n";
}

void Command::warn_unless_om(const std::string& path, const std::string& what,
                             const std::string& lost) const {
  if (ending_of(path) != ".om") warn(path + " holds the bare " + what + ": only .om keeps " + lost);
}

void Command::warn_of_unused(const std::vector<std::string>& options, const std::string& why) const {
  for (const auto& name : options)
    if (app_->get_option(name)->count() > 0) warn(name + " changes nothing " + why);
}

void Command::warn(const std::string& line) const {
  if (!quiet_) std::cerr << name_ << ": warning: " << line << "\n";
}

}  // namespace apps
