#include "lines/line_relaxation.hh"

#include <algorithm>
#include <cmath>

#include "lines/gap_map.hh"

namespace anisomesh::detail {

namespace {

constexpr double kFarthest = 3;    // spacings that a gap is looked for
constexpr double kTooNear = 0.3;   // spacings: no line so near to another one
constexpr double kTooWide = 1.25;  // spacings: a gap that a new line is tried in
constexpr double kEnd = 0.25;      // cells that an end of a line may cost
constexpr double kBeyond = 6;      // spacings that a line is followed beyond its end
constexpr double kWorth = 1e-6;    // cells: what is gained by less is rounding

LineKind other(LineKind kind) { return kind == LineKind::min ? LineKind::max : LineKind::min; }

bool at_fence(LineEnd reason) { return reason == LineEnd::border || reason == LineEnd::feature; }

// What is wrong with a gap of so many spacings, from 0 to 1: whether it is off by more than a quarter, made
// smooth.
double wrong(double gap) {
  const double off = std::abs(gap - 1) / 0.25;
  const double uneven = std::log(std::max(gap, 1e-6));
  return 1 / (1 + std::exp(8 * (1 - off))) + 0.05 * std::min(uneven * uneven, 4.0);
}

// How much a line turns to its left between two points, radian over a spacing.
double turning(const TracePoint& a, const TracePoint& b) {
  // Each half of a line was walked from the seed outward: a chord, half way between the directions of its
  // ends.
  const bool outward = b.arc > 0;
  const Vec2d along = outward ? a.direction : -b.direction, chord = outward ? b.made : a.made;
  const double turn = 2 * std::atan2(cross2(along, chord), along | chord);
  return (outward ? turn : -turn) / std::max(b.arc - a.arc, 1e-9);
}

// Lets a line run through all others: it ends at fences and umbilics, and where it comes back to itself.
class LeafIndex final : public LineIndex {
 public:
  LeafIndex(const SurfaceRef& surface, const Domain& domain, LineKind kind)
      : surface_(surface), fences_(domain.make_index([&domain, kind](const SurfacePoint& at) {
          return domain.spacing(kind, at);
        })) {}

  void begin(double longest) {
    longest_ = longest;
    own_.clear();
    met_itself_ = false;
  }
  bool met_itself() const { return met_itself_; }

  Neighbourhood nearest(const SurfacePoint& at, double bound, int /*own*/, double from, double to) override {
    Neighbourhood found = fences_->nearest(at, bound);
    if (std::abs(0.5 * (from + to)) > longest_) found.line.distance = 0;
    const Vec3d here = position(surface_, at);
    for (size_t i = 1; i < own_.size(); ++i) {
      const Own &a = own_[i - 1], &b = own_[i];
      if (a.run != b.run || (b.arc >= from && b.arc <= to) || (a.arc >= from && a.arc <= to)) continue;
      const Vec3d along = b.place - a.place;
      const double t = std::clamp(((here - a.place) | along) / std::max(along.sqrnorm(), 1e-300), 0.0, 1.0);
      const double distance = (a.place + t * along - here).norm();
      if (distance >= std::min(bound, found.line.distance)) continue;
      found.line.distance = distance;
      met_itself_ = true;
    }
    return found;
  }
  void enter(int /*line*/, const std::vector<ArcPoint>& points) override {
    ++run_;
    for (const ArcPoint& p : points) own_.push_back({position(surface_, p.point), p.arc, run_});
  }
  void enter_sample(int /*id*/, const SurfacePoint& /*point*/) override {}

 private:
  struct Own {
    Vec3d place{0, 0, 0};
    double arc = 0;
    int run = 0;
  };
  const SurfaceRef& surface_;
  std::unique_ptr<LineIndex> fences_;
  std::vector<Own> own_;
  double longest_ = 0;
  int run_ = 0;
  bool met_itself_ = false;
};

TraceOptions without_least_length(TraceOptions options) {
  options.min_crossings = 0;
  return options;
}

// A line through all others and the parts of it that are of use.
struct Leaf {
  struct Part {
    size_t first = 0, last = 0;  // points [first, last)
  };
  TracedLine line;
  std::vector<Part> parts;
  double gain = 0;  // cells that become right
};

class Relaxation {
 public:
  Relaxation(const SurfaceRef& surface, const Domain& domain, LineKind kind, const TraceOptions& options,
             std::vector<TracedLine> lines)
      : domain_(domain),
        kind_(kind),
        options_(options),
        leaf_options_(without_least_length(options)),
        leaf_index_(surface, domain, kind),
        tracer_(domain, leaf_index_, kind, leaf_options_),
        map_(domain) {
    for (TracedLine& line : lines) add(std::move(line));
  }

  bool run(const std::function<bool(double)>& going_on);
  std::vector<TracedLine> take() {
    std::vector<TracedLine> lines;
    for (TracedLine& line : lines_)
      if (!line.points.empty()) lines.push_back(std::move(line));
    return lines;
  }

