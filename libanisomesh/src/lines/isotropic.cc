#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <queue>

#include "anisomesh/lines.hh"
#include "lines/line_placement.hh"
#include "lines/make_domain.hh"
#include "surface/canonical_copy.hh"
#include "surface/intrinsic_order.hh"

namespace anisomesh {

namespace {

constexpr double kNearestSample = 0.75;  // spacings between samples, and from samples to fences and lines
constexpr double kFarthest = 1.5;        // spacings that a sample looks around itself
constexpr double kReach = 2.5;           // the same as seen from where they lie denser
constexpr double kNearestLine = 0.4;     // spacings from an umbilic to a line that does not end there
constexpr double kLineEnd = 1e-3;        // spacings: the line ends at the umbilic

// A candidate whose score is out of date as soon as another one is chosen.
struct Candidate {
  double misfit = 0;
  size_t order = 0;
  SurfacePoint point;
  bool operator<(const Candidate& o) const {
    // By steps that are far above rounding.
    const double rank = std::round(misfit / detail::kTie), other_rank = std::round(o.misfit / detail::kTie);
    return rank != other_rank ? rank > other_rank : order > o.order;
  }
};

class SamplePlacement {
 public:
  SamplePlacement(const detail::Domain& domain, unsigned seed)
      : domain_(domain),
        index_(domain.make_index(
            [&domain](const SurfacePoint& at) { return kReach * domain.isotropic_spacing(at); })),
        sampler_(domain, seed) {}

  std::vector<Candidate> umbilic_candidates(const LineNetwork& network) const;
  std::vector<Candidate> random_candidates();
  /// Enters the lines as far as a candidate can see them.
  void enter_lines(const LineNetwork& network, const std::vector<const std::vector<Candidate>*>& candidates);
  std::vector<SurfacePoint> choose(std::vector<Candidate> candidates, bool umbilics);

 private:
  void enter(const Line& line, const std::vector<char>& near);
  double misfit(const SurfacePoint& at, bool umbilic);

