// Where the lines of one kind start, one after the other, until the surface is covered.
#pragma once

#include <functional>

#include "lines/line_tracer.hh"

namespace anisomesh::detail {

struct PlacedLines {
  std::vector<TracedLine> lines;
  size_t coverage_seeds = 0;  ///< lines that the random coverage check started
};

/// Covers a domain with the lines of one kind. [ACDLD03, section 3.1.4]
/// \param going_on asked after each line, with the share of the area that is covered at least; false: give up
PlacedLines place_lines(const Domain& domain, LineKind kind, const TraceOptions& options,
                        const std::function<bool(double)>& going_on);

/// Random points of a domain, uniform by area; the same ones however its faces are numbered.
class AreaSampler {
 public:
  AreaSampler(const Domain& domain, unsigned seed);
  SurfacePoint next();
  SurfacePoint in_face(OpenMesh::FaceHandle face);
  /// All faces, in the order that they are numbered by here.
  const std::vector<int>& order() const { return order_; }
  double total_area() const { return cumulative_.back(); }

 private:
  double uniform();  // in [0, 1)
  const Domain& domain_;
  std::vector<int> order_;
  std::vector<double> cumulative_;  // of the faces in that order
  unsigned long long state_;
};

}  // namespace anisomesh::detail
