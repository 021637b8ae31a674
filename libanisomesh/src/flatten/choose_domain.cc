#include <chrono>

#include "anisomesh/domain.hh"
#include "anisomesh/properties.hh"
#include "surface/canonical_copy.hh"

namespace anisomesh {

namespace {

// A face scan of 25,000 triangles, neck and all, has 4e-5: where far less is left of a part of the surface,
// the plane has no room for lines there.
constexpr double kLeastStretch = 1e-5;
constexpr double kMostDistortion = 2;

// Why the plane is not the place for this; empty where it is.
std::string try_plane(const SurfaceRef& surface, FlattenReport& report, const Progress& progress) {
  try {
    report = flatten(surface, progress);
  } catch (const CannotProcess& refusal) {
    return refusal.what();
  } catch (const SolverFailure& failure) {
    return failure.what();
  }
  if (!(report.min_area_stretch >= kLeastStretch))
    return "flattening leaves a " + std::to_string(1 / report.min_area_stretch) + "th of its area to a part";
  if (!(report.mean_conformal_distortion <= kMostDistortion))
    return "flattening distorts it by " + std::to_string(report.mean_conformal_distortion) + " on average";
  return {};
}

}  // namespace

DomainReport choose_domain(const SurfaceRef& surface, Domain wanted, const Progress& progress) {
  return choose_domain(surface, wanted, ChartOptions(), progress);
}

DomainReport choose_domain(const SurfaceRef& surface, Domain wanted, const ChartOptions& charts,
                           const Progress& progress) {
  if (!surface.canonical_copy())
    return detail::in_canonical_order(
        surface, [&](const SurfaceRef& ordered) { return choose_domain(ordered, wanted, charts, progress); });
  const auto start = std::chrono::steady_clock::now();
  DomainReport report;
  if (wanted == Domain::plane) {
    report.flatten = flatten(surface, progress);
  } else if (wanted == Domain::charts) {
    require_property(surface.connectivity(), property::tensor);
    report.charts = cut_into_charts(surface, charts, progress);
    unflatten(surface);
    report.used = Domain::charts;
  } else {
    require_property(surface.connectivity(), property::tensor);
    if (wanted == Domain::automatic) report.reason = try_plane(surface, report.flatten, progress);
    if (wanted == Domain::surface || !report.reason.empty()) {
      unflatten(surface);
      discard_charts(surface);
      report.flatten = {};
      report.used = Domain::surface;
    }
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace anisomesh
