// Where tests find real meshes and a place to write; both may be absent on a slim machine.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

/// The path of a mesh of Debian's libcgal-demo ("lion-head.off"), or nothing where the package's data is not
/// there. `./check` unpacks it and sets ANISOMESH_DATA to the folder.
inline std::optional<std::string> demo_mesh(const std::string& name) {
  if (const char* folder = std::getenv("ANISOMESH_DATA")) {
    for (const char* below : {"", "meshes/", "data/meshes/"}) {
      const auto path = std::filesystem::path(folder) / (below + name);
      if (std::filesystem::exists(path)) return path.string();
    }
  }
  return std::nullopt;
}

/// Says that the test lacks its data: ctest then counts it as skipped, never as passed.
/// Use: `const auto path = demo_mesh("lion-head.off"); if (!path) return skip("lion-head.off");`
inline void skip(const std::string& reason) {
  std::cout << "SKIPPED: " << reason << " (set ANISOMESH_DATA to the unpacked data of libcgal-demo)"
            << std::endl;
}

/// The nine disc-like scans and patches of libcgal-demo that every stage is held to.
inline const std::vector<std::string>& demo_discs() {
  static const std::vector<std::string> names = {
      "mannequin-devil.off", "lion-head.off", "three_peaks.off", "mesh_with_border.off",
      "nefertiti.off",       "mushroom.off",  "patch-20.off",    "cylinder_locally_refined.off",
      "patch-30.off"};
  return names;
}

/// A folder of its own for one test, removed with all that is in it at the end of the scope.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    static int count = 0;
    folder_ = std::filesystem::temp_directory_path() /
              ("anisomesh-test-" + std::to_string(getpid()) + "-" + std::to_string(count++));
    std::filesystem::create_directories(folder_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string operator/(const std::string& name) const { return (folder_ / name).string(); }
  const std::filesystem::path& path() const { return folder_; }

 private:
  std::filesystem::path folder_;
};
