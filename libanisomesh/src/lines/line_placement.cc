#include "lines/line_placement.hh"

#include <algorithm>
#include <cmath>
#include <queue>

#include "surface/intrinsic_order.hh"

namespace anisomesh::detail {

namespace {

constexpr double kOffFence =
    0.02;                       // of the distance searched: a line that starts nearer has no room to begin
constexpr double kReach = 2.5;  // spacings: seeds look about one around themselves, of a place less dense
constexpr double kSeedEvery = 0.5;  // spacings along a line between the seeds beside it
constexpr size_t kAskEvery = 256;   // candidates: whether to go on
constexpr double kParallel = 0.94;  // cosine: a fence this parallel to a line counts as a line

LineKind other(LineKind kind) { return kind == LineKind::min ? LineKind::max : LineKind::min; }

// A place beside a line, to be looked at again when its turn comes.
struct Candidate {
  double misfit = 0;  // |actual - wanted distance| / wanted
  double rank = 0;    // the misfit in steps that are far above rounding
  size_t order = 0;
  SurfacePoint origin;
  Vec2d across{0, 0};      // unit, away from the line
  bool continues = false;  // the origin is on a feature, where a line ended on the other side
  bool operator<(const Candidate& o) const {  // worse ones sink in the queue
    return rank != o.rank ? rank > o.rank : order > o.order;
  }
};

struct Seed {
  SurfacePoint point;
  double misfit = 0;
  bool fits = false;
  Vec2d direction{0, 0};  // of a line that continues another
};

class Placement {
 public:
  Placement(const Domain& domain, LineKind kind, const TraceOptions& options,
            const std::function<bool(double)>& going_on)
      : domain_(domain),
        kind_(kind),
        options_(options),
        going_on_(going_on),
        index_(domain.make_index(
            [&domain, kind](const SurfacePoint& at) { return kReach * domain.spacing(kind, at); })),
        tracer_(domain, *index_, kind, options),
        sampler_(domain, options.seed) {}

  PlacedLines run();

 private:
  bool trace_umbilics();
  std::vector<SurfacePoint> densest_places() const;
  bool trace_extreme();
  bool trace_queue();
  bool check_coverage();
  bool keep(TracedLine line);
  bool is_going_on() const { return going_on_(std::min(1.0, covered_ / sampler_.total_area())); }
  bool looked_at_many();
  double clearance(const SurfacePoint& at, double bound, bool umbilic = false) const;
  Seed seed_at(const Candidate& candidate) const;
  Seed continued(const SurfacePoint& beyond) const;
  void push(Candidate candidate);
  void queue(Candidate candidate, const Seed& seed);
  Vec2d line_direction(const SurfacePoint& at) const;