  const detail::Domain& domain_;
  std::unique_ptr<detail::LineIndex> index_;
  detail::AreaSampler sampler_;
  int next_id_ = 0;
};

void SamplePlacement::enter_lines(const LineNetwork& network,
                                  const std::vector<const std::vector<Candidate>*>& candidates) {
  std::vector<char> near(domain_.n_faces(), 0);
  for (const auto* list : candidates)
    for (const Candidate& candidate : *list)
      domain_.mark_within(candidate.point, kFarthest * domain_.isotropic_spacing(candidate.point), near);
  for (const Line& line : network.lines) enter(line, near);
}

// Enters the runs of a line that have an end of a segment in a face that is near.
void SamplePlacement::enter(const Line& line, const std::vector<char>& near) {
  const auto at_fence = [](LineEnd reason) {
    return reason == LineEnd::border || reason == LineEnd::feature;
  };
  // What ends at a fence is entered without its last point, so that it does not cross the fence by rounding.
  const size_t first = at_fence(line.begin_reason) ? 1 : 0;
  const size_t last = line.points.size() - (at_fence(line.end_reason) ? 1 : 0);
  const auto is_near = [&](size_t i) { return near[static_cast<size_t>(line.points[i].face.idx())] != 0; };
  std::vector<detail::ArcPoint> run;
  for (size_t i = first; i < last; ++i) {
    const bool wanted = is_near(i) || (i > first && is_near(i - 1)) || (i + 1 < last && is_near(i + 1));
    if (wanted) run.push_back({line.points[i], static_cast<double>(i)});
    if ((!wanted || i + 1 == last) && !run.empty()) {
      index_->enter(next_id_, run);
      run.clear();
    }
  }
  if (line.closed && (is_near(first) || is_near(last - 1)))
    index_->enter(next_id_, {{line.points[last - 1], static_cast<double>(last - 1)},
                             {line.points[first], static_cast<double>(last)}});
  ++next_id_;
}

// |actual - wanted| / wanted; infinite where a sample would be too near to what is there.
double SamplePlacement::misfit(const SurfacePoint& at, bool umbilic) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const double wanted = domain_.isotropic_spacing(at);
  const auto near = index_->nearest(at, kFarthest * wanted);
  double actual = std::min(kFarthest * wanted, near.fence.distance);
  if (umbilic && near.line.distance < kNearestSample * wanted) {
    if (near.line.distance < kNearestLine * wanted && near.line.distance > kLineEnd * wanted) return kNever;
  } else {
    actual = std::min(actual, near.line.distance);
  }
  return actual < kNearestSample * wanted ? kNever : std::abs(actual - wanted) / wanted;
}

std::vector<SurfacePoint> SamplePlacement::choose(std::vector<Candidate> candidates, bool umbilics) {
  std::priority_queue<Candidate> queue;
  for (Candidate& candidate : candidates) {
    candidate.misfit = misfit(candidate.point, umbilics);
    if (!std::isinf(candidate.misfit)) queue.push(candidate);
  }
  std::vector<SurfacePoint> chosen;
  while (!queue.empty()) {
    Candidate candidate = queue.top();
    queue.pop();
    const double now = misfit(candidate.point, umbilics);
    if (std::isinf(now)) continue;
    if (now != candidate.misfit) {
      candidate.misfit = now;
      queue.push(candidate);
      continue;
    }
    chosen.push_back(candidate.point);
    index_->enter_sample(next_id_++, candidate.point);
  }
  return chosen;
}

// Umbilics where two or more lines end have their vertex from these already; a sample would only cut the
// quads around it into triangles.
std::vector<Candidate> SamplePlacement::umbilic_candidates(const LineNetwork& network) const {
  using Key = std::array<double, 4>;
  const auto key = [](const SurfacePoint& p) {
    return Key{static_cast<double>(p.face.idx()), p.barycentric[0], p.barycentric[1], p.barycentric[2]};
  };
  std::map<Key, int> ends;
  for (const Line& line : network.lines) {
    if (line.begin_reason == LineEnd::umbilic) ++ends[key(line.points.front())];
    if (line.end_reason == LineEnd::umbilic) ++ends[key(line.points.back())];
  }
  std::vector<Candidate> candidates;
  for (const auto& umbilic : domain_.umbilics()) {
    const auto found = ends.find(key(umbilic.point));
    if (found == ends.end() || found->second < 2) candidates.push_back({0, candidates.size(), umbilic.point});
  }
  return candidates;
}

// Where the surface is flat or spherical: more points than samples are wanted, so that the best of them fit.
std::vector<Candidate> SamplePlacement::random_candidates() {
  constexpr double kCandidates = 30;  // for each sample wanted
  std::vector<Candidate> candidates;
  double share = 0;
  for (const int f : sampler_.order()) {
    const OpenMesh::FaceHandle face(f);
    const SurfacePoint centre{face, {1.0 / 3, 1.0 / 3, 1.0 / 3}};
    if (!domain_.isotropic(centre)) continue;
    const double spacing = domain_.isotropic_spacing(centre);
    share += kCandidates * domain_.area(face) / (spacing * spacing);
    const double whole = std::floor(share);
    share -= whole;
    for (size_t i = 0; i < static_cast<size_t>(whole); ++i) {
      const SurfacePoint at = sampler_.in_face(face);
      if (domain_.isotropic(at)) candidates.push_back({0, candidates.size(), at});
    }
  }
  return candidates;
}

}  // namespace

IsotropicReport place_isotropic_samples(const SurfaceRef& surface, const TraceOptions& options,
                                        const Progress& progress) {
  if (!surface.canonical_copy())
    return detail::in_canonical_order(surface, [&](const SurfaceRef& ordered) {
      return place_isotropic_samples(ordered, options, progress);
    });
  const auto start = std::chrono::steady_clock::now();
  options.validate();
  LineNetwork network = read_lines(surface);
  const auto domain = detail::make_domain(surface, options.density, options.follow);
  report_progress(progress, 0);
  SamplePlacement placement(*domain, options.seed);
  auto umbilics = placement.umbilic_candidates(network), anywhere = placement.random_candidates();
  placement.enter_lines(network, {&umbilics, &anywhere});
  report_progress(progress, 0.3);
  network.isotropic_samples = placement.choose(std::move(umbilics), true);
  IsotropicReport report;
  report.from_umbilics = network.isotropic_samples.size();
  const auto random = placement.choose(std::move(anywhere), false);
  report.random = random.size();
  network.isotropic_samples.insert(network.isotropic_samples.end(), random.begin(), random.end());
  report_progress(progress, 1);
  write_lines(surface, network);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace anisomesh
