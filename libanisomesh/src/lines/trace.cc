#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <string>

#include "anisomesh/lines.hh"
#include "anisomesh/properties.hh"
#include "lines/crossing_model.hh"
#include "lines/line_placement.hh"
#include "lines/line_relaxation.hh"
#include "lines/make_domain.hh"
#include "lines/two_jobs.hh"
#include "surface/canonical_copy.hh"

namespace anisomesh {

namespace {

// With these 99 % of the samples of seven shapes lie within 2 epsilon (benchmarks/epsilon_bound).
constexpr double seed_fraction_by_epsilon = 0.7, cell_tolerance_by_epsilon = 2;

// Near umbilics lines are too close for even gaps to buy anything. [docs/lines.md]
constexpr size_t passes_without_umbilics = 5, most_passes = 1000;

constexpr double most_crossings = 1e7;  // more than memory holds

void require_drawable(const SurfaceRef& surface, const DensityOptions& density) {
  const double epsilon = density.epsilon(surface.diagonal(), surface.extent());
  const double crossings = detail::CrossingModel(surface, density).count(epsilon);
  if (crossings > most_crossings)
    throw InvalidOption("epsilon_fraction asks for about " + std::to_string(std::llround(crossings)) +
                        " crossings of lines, more than memory holds: it must be larger");
}

Line as_line(const detail::TracedLine& traced, LineKind kind) {
  Line line;
  line.kind = kind;
  line.closed = traced.closed;
  line.begin_reason = traced.begin_reason;
  line.end_reason = traced.end_reason;
  for (const detail::TracePoint& p : traced.points) line.points.push_back(p.point);
  return line;
}

// A pass of relaxing takes about as long as to place the lines.
detail::PlacedLines lines_of_kind(const SurfaceRef& surface, const detail::Domain& domain, LineKind kind,
                                  const TraceOptions& options, const std::function<bool(double)>& going_on) {
  const double passes = static_cast<double>(options.relax_passes.value_or(0));
  bool whole = true;
  const auto reached = [&](double fraction) { return whole = going_on(fraction / (1 + passes)); };
  detail::PlacedLines placed = detail::place_lines(domain, kind, options, reached);
  if (passes > 0 && whole)
    placed.lines = detail::relax_lines(
        surface, domain, kind, options, std::move(placed.lines),
        [&](double fraction) { return going_on((1 + passes * fraction) / (1 + passes)); });
  return placed;
}

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
  if (relax_passes.value_or(0) > most_passes)
    throw InvalidOption("relax_passes must be at most " + std::to_string(most_passes) + ", but is " +
                        std::to_string(*relax_passes));
}

TraceReport trace_lines(const SurfaceRef& surface, const TraceOptions& given, const Progress& progress) {
  if (!surface.canonical_copy())
    return detail::in_canonical_order(
        surface, [&](const SurfaceRef& ordered) { return trace_lines(ordered, given, progress); });
  const auto start = std::chrono::steady_clock::now();
  given.validate();
  TraceOptions options = given;
  if (options.seed_fraction == 0)
    options.seed_fraction = std::max(options.stop_fraction, seed_fraction_by_epsilon);
  const auto domain = detail::make_domain(surface, options.density, options.follow);
  require_drawable(surface, options.density);
  if (!options.relax_passes) options.relax_passes = domain->umbilics().empty() ? passes_without_umbilics : 0;
  report_progress(progress, 0);
  detail::PlacedLines both[2];  // they know nothing of each other: the same as one after the other
  const auto place = [&](LineKind kind) {
    return [&, kind](const std::function<bool(double)>& going_on) {
      both[static_cast<int>(kind)] = lines_of_kind(surface, *domain, kind, options, going_on);
    };
  };
  detail::run_both(place(LineKind::min), place(LineKind::max), progress);

  TraceReport report;
  LineNetwork network;
  for (const LineKind kind : {LineKind::min, LineKind::max}) {
    const auto& placed = both[static_cast<int>(kind)];
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
  for (const auto& target : {property::target_vertices, property::target_faces})
    mesh.property(provide_property(mesh, target)) = 0;
  write_lines(surface, network);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace anisomesh
