#include "view/process.hh"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "anisomesh/errors.hh"

namespace view {

namespace {

bool can_run(const std::string& path) {
  std::error_code ignored;
  return access(path.c_str(), X_OK) == 0 && !std::filesystem::is_directory(path, ignored);
}

/// The child's side: never returns.
[[noreturn]] void become(const std::vector<std::string>& command, const std::string& home,
                         const std::string& log, int output) {
  setpgid(0, 0);  // so that it can be ended with all its children
  const int errors = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(errors, STDERR_FILENO);
  for (const char* name : {"HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME"}) setenv(name, home.c_str(), 1);
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const auto& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  execv(arguments[0], arguments.data());
  _exit(127);
}

/// The running program; ended at once where nobody waits for its end.
class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  ~Child() {
    if (id_ <= 0) return;
    kill(-id_, SIGKILL);
    while (waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  int wait() {
    int status = 0;
    while (waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    kill(-id_, SIGKILL);  // what it left behind
    id_ = 0;
    return status;
  }

 private:
  pid_t id_;
};

struct Descriptor {
  int number;
  explicit Descriptor(int n) : number(n) {}
  ~Descriptor() { close(number); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
};

}  // namespace

std::string find_program(const std::string& name) {
  if (name.find('/') != std::string::npos) return can_run(name) ? name : std::string();
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::string candidate = (folder.empty() ? "." : folder) + "/" + name;
    if (can_run(candidate)) return candidate;
  }
  return {};
}

bool runs_as_root() { return geteuid() == 0; }

ProgramRun run_program(const std::vector<std::string>& command, const std::string& home,
                       const std::string& log, int limit_seconds, const std::function<bool()>& cancelled) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    throw anisomesh::CannotProcess(std::string("no pipe can be opened: ") + std::strerror(errno));
  const Descriptor from(ends[0]);
  const pid_t id = fork();
  if (id == 0) become(command, home, log, ends[1]);
  close(ends[1]);
  if (id < 0) throw anisomesh::CannotProcess(command[0] + " cannot be started: " + std::strerror(errno));
  Child child(id);

  ProgramRun run;
  std::array<char, 1 << 16> buffer;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(limit_seconds);
  while (true) {
    if (cancelled && cancelled()) throw anisomesh::Cancelled();
    if (std::chrono::steady_clock::now() > end) {
      run.timed_out = true;
      return run;
    }
    pollfd wait{from.number, POLLIN, 0};
    constexpr int milliseconds = 100;
    if (poll(&wait, 1, milliseconds) <= 0) continue;
    const ssize_t count = read(from.number, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    run.output.append(buffer.data(), static_cast<size_t>(count));
  }
  run.status = child.wait();
  return run;
}

}  // namespace view
