// Which formats there are, told by the ending of a file's name.
#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>
#include <vector>

#include "anisomesh/errors.hh"

namespace anisomesh::detail {

inline std::vector<std::string> readable_endings() { return {".obj", ".off", ".ply", ".stl", ".om"}; }
inline std::vector<std::string> writable_endings() { return {".obj", ".off", ".ply", ".om"}; }

/// The ending in lower case, with its dot; empty where there is none.
inline std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

/// The ending if it is one of `endings`. \throw InvalidInput that lists them
inline std::string require_ending(const std::string& path, const std::vector<std::string>& endings) {
  std::string ending = ending_of(path);
  if (std::find(endings.begin(), endings.end(), ending) != endings.end()) return ending;
  std::string list;
  for (size_t i = 0; i < endings.size(); ++i)
    list += (i == 0 ? "" : i + 1 == endings.size() ? " or " : ", ") + endings[i];
  if (path.empty()) throw InvalidInput("the name of a file is empty; it has to end in " + list);
  throw InvalidInput(path + ": " +
                     (ending.empty() ? "the name has no ending" : "unknown ending '" + ending + "'") +
                     "; use " + list);
}

}  // namespace anisomesh::detail