 private:
  void add(TracedLine line);
  void put(const Leaf& leaf);
  void move(size_t line, double where);
  void fill_beside(size_t line);
  double gap(const TracePoint& at, double side) const;
  Leaf leaf_through(const SurfacePoint& seed, double longest);
  Leaf beside(const TracePoint& at, double spacings, double longest);
  double gain_at(const TracedLine& leaf, size_t i) const;
  void choose_parts(Leaf& leaf) const;
  static bool stays(const TracedLine& line);

  const Domain& domain_;
  LineKind kind_;
  const TraceOptions& options_;
  TraceOptions leaf_options_;
  LeafIndex leaf_index_;
  LineTracer tracer_;
  GapMap map_;
  std::vector<TracedLine> lines_;  // no points: taken out
};

bool Relaxation::stays(const TracedLine& line) {
  const auto held = [](LineEnd reason) { return reason == LineEnd::umbilic || reason == LineEnd::feature; };
  return line.closed || held(line.begin_reason) || held(line.end_reason);
}

void Relaxation::add(TracedLine line) {
  map_.enter(static_cast<int>(lines_.size()), line.points, 0, line.points.size());
  lines_.push_back(std::move(line));
}

double Relaxation::gap(const TracePoint& at, double side) const {
  const double reach = kFarthest * domain_.spacing(kind_, at.point);
  const Vec2d across(-at.direction[1], at.direction[0]);
  return kFarthest * std::min(map_.along(at.point, side * reach * across), 1.0);
}

// What is gained, in cells, where a point of a leaf is in the result.
double Relaxation::gain_at(const TracedLine& leaf, size_t i) const {
  const auto& points = leaf.points;
  const size_t last = points.size() - 1, before = i == 0 ? 0 : i - 1, after = std::min(i + 1, last);
  // On a fence there is nothing to be seen: as beside it.
  const bool on_fence = (i == 0 && at_fence(leaf.begin_reason)) || (i == last && at_fence(leaf.end_reason));
  const TracePoint& p = points[!on_fence ? i : i == 0 ? after : before];
  const double left = gap(p, 1), right = gap(p, -1);
  if (std::min(left, right) < kTooNear) return -1e3;
  // The strip between the neighbours has its length and its density from its middle, wherever the line runs
  // in it: else lines would drift to where they are longer.
  const double bend = 0.5 * (turning(points[i == 0 ? 0 : before], points[i == 0 ? 1 : i]) +
                             turning(points[i == last ? before : i], points[i == last ? i : after]));
  const double area_left = left * std::max(1 - 0.5 * bend * left, 0.2),
               area_right = right * std::max(1 + 0.5 * bend * right, 0.2);
  const double here = domain_.spacing(kind_, p.point), across = domain_.spacing(other(kind_), p.point);
  const SurfacePoint middle =
      domain_.walk(p.point, 0.5 * (left - right) * here * Vec2d(-p.direction[1], p.direction[0])).point;
  const double scale = here / domain_.spacing(kind_, middle);
  const double whole = wrong((left + right) * scale);
  const double length = 0.5 * (points[after].crossings - points[before].crossings) * across;
  return length / domain_.spacing(other(kind_), middle) * scale *
         (area_left * (whole - wrong(left)) + area_right * (whole - wrong(right)));
}

// Each point of the leaf is in the result or not, so that the sum of what is gained there is largest, less
// what ends cost: two states for each point, and the best way to either.
void Relaxation::choose_parts(Leaf& leaf) const {
  const auto& points = leaf.line.points;
  const size_t n = points.size();
  const double begin_cost = at_fence(leaf.line.begin_reason) ? 0 : kEnd,
               end_cost = at_fence(leaf.line.end_reason) ? 0 : kEnd;
  std::vector<double> gains(n);
  for (size_t i = 0; i < n; ++i) gains[i] = gain_at(leaf.line, i);
  std::vector<char> from_on[2] = {std::vector<char>(n), std::vector<char>(n)};
  double off = 0, on = gains[0] - begin_cost;
  for (size_t i = 1; i < n; ++i) {
    from_on[0][i] = on - kEnd > off;
    from_on[1][i] = on >= off - kEnd;
    const double next_off = std::max(off, on - kEnd);
    on = std::max(on, off - kEnd) + gains[i];
    off = next_off;
  }
  std::vector<char> state(n);
  bool is_on = on - end_cost > off;
  for (size_t i = n; i-- > 0;) {
    state[i] = is_on;
    is_on = from_on[is_on ? 1 : 0][i];
  }
  for (size_t first = 0, last = 0; first < n; first = last + 1) {
    double gain = 0;
    for (last = first; last < n && state[last]; ++last) gain += gains[last];
    if (last - first < 2) continue;
    const double length = points[last - 1].crossings - points[first].crossings;
    const double ends = (first == 0 ? begin_cost : kEnd) + (last == n ? end_cost : kEnd);
    if (length < options_.min_crossings && ends > 0) continue;
    leaf.parts.push_back({first, last});
    leaf.gain += gain - ends;
  }
}

Leaf Relaxation::leaf_through(const SurfacePoint& seed, double longest) {
  Leaf leaf;
  if (domain_.isotropic(seed)) return leaf;
  leaf_index_.begin(longest);
  leaf.line = tracer_.trace(seed, 0);
  if (leaf_index_.met_itself()) leaf.line.points.clear();
  if (leaf.line.points.size() >= 2) choose_parts(leaf);
  return leaf;
}

Leaf Relaxation::beside(const TracePoint& at, double spacings, double longest) {
  const double length = spacings * domain_.spacing(kind_, at.point);
  const Reach reach = domain_.walk(at.point, length * Vec2d(-at.direction[1], at.direction[0]));
  return reach.blocked ? Leaf() : leaf_through(reach.point, longest);
}

void Relaxation::put(const Leaf& leaf) {
  for (const Leaf::Part& part : leaf.parts) {
    TracedLine line;
    const auto& points = leaf.line.points;
    const auto at = [&](size_t i) { return points.begin() + static_cast<std::ptrdiff_t>(i); };
    line.points.assign(at(part.first), at(part.last));
    line.begin_reason = part.first == 0 ? leaf.line.begin_reason : LineEnd::too_close;
    line.end_reason = part.last == points.size() ? leaf.line.end_reason : LineEnd::too_close;
    add(std::move(line));
  }
}

// Takes a line out and puts the best line of its gap in. \param where on the line the gap is looked at, in
// [0, 1]
void Relaxation::move(size_t which, double where) {
  const std::vector<TracePoint> points = std::move(lines_[which].points);
  lines_[which].points.clear();
  map_.erase(static_cast<int>(which));
  const double first = points.front().crossings, last = points.back().crossings;
  const auto is_there = [&](const TracePoint& p) { return p.crossings >= first + where * (last - first); };
  const auto found = std::find_if(points.begin() + 1, points.end() - 1, is_there);
  const TracePoint at = found == points.end() - 1 ? points[points.size() / 2] : *found;
  const double longest = points.back().arc - points.front().arc + kBeyond;
  const double left = gap(at, 1), right = gap(at, -1), whole = left + right;
  Leaf best = leaf_through(at.point, longest);
  const double even = 0.5 * (left - right) / whole;
  for (const double shift : {even, -0.36, -0.2, -0.1, -0.04, 0.04, 0.1, 0.2, 0.36}) {
    const double aside = shift * whole;
    if (left - aside < kTooNear || right + aside < kTooNear) continue;
    Leaf leaf = beside(at, aside, longest);
    if (leaf.gain > best.gain + kWorth) best = std::move(leaf);
  }
  put(best);
}

// Starts lines beside a line where the gap is too wide.
void Relaxation::fill_beside(size_t which) {
  const std::vector<TracePoint> points = lines_[which].points;
  double next = -1e300;
  for (const TracePoint& p : points) {
    if (p.crossings < next) continue;
    next = p.crossings + 1;
    for (const double side : {1.0, -1.0}) {
      const double wide = gap(p, side);
      if (wide < kTooWide) continue;
      Leaf best;
      for (const double share : {0.33, 0.5, 0.67}) {
        Leaf leaf = beside(p, side * share * wide, 2 * kBeyond);
        if (leaf.gain > best.gain) best = std::move(leaf);
      }
      if (best.gain > kWorth) put(best);
    }
  }
}

bool Relaxation::run(const std::function<bool(double)>& going_on) {
  constexpr double kWhere[] = {0.5, 0.25, 0.75, 0.1, 0.9};
  const size_t passes = options_.relax_passes.value_or(0);
  for (size_t pass = 0; pass < passes; ++pass)
    for (const bool moving : {true, false})
      for (size_t i = 0, end = lines_.size(); i < end; ++i) {
        if (lines_[i].points.size() < 3) continue;
        if (!moving)
          fill_beside(i);
        else if (!stays(lines_[i]))
          move(i, kWhere[pass % 5]);
        const double done = static_cast<double>(pass) + (moving ? 0 : 0.5) +
                            0.5 * static_cast<double>(i) / static_cast<double>(end);
        if (!going_on(done / static_cast<double>(passes))) return false;
      }
  return true;
}

}  // namespace

std::vector<TracedLine> relax_lines(const SurfaceRef& surface, const Domain& domain, LineKind kind,
                                    const TraceOptions& options, std::vector<TracedLine> lines,
                                    const std::function<bool(double)>& going_on) {
  Relaxation relaxation(surface, domain, kind, options, std::move(lines));
  relaxation.run(going_on);
  return relaxation.take();
}

}  // namespace anisomesh::detail
