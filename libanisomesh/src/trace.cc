#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include "anisomesh/lines.hh"
#include "anisomesh/properties.hh"
#include "line_placement.hh"
#include "line_relaxation.hh"
#include "make_domain.hh"

namespace anisomesh {

namespace {

// With these 99 % of the samples of seven shapes lie within 2 epsilon (benchmarks/epsilon_bound).
constexpr double seed_fraction_by_epsilon = 0.7, cell_tolerance_by_epsilon = 2;

Line as_line(const detail::TracedLine& traced, LineKind kind) {
  Line line;
  line.kind = kind;
  line.closed = traced.closed;
  line.begin_reason = traced.begin_reason;
  line.end_reason = traced.end_reason;
  for (const detail::TracePoint& p : traced.points) line.points.push_back(p.point);
  return line;
}

// Both kinds at once; they know nothing of each other, so that the result is that of one after the other.
class BothKinds {
 public:
  BothKinds(const SurfaceRef& surface, const detail::Domain& domain, const TraceOptions& options,
            const Progress& progress)
      : surface_(surface),
        domain_(domain),
        options_(options),
        progress_(progress),
        caller_(std::this_thread::get_id()) {}

  void run() {
    tbb::parallel_invoke([this] { place(LineKind::min); }, [this] { place(LineKind::max); });
    if (cancelled_) throw Cancelled();
  }

  detail::PlacedLines placed[2];

 private:
  void place(LineKind kind) {
    const int k = static_cast<int>(kind);
    const double passes = static_cast<double>(options_.relax_passes);
    const auto reached = [this, k](double fraction) {
      done_[k] = fraction;
      if (progress_ && std::this_thread::get_id() == caller_ && !progress_(0.5 * (done_[0] + done_[1])))
        cancelled_ = true;
      return !cancelled_;
    };
    // A pass takes about as long as to place the lines.
    placed[k] = detail::place_lines(domain_, kind, options_,
                                    [&](double fraction) { return reached(fraction / (1 + passes)); });
    if (passes > 0 && !cancelled_)
      placed[k].lines = detail::relax_lines(
          surface_, domain_, kind, options_, std::move(placed[k].lines),
          [&](double fraction) { return reached((1 + passes * fraction) / (1 + passes)); });
    done_[k] = 1;
  }

  const SurfaceRef& surface_;
  const detail::Domain& domain_;
  const TraceOptions& options_;
  const Progress& progress_;
  std::thread::id caller_;
  std::atomic<double> done_[2] = {0, 0};
  std::atomic<bool> cancelled_{false};
};

}  // namespace

void TraceOptions::validate() const {
  density.validate();
  if (!(stop_fraction > 0 && stop_fraction < 1))
    throw InvalidOption("stop_fraction must be above 0 and below 1, but is " + std::to_string(stop_fraction));
  if (seed_fraction != 0 && !(seed_fraction >= stop_fraction && seed_fraction <= 1))
    throw InvalidOption("seed_fraction must be 0 or from stop_fraction to 1, but is " +
                        std::to_string(seed_fraction));
  if (!(min_crossings >= 0))
    throw InvalidOption("min_crossings must not be negative, but is " + std::to_string(min_crossings));
}

TraceReport trace_lines(const SurfaceRef& surface, const TraceOptions& given, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  given.validate();
  TraceOptions options = given;
  if (options.seed_fraction == 0)
    options.seed_fraction = std::max(options.stop_fraction, seed_fraction_by_epsilon);
  const auto domain = detail::make_domain(surface, options.density, options.follow);
  report_progress(progress, 0);
  BothKinds both(surface, *domain, options, progress);
  both.run();

  TraceReport report;
  LineNetwork network;
  for (const LineKind kind : {LineKind::min, LineKind::max}) {
    const auto& placed = both.placed[static_cast<int>(kind)];
    for (const auto& traced : placed.lines) {
      network.lines.push_back(as_line(traced, kind));
      report.points += traced.points.size();
      report.closed_lines += traced.closed ? 1 : 0;
      ++report.ends[static_cast<int>(traced.begin_reason)];
      ++report.ends[static_cast<int>(traced.end_reason)];
    }
    (kind == LineKind::min ? report.min_lines : report.max_lines) = placed.lines.size();
    report.coverage_seeds += placed.coverage_seeds;
  }
  report_progress(progress, 1);

  auto& mesh = surface.connectivity();
  mesh.property(provide_property(mesh, property::follow)) = static_cast<int>(options.follow);
  mesh.property(provide_property(mesh, property::epsilon)) = domain->epsilon();
  mesh.property(provide_property(mesh, property::cell_tolerance)) = cell_tolerance_by_epsilon;
  write_lines(surface, network);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace anisomesh
