#include "anisomesh/fit.hh"

#include <chrono>
#include <cmath>
#include <string>

#include "anisomesh/errors.hh"
#include "fit/fit_state.hh"
#include "surface/canonical_copy.hh"
#include "surface/unfit_mesh.hh"

namespace anisomesh {

void FitOptions::validate() const {
  if (passes < 1) throw InvalidOption("fit.passes must be at least 1, but is " + std::to_string(passes));
  const auto require = [](bool good, const char* name, const char* range, double value) {
    if (!good || !std::isfinite(value))
      throw InvalidOption(std::string("fit.") + name + " must be finite and " + range + ", but is " +
                          std::to_string(value));
  };
  require(normal_weight >= 0, "normal_weight", "not negative", normal_weight);
  require(planarity_weight >= 0, "planarity_weight", "not negative", planarity_weight);
  require(alignment_weight >= 0, "alignment_weight", "not negative", alignment_weight);
  require(damping > 0, "damping", "above 0", damping);
}

FitReport fit_vertices(const SurfaceRef& surface, OpenMesh::PolyMesh& result, const FitOptions& options,
                       const Progress& progress) {
  if (!surface.canonical_copy())
    return detail::change_in_canonical_order(surface, result,
                                             [&](const SurfaceRef& ordered, OpenMesh::PolyMesh& work) {
                                               return fit_vertices(ordered, work, options, progress);
                                             });
  const auto start = std::chrono::steady_clock::now();
  options.validate();
  detail::refuse_unfit_result(result);
  const detail::FitInput input(surface);
  detail::FitState fit(surface, input, result, options);
  const std::vector<Vec3d> original = fit.points();
  FitReport report;
  const auto rms = [&] { return std::sqrt(0.5 * fit.energy()) / surface.diagonal(); };
  report.rms_before = rms();
  report.passes = fit.improve_often(options.passes, &report.held, progress);
  report.rms_after = rms();
  for (const auto v : result.vertices()) {
    const auto i = static_cast<size_t>(v.idx());
    report.moved += fit.points()[i] != original[i];
    result.set_point(v, fit.points()[i]);
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace anisomesh
