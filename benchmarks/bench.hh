// What the benchmarks share: where the real meshes are, a reference with curvature, a check that prints.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

#include "anisomesh/compare.hh"
#include "anisomesh/curvature.hh"
#include "anisomesh/io.hh"
#include "data.hh"  // demo_mesh()

namespace bench {

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
  /// Prints one line if it was not kept, or always if `kept_too`.
  void check(bool kept, const std::string& what, bool kept_too = true) {
    ++checked_;
    if (!kept) ++missed_;
    if (kept_too || !kept) std::printf("- %s: %s\n", kept ? "kept" : "MISSED", what.c_str());
  }
  int missed() const { return missed_; }
  int checked() const { return checked_; }

 private:
  int missed_ = 0, checked_ = 0;
};

inline std::string format(const char* pattern, double value) {
  char text[64];
  std::snprintf(text, sizeof text, pattern, value);
  return text;
}

}  // namespace bench
