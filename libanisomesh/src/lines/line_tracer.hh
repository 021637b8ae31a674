// Integrates one line of curvature, from its seed to both ends.
#pragma once

#include <vector>

#include "lines/domain.hh"

namespace anisomesh::detail {

/// A point of a line being traced.
struct TracePoint {
  SurfacePoint point;
  Vec2d direction{1, 0};  ///< unit, the way the line runs, in the frame of the point
  double arc = 0;         ///< length from the seed, in spacings between lines of this kind
  double crossings = 0;   ///< length from the seed, in spacings between lines of the other kind
  Vec2d made{0, 0};       ///< what was walked to here, from the point before on the way from the seed
};

constexpr double kOffFeature =
    0.05;  ///< spacings from a feature to the second point of a line that starts there

struct TracedLine {
  std::vector<TracePoint> points;  ///< arc ascends
  bool closed = false;
  LineEnd begin_reason = LineEnd::border, end_reason = LineEnd::border;
};

/// Traces lines of one kind over a domain. Finished lines are entered into the index, and the far part of the
/// one being traced as well, so that it does not run into itself. [ACDLD03, section 3.1.1, 3.1.2]
class LineTracer {
 public:
  LineTracer(const Domain& domain, LineIndex& index, LineKind kind, const TraceOptions& options)
      : domain_(domain), index_(index), kind_(kind), options_(options) {}

  /// The line through a seed, both ways. Empty points: the line would be too short to be of use, and nothing
  /// was entered.
  TracedLine trace(const SurfacePoint& seed, int id);
  /// The line that leaves an umbilic in a direction.
  TracedLine trace_from_umbilic(int umbilic, const Vec2d& direction, int id);
  /// The line that leaves a point of a feature in a direction.
  TracedLine trace_from_feature(const SurfacePoint& start, const Vec2d& direction, int id);

 private:
  struct Half {
    std::vector<TracePoint> points;
    LineEnd reason = LineEnd::step_limit;
    size_t entered = 0;  // points already in the index
    double sign = 1;     // of the arc
    bool from_fence = false;
  };
  struct Step {
    Reach reach;
    Vec2d vector{0, 0};
    double length = 0;
    double next_length = 0;
  };

  Vec2d direction(const Vec3d& tensor, const Vec2d& previous) const;
  bool runs_so(const SurfacePoint& seed, const Vec3d& tensor, const Vec2d& direction) const;
  void run(Half& half, int id, int umbilic, double arc_of_other_half);
  Step step(const TracePoint& from, double wanted) const;
  double longest_step(const TracePoint& from) const;
  bool ends_here(Half& half, const TracePoint& head, int id, int umbilic);
  bool comes_around(Half& half, const TracePoint& head) const;
  bool hits_umbilic(Half& half, const TracePoint& head, int umbilic);
  void enter_lagging(Half& half, int id, bool all);
  TracePoint after_straight_step(const TracePoint& start, double spacings, bool& blocked) const;
  TracedLine join(Half& forward, Half& backward, int id);

  const Domain& domain_;
  LineIndex& index_;
  LineKind kind_;
  const TraceOptions& options_;
};

}  // namespace anisomesh::detail