  const Domain& domain_;
  LineKind kind_;
  const TraceOptions& options_;
  const std::function<bool(double)>& going_on_;
  std::unique_ptr<LineIndex> index_;
  LineTracer tracer_;
  AreaSampler sampler_;
  std::priority_queue<Candidate> queue_;
  size_t candidates_ = 0, looked_at_ = 0;
  int next_id_ = 0;
  double covered_ = 0;
  PlacedLines result_;
};

Vec2d Placement::line_direction(const SurfacePoint& at) const {
  const Vec3d tensor = domain_.tensor(at);
  return kind_ == LineKind::max ? max_direction(tensor) : min_direction(tensor);
}

// Distance to the nearest line, or fence that runs like one; 0 on any fence. Infinite beyond the bound.
double Placement::clearance(const SurfacePoint& at, double bound, bool umbilic) const {
  const auto near = index_->nearest(at, bound);
  if (near.fence.distance < kOffFence * bound) return 0;
  if (umbilic) return near.line.distance;  // no direction there, so that no fence runs like it
  const bool parallel = std::abs(near.fence.direction | line_direction(at)) > kParallel;
  return std::min(near.line.distance, parallel ? near.fence.distance : near.line.distance);
}

// The seed at the wanted distance from a line, or in the middle of the gap beside it where the next line is
// nearer than twice that.
Seed Placement::seed_at(const Candidate& candidate) const {
  if (candidate.continues) return continued(candidate.origin);
  Seed seed;
  const double wanted = domain_.spacing(kind_, candidate.origin);
  const Reach reach = domain_.walk(candidate.origin, wanted * candidate.across);
  if (reach.blocked || domain_.isotropic(reach.point)) return seed;
  const double spacing = domain_.spacing(kind_, reach.point);
  double distance = clearance(reach.point, 1.02 * wanted);
  seed.point = reach.point;
  if (distance < 0.98 * wanted) {
    const double gap = wanted + distance;
    if (gap < 2 * options_.seed_fraction * spacing) return seed;
    const Reach middle = domain_.walk(candidate.origin, 0.5 * gap * candidate.across);
    if (middle.blocked || domain_.isotropic(middle.point)) return seed;
    seed.point = middle.point;
    distance = clearance(middle.point, 0.55 * gap);
  }
  distance = std::min(distance, wanted);
  const double here = domain_.spacing(kind_, seed.point);
  seed.misfit = std::abs(distance - here) / here;
  seed.fits = distance >= 0.97 * options_.seed_fraction * here;
  return seed;
}

// Where a line ended on a feature its neighbour on the other side starts, before any other line: two lines
// that meet there make one vertex of the result, two that miss each other make two and triangles between
// them.
Seed Placement::continued(const SurfacePoint& beyond) const {
  Seed seed;
  const double spacing = domain_.spacing(kind_, beyond);
  const Vec2d along = line_direction(beyond);
  for (const Vec2d& direction : {along, -along}) {
    const Reach reach = domain_.walk(beyond, kOffFeature * spacing * direction);
    if (reach.blocked || domain_.isotropic(reach.point)) continue;
    const double distance = std::min(clearance(reach.point, spacing), spacing);
    seed.point = beyond;
    seed.direction = direction;
    seed.misfit = -distance / spacing;
    seed.fits = distance >= 0.97 * options_.seed_fraction * spacing;
  }
  return seed;
}

void Placement::queue(Candidate candidate, const Seed& seed) {
  candidate.misfit = seed.misfit;
  candidate.rank = std::round(seed.misfit / kTie);
  queue_.push(candidate);
}

void Placement::push(Candidate candidate) {
  const Seed seed = seed_at(candidate);
  if (!seed.fits) return;
  candidate.order = candidates_++;
  queue(candidate, seed);
}

bool Placement::keep(TracedLine line) {
  ++next_id_;
  if (line.points.empty()) return true;
  double next_seed = line.points.front().arc;
  for (const TracePoint& p : line.points) {
    if (p.arc < next_seed) continue;
    next_seed = p.arc + kSeedEvery;
    const Vec2d across(-p.direction[1], p.direction[0]);
    for (const Vec2d& side : {across, -across}) {
      push({0, 0, 0, p.point, side, false});
    }
  }
  const auto continue_at = [this](LineEnd reason, const TracePoint& end) {
    if (reason != LineEnd::feature) return;
    const SurfacePoint beyond = domain_.beyond_feature(end.point);
    if (beyond.face.is_valid()) push({0, 0, 0, beyond, {0, 0}, true});
  };
  continue_at(line.begin_reason, line.points.front());
  continue_at(line.end_reason, line.points.back());
  for (size_t i = 1; i < line.points.size(); ++i) {
    const double s = domain_.spacing(kind_, line.points[i].point);
    covered_ += std::abs(line.points[i].arc - line.points[i - 1].arc) * s * s;
  }
  result_.lines.push_back(std::move(line));
  return is_going_on();
}

// Candidates and samples can be many without a line among them. \return whether to go on
bool Placement::looked_at_many() { return ++looked_at_ % kAskEvery != 0 || is_going_on(); }

// Lines from umbilics, the most curved first.
bool Placement::trace_umbilics() {
  const auto& umbilics = domain_.umbilics();
  for (size_t u = 0; u < umbilics.size(); ++u) {
    const UmbilicPoint& umbilic = umbilics[u];
    const double spacing = domain_.spacing(kind_, umbilic.point);
    if (clearance(umbilic.point, spacing, true) < options_.seed_fraction * spacing) continue;
    const auto directions = domain_.separatrices(umbilic, kind_);
    std::vector<Measures> measures;
    for (const Vec2d& direction : directions) {
      const double ahead = landmark(domain_.tensor_ahead(umbilic.point, 0.5 * spacing * direction));
      measures.push_back(
          {-ahead, domain_.spacing(kind_, domain_.walk(umbilic.point, 0.5 * spacing * direction).point), 0});
    }
    for (const int d : intrinsic_order(measures))
      if (!keep(
              tracer_.trace_from_umbilic(static_cast<int>(u), directions[static_cast<size_t>(d)], next_id_)))
        return false;
  }
  return true;
}

// Faces away from fences that want the densest lines, by the curvature; some of them where very many do.
std::vector<SurfacePoint> Placement::densest_places() const {
  constexpr size_t kEnough = 200;
  constexpr double kAsDense = 1.1;
  std::vector<SurfacePoint> places;
  std::vector<Measures> measures;
  double least = std::numeric_limits<double>::infinity();
  const auto centre_of = [](size_t f) {
    return SurfacePoint{OpenMesh::FaceHandle(static_cast<int>(f)), {1.0 / 3, 1.0 / 3, 1.0 / 3}};
  };
  for (size_t f = 0; f < domain_.n_faces(); ++f) {
    const SurfacePoint centre = centre_of(f);
    const double spacing = domain_.spacing(kind_, centre);
    if (spacing >= least || domain_.isotropic(centre)) continue;
    // Beside a fence there is no good start: half of it is cut off.
    if (std::isinf(index_->nearest(centre, 0.5 * spacing).fence.distance)) least = spacing;
  }
  for (size_t f = 0; f < domain_.n_faces(); ++f) {
    const SurfacePoint centre = centre_of(f);
    if (domain_.spacing(kind_, centre) >= kAsDense * least || domain_.isotropic(centre)) continue;
    places.push_back(centre);
    measures.push_back(
        {landmark(domain_.tensor(centre)), domain_.area(centre.face), domain_.away(centre.face)});
  }
  std::vector<SurfacePoint> some;
  const auto order = intrinsic_order(measures);
  for (size_t i = 0; i < order.size(); i += 1 + order.size() / kEnough)
    some.push_back(places[static_cast<size_t>(order[i])]);
  return some;
}

// The line through the face that wants the densest lines; of those that want as dense ones, through that
// which is as near to a fence as seeds may be.
bool Placement::trace_extreme() {
  constexpr double kStep = 0.01;  // spacings
  const SurfacePoint* best = nullptr;
  double least = std::numeric_limits<double>::infinity(), least_off = least;
  const auto places = densest_places();
  for (const SurfacePoint& place : places) {
    const double spacing = domain_.spacing(kind_, place);
    if (spacing > (1 + kTie) * least) continue;
    if (!std::isinf(index_->nearest(place, 0.5 * spacing).fence.distance)) continue;  // half is cut off
    const double away = std::min(clearance(place, 1.5 * spacing) / spacing, 1.5);
    const double off = std::round(std::abs(away - options_.seed_fraction) / kStep);
    if (spacing >= (1 - kTie) * least && off >= least_off) continue;
    least = spacing;
    least_off = off;
    best = &place;
  }
  return !best || keep(tracer_.trace(*best, next_id_));
}

bool Placement::trace_queue() {
  while (!queue_.empty()) {
    Candidate candidate = queue_.top();
    queue_.pop();
    if (!looked_at_many()) return false;
    const Seed seed = seed_at(candidate);
    if (!seed.fits) continue;
    if (seed.misfit > candidate.misfit + 0.02) {
      queue(candidate, seed);
      continue;
    }
    if (!keep(candidate.continues ? tracer_.trace_from_feature(seed.point, seed.direction, next_id_)
                                  : tracer_.trace(seed.point, next_id_)))
      return false;
  }
  return true;
}

bool Placement::check_coverage() {
  double cells = 0;
  for (size_t f = 0; f < domain_.n_faces(); ++f) {
    const OpenMesh::FaceHandle face(static_cast<int>(f));
    const SurfacePoint centre{face, {1.0 / 3, 1.0 / 3, 1.0 / 3}};
    cells += domain_.area(face) / (domain_.spacing(kind_, centre) * domain_.spacing(other(kind_), centre));
  }
  const size_t samples = 50 + static_cast<size_t>(2 * cells);
  for (size_t i = 0; i < samples; ++i) {
    if (!looked_at_many()) return false;
    const SurfacePoint at = sampler_.next();
    if (domain_.isotropic(at)) continue;
    const double spacing = domain_.spacing(kind_, at);
    if (clearance(at, spacing) < 0.8 * spacing) continue;
    const size_t before = result_.lines.size();
    if (!keep(tracer_.trace(at, next_id_))) return false;
    result_.coverage_seeds += result_.lines.size() - before;
    if (!trace_queue()) return false;
  }
  return true;
}

PlacedLines Placement::run() {
  bool going_on = trace_umbilics();
  if (going_on && result_.lines.empty()) going_on = trace_extreme();
  if (going_on) going_on = trace_queue();
  if (going_on) check_coverage();
  return std::move(result_);
}

}  // namespace

PlacedLines place_lines(const Domain& domain, LineKind kind, const TraceOptions& options,
                        const std::function<bool(double)>& going_on) {
  return Placement(domain, kind, options, going_on).run();
}

AreaSampler::AreaSampler(const Domain& domain, unsigned seed) : domain_(domain), state_(seed) {
  std::vector<Measures> measures;
  measures.reserve(domain.n_faces());
  for (size_t f = 0; f < domain.n_faces(); ++f) {
    const OpenMesh::FaceHandle face(static_cast<int>(f));
    measures.push_back(
        {landmark(domain.tensor({face, {1.0 / 3, 1.0 / 3, 1.0 / 3}})), domain.area(face), domain.away(face)});
  }
  order_ = intrinsic_order(measures);
  double sum = 0;
  cumulative_.reserve(order_.size());
  for (const int f : order_) cumulative_.push_back(sum += domain.area(OpenMesh::FaceHandle(f)));
}

// SplitMix64: the same numbers with every standard library. [Steele, Lea, Flood 2014]
double AreaSampler::uniform() {
  unsigned long long z = (state_ += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1p-53;
}

SurfacePoint AreaSampler::next() {
  const auto it = std::upper_bound(cumulative_.begin(), cumulative_.end(), uniform() * cumulative_.back());
  const auto face =
      std::min<std::ptrdiff_t>(it - cumulative_.begin(), static_cast<std::ptrdiff_t>(cumulative_.size()) - 1);
  return in_face(OpenMesh::FaceHandle(order_[static_cast<size_t>(face)]));
}

// The first corner is that opposite the longest side.
SurfacePoint AreaSampler::in_face(OpenMesh::FaceHandle face) {
  const double r = std::sqrt(uniform()), s = uniform();
  int first = 0;
  for (int i = 1; i < 3; ++i)
    if (domain_.side(face, i) > (1 + kTie) * domain_.side(face, first)) first = i;
  SurfacePoint point{face, {0, 0, 0}};
  point.barycentric[first] = 1 - r;
  point.barycentric[(first + 1) % 3] = r * (1 - s);
  point.barycentric[(first + 2) % 3] = r * s;
  return point;
}

}  // namespace anisomesh::detail
