// What the benchmarks share: where the real meshes are, a reference with curvature, a check that prints.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "anisomesh/compare.hh"
#include "anisomesh/curvature.hh"
#include "anisomesh/io.hh"

namespace bench {

/// The file of libcgal-demo, unpacked: in the folder the environment variable ANISOMESH_DATA names.
inline std::optional<std::string> demo_mesh(const std::string& name) {
  const char* folder = std::getenv("ANISOMESH_DATA");
  if (!folder) return std::nullopt;
  const auto path = std::filesystem::path(folder) / name;
  if (!std::filesystem::exists(path)) return std::nullopt;
  return path.string();
}

/// A copy of the mesh for the ruler alone: curvature by the default options, whatever the run that is judged
/// has used or smoothed.
struct Ruler {
  explicit Ruler(const OpenMesh::TriMesh& mesh) : reference(mesh) {
    anisomesh::estimate_curvature(reference);
  }
  anisomesh::Comparison operator()(OpenMesh::PolyMesh& result,
                                   const anisomesh::CompareOptions& options = {}) {
    return anisomesh::compare(reference, result, options);
  }
  OpenMesh::TriMesh reference;
};

/// Counts what was promised and not kept; the exit code of a benchmark.
class Bars {
 public:
  /// Prints one line; `kept` or not is decided by the caller.
  void check(bool kept, const std::string& what) {
    std::printf("- %s: %s\n", kept ? "kept" : "MISSED", what.c_str());
    if (!kept) ++missed_;
  }
  int missed() const { return missed_; }

 private:
  int missed_ = 0;
};

inline std::string format(const char* pattern, double value) {
  char text[64];
  std::snprintf(text, sizeof text, pattern, value);
  return text;
}

}  // namespace bench
