#include <algorithm>
#include <chrono>
#include <cmath>
#include <queue>

#include "anisomesh/lines.hh"
#include "line_placement.hh"
#include "plane_domain.hh"

namespace anisomesh {

namespace {

constexpr double kNearestSample = 0.75;  // spacings between samples, and from samples to fences and lines
constexpr double kNearestLine = 0.4;     // spacings from an umbilic to a line that does not end there
constexpr double kLineEnd = 1e-3;        // spacings: the line ends at the umbilic

// A candidate whose score is out of date as soon as another one is chosen.
struct Candidate {
  double misfit = 0;
  size_t order = 0;
  SurfacePoint point;
  bool operator<(const Candidate& o) const {
    return misfit != o.misfit ? misfit > o.misfit : order > o.order;
  }
};

class SamplePlacement {
 public:
  SamplePlacement(const detail::Domain& domain, const LineNetwork& network, unsigned seed)
      : domain_(domain), index_(domain.make_index()), sampler_(domain, seed) {
    for (const Line& line : network.lines) enter(line);
  }

  std::vector<SurfacePoint> from_umbilics();
  std::vector<SurfacePoint> random(const Progress& progress);

 private:
  void enter(const Line& line);
  double misfit(const SurfacePoint& at, bool umbilic);
  std::vector<SurfacePoint> choose(std::vector<Candidate> candidates, bool umbilics);

  const detail::Domain& domain_;
  std::unique_ptr<detail::LineIndex> index_;
  detail::AreaSampler sampler_;
  int next_id_ = 0;
};

void SamplePlacement::enter(const Line& line) {
  const auto at_fence = [](LineEnd reason) {
    return reason == LineEnd::border || reason == LineEnd::feature;
  };
  // What ends at a fence is entered without its last point, so that it does not cross the fence by rounding.
  const size_t first = at_fence(line.begin_reason) ? 1 : 0;
  const size_t last = line.points.size() - (at_fence(line.end_reason) ? 1 : 0);
  std::vector<detail::ArcPoint> points;
  for (size_t i = first; i < last; ++i) points.push_back({line.points[i], static_cast<double>(i)});
  if (line.closed && !points.empty()) points.push_back({points.front().point, static_cast<double>(last)});
  index_->enter(next_id_++, points);
}

// |actual - wanted| / wanted; infinite where a sample would be too near to what is there.
double SamplePlacement::misfit(const SurfacePoint& at, bool umbilic) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const double wanted = domain_.isotropic_spacing(at);
  const auto near = index_->nearest(at, 2 * wanted);
  double actual = std::min(2 * wanted, near.fence.distance);
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

std::vector<SurfacePoint> SamplePlacement::from_umbilics() {
  std::vector<Candidate> candidates;
  for (const auto& umbilic : domain_.umbilics()) candidates.push_back({0, candidates.size(), umbilic.point});
  return choose(std::move(candidates), true);
}

// Where the surface is flat or spherical: as many random points as it takes to leave no gap, and the best of
// them, one after the other.
std::vector<SurfacePoint> SamplePlacement::random(const Progress& progress) {
  constexpr double kCandidates = 30;  // for each sample wanted
  // Candidates are as dense as samples are to be: a share of each face's own.
  std::vector<Candidate> candidates;
  double share = 0;
  for (size_t f = 0; f < domain_.n_faces(); ++f) {
    const OpenMesh::FaceHandle face(static_cast<int>(f));
    const SurfacePoint centre{face, {1.0 / 3, 1.0 / 3, 1.0 / 3}};
    if (!domain_.isotropic(centre)) continue;
    const double spacing = domain_.isotropic_spacing(centre);
    for (share += kCandidates * domain_.area(face) / (spacing * spacing); share >= 1; --share) {
      const SurfacePoint at = sampler_.in_face(face);
      if (domain_.isotropic(at)) candidates.push_back({0, candidates.size(), at});
    }
  }
  report_progress(progress, 0.5);
  return choose(std::move(candidates), false);
}

}  // namespace

IsotropicReport place_isotropic_samples(const SurfaceRef& surface, const TraceOptions& options,
                                        const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  options.validate();
  LineNetwork network = read_lines(surface);
  const detail::PlaneDomain domain(surface, detail::read_plane_input(surface), options.density);
  report_progress(progress, 0);
  SamplePlacement placement(domain, network, options.seed);
  network.isotropic_samples = placement.from_umbilics();
  IsotropicReport report;
  report.from_umbilics = network.isotropic_samples.size();
  const auto random = placement.random(progress);
  report.random = random.size();
  network.isotropic_samples.insert(network.isotropic_samples.end(), random.begin(), random.end());
  report_progress(progress, 1);
  write_lines(surface, network);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace anisomesh
