#include "view/picture.hh"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "anisomesh/errors.hh"
#include "view/binary.hh"
#include "view/process.hh"

namespace view {

namespace fs = std::filesystem;

namespace {

/// A folder of our own, gone with everything in it at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (fs::temp_directory_path() / "anisomesh-view-XXXXXX").string();
    if (!mkdtemp(pattern.data()))
      throw anisomesh::CannotProcess("no temporary folder can be made in " +
                                     fs::temp_directory_path().string() + "; set TMPDIR");
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// What stands between two marks, empty where they are not there.
std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const size_t from = text.find(begin);
  if (from == std::string::npos) return {};
  const size_t to = text.find(end, from + begin.size());
  return to == std::string::npos ? std::string() : text.substr(from + begin.size(), to - from - begin.size());
}

std::string last_lines(const fs::path& file) {
  std::ifstream in(file);
  std::string line, last;
  while (std::getline(in, line))
    if (!line.empty()) last = line;
  return last.empty() ? "it said nothing" : "it said: " + last;
}

}  // namespace

std::string find_chromium() {
  const char* wanted = std::getenv("ANISOMESH_CHROMIUM");
  if (wanted && *wanted) {
    if (!find_program(wanted).empty()) return find_program(wanted);
    throw anisomesh::CannotProcess(std::string("ANISOMESH_CHROMIUM names no program: ") + wanted);
  }
  for (const char* name : {"chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome"})
    if (auto found = find_program(name); !found.empty()) return found;
  throw anisomesh::CannotProcess(
      "a picture needs Chromium and none is on the path; install the package 'chromium', or name one in "
      "ANISOMESH_CHROMIUM (pages and --svg do without)");
}

std::string draw_picture(const std::string& chromium, const std::string& page,
                         const std::function<bool()>& cancelled) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "picture.html", log = folder.path() / "log.txt";
  if (!(std::ofstream(file, std::ios::binary) << page << std::flush))
    throw anisomesh::CannotProcess("the page cannot be written to " + folder.path().string() +
                                   "; set TMPDIR");

  std::vector<std::string> command = {chromium,
                                      "--headless",
                                      "--use-angle=swiftshader",
                                      "--enable-unsafe-swiftshader",
                                      "--disable-dev-shm-usage",
                                      "--disable-extensions",
                                      "--no-first-run",
                                      "--force-device-scale-factor=1",
                                      "--user-data-dir=" + (folder.path() / "profile").string()};
  // Chromium refuses to run sandboxed as root; the page is our own and fetches nothing.
  if (runs_as_root()) command.emplace_back("--no-sandbox");
  command.emplace_back("--dump-dom");
  command.push_back("file://" + file.string());

  constexpr int limit_seconds = 300;
  const auto run = run_program(command, folder.path().string(), log.string(), limit_seconds, cancelled);
  if (run.timed_out)
    throw anisomesh::CannotProcess("Chromium drew no picture in " + std::to_string(limit_seconds) +
                                   " seconds");
  const std::string picture = between(run.output, "<pre id=\"picture\">data:image/png;base64,", "</pre>");
  if (!picture.empty()) return from_base64(picture);
  const std::string failure = between(run.output, "<pre id=\"failure\">", "</pre>");
  throw anisomesh::CannotProcess("Chromium (" + chromium +
                                 ") drew no picture: " + (failure.empty() ? last_lines(log) : failure));
}

}  // namespace view
