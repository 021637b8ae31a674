// The lines of one kind in the faces they cross, and how wide the gaps between them are, measured straight
// across. Other than a LineIndex it forgets a line again.
#pragma once

#include <unordered_map>

#include "lines/line_tracer.hh"

namespace anisomesh::detail {

class GapMap {
 public:
  explicit GapMap(const Domain& domain) : domain_(domain), pieces_(domain.n_faces()) {}

  /// Enters points [first, last) of a line.
  void enter(int line, const std::vector<TracePoint>& points, size_t first, size_t last);
  void erase(int line);
  /// How far the first line or fence is along a vector, as a fraction of it; infinite beyond its end.
  double along(const SurfacePoint& from, const Vec2d& vector) const;

 private:
  struct Piece {
    Vec2d from{0, 0}, to{0, 0};  // as in WayPiece
    int line = -1;
  };
  const Domain& domain_;
  std::vector<std::vector<Piece>> pieces_;  // of each face
  std::unordered_map<int, std::vector<int>> faces_of_;
};

}  // namespace anisomesh::detail
