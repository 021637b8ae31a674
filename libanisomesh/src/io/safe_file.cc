#include "io/safe_file.hh"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <vector>

#include "anisomesh/errors.hh"

namespace anisomesh::detail {

namespace fs = std::filesystem;

SafeFile::SafeFile(const std::string& path) : path_(path) {
  if (path.empty()) throw InvalidInput("the output has no name");
  std::error_code error;
  const fs::path resolved = fs::weakly_canonical(path, error);
  target_ = error ? path : resolved.string();
  if (fs::is_directory(target_, error)) throw InvalidInput(path_ + ": is a directory; name a file in it");
  const bool exists = fs::exists(target_, error);
  if (exists && !fs::is_regular_file(target_, error)) {
    descriptor_ = open(target_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail("cannot be opened for writing", errno);
    return;
  }
  // rename() asks only the folder, but a file that is write-protected is meant to stay.
  if (exists && access(target_.c_str(), W_OK) != 0) fail("cannot be overwritten", errno);

  const fs::path target(target_);
  const std::string pattern =
      (target.parent_path() / ("." + target.filename().string() + ".XXXXXX")).string();
  std::vector<char> name(pattern.begin(), pattern.end());
  name.push_back('\0');
  descriptor_ = mkostemp(name.data(), O_CLOEXEC);
  if (descriptor_ < 0) fail("cannot be written", errno);
  temporary_ = name.data();

  mode_t mode = 0;
  struct stat info;
  if (exists && stat(target_.c_str(), &info) == 0) {
    mode = info.st_mode & 07777;
  } else {
    const mode_t mask = umask(0);
    umask(mask);
    mode = 0666 & ~mask;
  }
  static_cast<void>(fchmod(descriptor_, mode));  // a file system without modes is no reason to stop
}

SafeFile::~SafeFile() {
  if (descriptor_ >= 0) close(descriptor_);
  if (!temporary_.empty()) unlink(temporary_.c_str());
}

void SafeFile::write(const char* data, size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(descriptor_, data, size);
    if (written < 0) {
      if (errno == EINTR) continue;
      fail("cannot be written", errno);
    }
    data += written;
    size -= static_cast<size_t>(written);
  }
}

void SafeFile::commit() {
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (close(descriptor) != 0) fail("cannot be written", errno);
  if (temporary_.empty()) return;
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail("cannot be put in place", errno);
  temporary_.clear();
}

void SafeFile::fail(const std::string& what, int error) const {
  throw InvalidInput(path_ + ": " + what + ": " + std::generic_category().message(error));
}

}  // namespace anisomesh::detail
