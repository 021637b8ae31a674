#include "lines/line_tracer.hh"

#include <algorithm>
#include <cmath>

#include "lines/face_domain.hh"
#include "numerics/integrator.hh"
#include "surface/intrinsic_order.hh"

namespace anisomesh::detail {

namespace {

constexpr double kOwnPart = 1.6;        // spacings along the line that do not count as running into itself
constexpr double kFreeOfUmbilic = 1.0;  // spacings in which lines from one umbilic may be close to each other
constexpr double kUmbilicReach = 0.12;  // spacings from an umbilic at which a line ends there
constexpr double kParallel = 0.94;      // cosine: a fence this parallel counts as a line
constexpr double kParallelFence = 0.45;  // spacings
constexpr double kSpeck = 0.02;          // spacings
constexpr size_t kStepLimit = 50000;
constexpr double kMostBetween = 48;     // points between two crossings, where the field is straight
constexpr double kComesAround = 0.1;    // spacings beside its start at which a line is closed
constexpr double kHardlyTurned = M_PI;  // within the surface: what turns more is a small circle
constexpr double kSameWay = 0.8;        // cosine
constexpr double kSeesFence = 2.5;      // spacings
constexpr double kPullBack = 1e-3;      // of the last segment: what is entered keeps off the fence it ends at

LineKind other(LineKind kind) { return kind == LineKind::min ? LineKind::max : LineKind::min; }

bool at_fence(LineEnd reason) { return reason == LineEnd::border || reason == LineEnd::feature; }

Vec2d rotated_by(const Vec2d& v, const Vec2d& r) {
  return {r[0] * v[0] - r[1] * v[1], r[1] * v[0] + r[0] * v[1]};
}

SurfacePoint pulled_back(const Domain& domain, LineKind kind, const TracePoint& before,
                         const TracePoint& last) {
  const double length = std::abs(last.arc - before.arc) * domain.spacing(kind, last.point);
  return domain.walk(last.point, -kPullBack * length * last.direction).point;
}

}  // namespace

Vec2d LineTracer::direction(const Vec3d& tensor, const Vec2d& previous) const {
  const Vec2d d = kind_ == LineKind::max ? max_direction(tensor) : min_direction(tensor);
  return (d | previous) < 0 ? -d : d;
}

double LineTracer::longest_step(const TracePoint& from) const {
  const double own = domain_.spacing(kind_, from.point), across = domain_.spacing(other(kind_), from.point);
  const double turning = domain_.turning_length(from.point);
  // A few points between two crossings; and near an umbilic, where the deviator is small for its gradient,
  // steps that the field's turning allows.
  const double bound = std::min(across / 3.2, std::max(1.5 * own, across / kMostBetween));
  return std::max(std::min(bound, 0.5 * turning), bound / 16);
}

LineTracer::Step LineTracer::step(const TracePoint& from, double wanted) const {
  const double own = domain_.spacing(kind_, from.point);
  const double tolerance = 0.005 * own;
  const double longest = longest_step(from), shortest = longest / 16;
  double h = std::min(wanted, longest);
  const auto field = [&](const Vec2d& offset) {
    return direction(domain_.tensor_ahead(from.point, offset), from.direction);
  };
  for (;;) {
    const EmbeddedStep tried = cash_karp_step(field, from.direction, h);
    const Vec2d ahead = field(tried.offset);
    // A chord may leave the curve by a small part of the distance to the next line.
    const double turn = std::abs(std::asin(std::clamp(cross2(from.direction, ahead), -1.0, 1.0)));
    const bool fine = tried.error <= tolerance && h * turn <= 0.3 * own && turn < 0.5;
    if (fine || h <= shortest) {
      const double growth =
          std::clamp(0.9 * std::pow(tolerance / std::max(tried.error, 1e-300), 0.2), 0.5, 2.0);
      return {domain_.walk(from.point, tried.offset), tried.offset, tried.offset.norm(), h * growth};
    }
    h = std::max(0.5 * h, shortest);
  }
}

bool LineTracer::hits_umbilic(Half& half, const TracePoint& head, int umbilic) {
  const NearUmbilic near = domain_.umbilic_near(kind_, head.point);
  if (near.index < 0 || near.distance > kUmbilicReach * domain_.spacing(kind_, head.point)) return false;
  if (near.index == umbilic && std::abs(head.arc) < kFreeOfUmbilic) return false;
  TracePoint last = head;
  last.point = domain_.umbilics()[static_cast<size_t>(near.index)].point;
  half.points.push_back(last);
  half.reason = LineEnd::umbilic;
  return true;
}

bool LineTracer::ends_here(Half& half, const TracePoint& head, int id, int umbilic) {
  if (umbilic >= 0 && std::abs(head.arc) < kFreeOfUmbilic) return false;
  const double spacing = domain_.spacing(kind_, head.point);
  const double stop = options_.stop_fraction * spacing;
  const auto near = index_.nearest(head.point, stop, id, head.arc - kOwnPart, head.arc + kOwnPart);
  if (near.fence.distance < kParallelFence * spacing &&
      std::abs(near.fence.direction | head.direction) > kParallel) {
    half.reason = LineEnd::too_close;
    return true;
  }
  if (near.line.distance >= stop) return false;
  half.reason = LineEnd::too_close;
  const bool at_start = near.line.line == id && half.sign > 0 && umbilic < 0 && near.line.arc < 2;
  if (!at_start) return true;
  const double aside = std::abs(cross2(near.line.offset, near.line.direction));
  if ((near.line.direction | head.direction) > 0.8 && aside < 0.3 * spacing) half.reason = LineEnd::loop;
  return true;
}

// Around a thin limb a line is back before it has gone the length in which it cannot run into itself: it
// would wind itself several times, on or close to itself.
bool LineTracer::comes_around(Half& half, const TracePoint& head) const {
  if (half.points.size() < 4 || std::abs(head.arc) > kOwnPart + options_.stop_fraction) return false;
  const auto place = [&](const TracePoint& p) { return domain_.place(p.point); };
  const Vec3d start = place(half.points[0]), leaves = place(half.points[1]) - start;
  const Vec3d last = place(half.points.back()) - start, now = place(head) - start;
  const double before = last | leaves, after = now | leaves;
  if (!(before < 0 && after >= 0) ||
      !(((now - last) | leaves) > kSameWay * (now - last).norm() * leaves.norm()))
    return false;
  const double aside = (last - before / (after - before) * (now - last)).norm();
  const double spacing = domain_.spacing(kind_, head.point);
  if (aside >= options_.stop_fraction * spacing) return false;
  half.reason = LineEnd::too_close;
  if (aside >= kComesAround * spacing || half.sign < 0) return true;
  half.reason = LineEnd::loop;
  while (half.points.size() > 4 && half.points.size() > half.entered &&
         (place(half.points.back()) - start).norm() < 3 * aside)
    half.points.pop_back();  // no kink where it closes
  return true;
}

void LineTracer::enter_lagging(Half& half, int id, bool all) {
  const TracePoint& head = half.points.back();
  size_t last = half.entered;
  while (last < half.points.size() && (all || std::abs(head.arc - half.points[last].arc) > kOwnPart - 0.2))
    ++last;
  // A piece starts with the end of the one before.
  if (last < half.entered + (half.entered == 0 ? 2 : 1)) return;
  std::vector<ArcPoint> piece;
  for (size_t i = half.entered == 0 ? 0 : half.entered - 1; i < last; ++i)
    piece.push_back({half.points[i].point, half.points[i].arc});
  if (half.entered == 0 && half.from_fence) {
    const double length = kPullBack * kOffFeature * domain_.spacing(kind_, half.points[0].point);
    piece.front().point = domain_.walk(half.points[0].point, length * half.points[0].direction).point;
  }
  if (last == half.points.size() && at_fence(half.reason) && last >= 2)
    piece.back().point = pulled_back(domain_, kind_, half.points[last - 2], half.points[last - 1]);
  index_.enter(id, piece);
  half.entered = last;
}

void LineTracer::run(Half& half, int id, int umbilic, double crossings_of_other_half) {
  double wanted = longest_step(half.points.back());
  double turned = 0, isotropic_since = 0;
  // A seed is never in an isotropic region; an umbilic is, and a line that stays there is of no use.
  size_t last_anisotropic = umbilic < 0 ? 1 : 0;
  for (size_t n = 0; n < kStepLimit; ++n) {
    const TracePoint from = half.points.back();
    const Step made = step(from, wanted);
    wanted = made.next_length;
    TracePoint head;
    head.point = made.reach.point;
    head.made = made.vector;
    const Vec2d carried = rotated_by(from.direction, made.reach.rotation);
    head.direction = direction(domain_.tensor(head.point), carried);
    const double length = made.length * made.reach.fraction;
    head.arc = from.arc + half.sign * length / domain_.spacing(kind_, from.point);
    head.crossings = from.crossings + half.sign * length / domain_.spacing(other(kind_), from.point);
    if (made.reach.blocked) {
      // A step that nearly ended on the fence leaves a speck of a segment; its point becomes the end itself.
      const bool speck = length < kSpeck * domain_.spacing(kind_, head.point);
      if (speck && half.points.size() > std::max<size_t>(half.entered, 1)) half.points.pop_back();
      half.points.push_back(head);
      half.reason = made.reach.border ? LineEnd::border : LineEnd::feature;
      return;
    }
    if (made.reach.fraction < 1) {  // the walk gave up at a vertex that it cannot get past
      half.reason = LineEnd::step_limit;
      return;
    }
    if (hits_umbilic(half, head, umbilic) || ends_here(half, head, id, umbilic)) return;
    const bool may_be_ring = umbilic < 0 && !half.from_fence && std::abs(turned) < kHardlyTurned;
    if (may_be_ring && comes_around(half, head)) return;
    half.points.push_back(head);

    // Small circles, tighter than the lines are apart, close before they are seen to.
    turned += std::asin(std::clamp(cross2(carried, head.direction), -1.0, 1.0));
    if (std::abs(turned) > 3 * M_PI && std::abs(head.arc) < 8) {
      half.reason = LineEnd::too_close;
      return;
    }
    if (!domain_.isotropic(head.point)) {
      last_anisotropic = half.points.size();
      isotropic_since = head.arc;
    } else if (std::abs(head.arc - isotropic_since) > 1) {
      half.points.resize(std::max(last_anisotropic, half.entered));
      half.reason = LineEnd::umbilic;
      return;
    }
    if (std::abs(head.crossings) + crossings_of_other_half > options_.min_crossings)
      enter_lagging(half, id, false);
  }
}

TracePoint LineTracer::after_straight_step(const TracePoint& start, double spacings, bool& blocked) const {
  const double length = spacings * domain_.spacing(kind_, start.point);
  const Reach reach = domain_.walk(start.point, length * start.direction);
  blocked = reach.blocked;
  TracePoint second;
  second.point = reach.point;
  second.made = length * start.direction;
  second.direction = direction(domain_.tensor(second.point), rotated_by(start.direction, reach.rotation));
  second.arc = spacings;
  second.crossings = length / domain_.spacing(other(kind_), start.point);
  return second;
}

TracedLine LineTracer::join(Half& forward, Half& backward, int id) {
  TracedLine line;
  if (forward.points.empty()) return line;
  const double crossings =
      forward.points.back().crossings - (backward.points.empty() ? 0 : backward.points.back().crossings);
  const bool across = at_fence(forward.reason) && at_fence(backward.reason);
  if (!across && crossings < options_.min_crossings) return line;
  enter_lagging(forward, id, true);
  if (backward.points.size() > 1) enter_lagging(backward, id, true);

  line.closed = forward.reason == LineEnd::loop;
  line.begin_reason = line.closed ? LineEnd::loop : backward.reason;
  line.end_reason = forward.reason;
  for (size_t i = backward.points.size(); i-- > 1;) {
    line.points.push_back(backward.points[i]);
    line.points.back().direction = -line.points.back().direction;
  }
  line.points.insert(line.points.end(), forward.points.begin(), forward.points.end());
  if (line.closed) {
    TracePoint start = line.points.front();
    index_.enter(id, {{line.points.back().point, line.points.back().arc},
                      {start.point, line.points.back().arc + 0.1}});
  }
  return line;
}

// An eigenvector has no sign: lines run to where the mean curvature is larger, whatever the frame. Where it
// is the same, as along a cylinder, to where they are less dense, or to where the nearest fence is nearer.
bool LineTracer::runs_so(const SurfacePoint& seed, const Vec3d& tensor, const Vec2d& direction) const {
  const double spacing = domain_.spacing(kind_, seed);
  const Vec2d half = 0.5 * spacing * direction;
  const auto at = [&](double way) { return domain_.walk(seed, way * half).point; };
  const auto fence = [&](double way) { return index_.nearest(at(way), kSeesFence * spacing).fence.distance; };
  const double curvature =
      landmark(domain_.tensor_ahead(seed, half)) - landmark(domain_.tensor_ahead(seed, -half));
  if (std::abs(curvature) > kTie * larger_curvature(tensor)) return curvature > 0;
  const double density = domain_.spacing(kind_, at(1)) - domain_.spacing(kind_, at(-1));
  if (std::abs(density) > kTie * spacing) return density > 0;
  return fence(1) <= fence(-1) * (1 + kTie);
}

TracedLine LineTracer::trace(const SurfacePoint& seed, int id) {
  Half forward, backward;
  TracePoint start;
  start.point = seed;
  const Vec3d tensor = domain_.tensor(seed);
  start.direction = kind_ == LineKind::max ? max_direction(tensor) : min_direction(tensor);
  if (!runs_so(seed, tensor, start.direction)) start.direction = -start.direction;
  forward.points.push_back(start);
  run(forward, id, -1, 0);
  if (forward.reason != LineEnd::loop) {
    start.direction = -start.direction;
    backward.sign = -1;
    backward.points.push_back(start);
    run(backward, id, -1, forward.points.empty() ? 0 : forward.points.back().crossings);
  }
  return join(forward, backward, id);
}

TracedLine LineTracer::trace_from_umbilic(int umbilic, const Vec2d& direction_there, int id) {
  Half forward, backward;
  TracePoint start;
  start.point = domain_.umbilics()[static_cast<size_t>(umbilic)].point;
  start.direction = direction_there;
  // The field has no direction at the umbilic itself: a first straight step leads off it.
  bool blocked = false;
  forward.points = {start, after_straight_step(start, kOffUmbilic, blocked)};
  if (!blocked) run(forward, id, umbilic, 0);
  backward.reason = LineEnd::umbilic;
  return join(forward, backward, id);
}

TracedLine LineTracer::trace_from_feature(const SurfacePoint& start_point, const Vec2d& direction_there,
                                          int id) {
  Half forward, backward;
  TracePoint start;
  start.point = start_point;
  start.direction = direction_there;
  bool blocked = false;
  forward.points = {start, after_straight_step(start, kOffFeature, blocked)};
  if (blocked) return {};
  forward.from_fence = true;
  run(forward, id, -1, 0);
  backward.reason = LineEnd::feature;
  return join(forward, backward, id);
}

}  // namespace anisomesh::detail
