// A file that is there whole or not at all.
#pragma once

#include <string>

namespace anisomesh::detail {

/// Collects what is written in a temporary file beside the target and renames it on commit(). Without
/// commit() nothing remains and the target is as it was. A target that is no regular file (a pipe, a device)
/// is written straight. \throw InvalidInput naming the path and the reason
class SafeFile {
 public:
  explicit SafeFile(const std::string& path);
  ~SafeFile();
  SafeFile(const SafeFile&) = delete;
  SafeFile& operator=(const SafeFile&) = delete;

  void write(const char* data, size_t size);
  void write(const std::string& text) { write(text.data(), text.size()); }
  void commit();

 private:
  [[noreturn]] void fail(const std::string& what, int error) const;

  std::string path_;       ///< as the user named it
  std::string target_;     ///< behind symbolic links
  std::string temporary_;  ///< empty where the target is written straight
  int descriptor_ = -1;
};

}  // namespace anisomesh::detail
