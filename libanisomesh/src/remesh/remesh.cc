#include "anisomesh/remesh.hh"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "remesh/epsilon_search.hh"
#include "surface/canonical_copy.hh"

namespace anisomesh {

void RemeshOptions::validate() const {
  TargetOptions::validate();
  features.validate();
  curvature.validate();
  charts.validate();
  smoothing.validate();
  trace.validate();
  mesh.validate();
  fit.validate();
  balance.validate();
  max_error.validate();
  if (max_error.max_error_fraction > 0 && (target_faces > 0 || target_vertices > 0))
    throw InvalidOption("a bound on the error and a target exclude each other: give one");
}

namespace {

/// What buys most, as for a target: lines leave wide gaps alone, samples go where the surface is farthest.
constexpr double bound_seed_fraction = 0.8, bound_cell_tolerance = 4;

/// Traces for epsilons that begin with the bound itself, until a result meets it.
OpenMesh::PolyMesh remesh_within(const SurfaceRef& surface, const RemeshOptions& options,
                                 const BalanceOptions& balance, RemeshReport& done,
                                 const Progress& progress) {
  TraceOptions trace = options.trace;
  MeshOptions mesh = options.mesh;
  trace.density.epsilon_fraction = options.max_error.max_error_fraction;
  if (trace.seed_fraction == 0) trace.seed_fraction = std::max(trace.stop_fraction, bound_seed_fraction);
  if (!trace.relax_passes) trace.relax_passes = 0;
  if (mesh.cell_tolerance == 0) mesh.cell_tolerance = bound_cell_tolerance;
  OpenMesh::PolyMesh best;
  const double count = options.max_error.max_attempts;
  for (int attempt = 1; attempt <= options.max_error.max_attempts; ++attempt) {
    TraceAndMeshReport traced;
    OpenMesh::PolyMesh result =
        trace_and_mesh(surface, trace, mesh, {}, &traced,
                       sub_progress(progress, (attempt - 1) / count, (attempt - 0.7) / count));
    const MaxErrorReport bound =
        bound_error(surface, result, options.max_error, balance, options.fit,
                    sub_progress(progress, (attempt - 0.7) / count, attempt / count));
    const auto farthest = [](const MaxErrorReport& r) {
      return std::max({r.at_least, r.border.at_least, r.features.at_least});
    };
    if (attempt == 1 || bound.met || farthest(bound) < farthest(done.max_error)) {
      static_cast<TraceAndMeshReport&>(done) = traced;
      done.max_error = bound;
      best = std::move(result);
    }
    done.max_error.attempts = attempt;
    if (bound.met) break;
    trace.density.epsilon_fraction /= 2;
  }
  done.balance = done.max_error.balance;
  done.fit = done.balance.fit;
  return best;
}

/// All stages after the features.
OpenMesh::PolyMesh remesh_tagged(const SurfaceRef& surface, const RemeshOptions& options, RemeshReport& done,
                                 const Progress& progress) {
  // About the share of each stage in the time of a scan of 25,000 triangles remeshed to 4,000 faces.
  done.curvature = estimate_curvature(surface, options.curvature, sub_progress(progress, 0, 0.15));
  done.domain = choose_domain(surface, options.domain, options.charts, sub_progress(progress, 0.15, 0.3));
  done.smoothing = smooth_tensors(surface, options.smoothing, sub_progress(progress, 0.3, 0.4));
  report_progress(progress, 0.4);
  done.umbilics = find_umbilics(surface);
  BalanceOptions balance = options.balance;
  balance.max_degree = options.mesh.max_degree;
  OpenMesh::PolyMesh result;
  if (options.max_error.max_error_fraction > 0) {
    result = remesh_within(surface, options, balance, done, sub_progress(progress, 0.4, 1));
  } else {
    MeshOptions mesh = options.mesh;
    mesh.for_fit |= options.fit.enabled;
    TargetOptions target = options;
    target.coarsen = target.coarsen && options.fit.enabled && options.balance.rounds > 0;
    result = trace_and_mesh(surface, options.trace, mesh, target, &done,
                            sub_progress(progress, 0.4, options.fit.enabled ? 0.8 : 1));
    if (options.fit.enabled)
      done.balance = balance_vertices(surface, result, balance, options.fit, sub_progress(progress, 0.8, 1));
    done.fit = done.balance.fit;
    if (const double wanted = static_cast<double>(std::max(options.target_faces, options.target_vertices));
        options.fit.enabled && wanted > 0) {
      const size_t count = options.target_faces > 0 ? result.n_faces() : result.n_vertices();
      done.target_met = std::abs(static_cast<double>(count) / wanted - 1) <= detail::kMet;
    }
  }
  return result;
}

/// As remesh_tagged(); what the plane refuses is done on the surface, unless the plane was asked for.
OpenMesh::PolyMesh remesh_somewhere(const SurfaceRef& surface, const RemeshOptions& options,
                                    RemeshReport& done, const Progress& progress) {
  double reached = 0;
  const Progress onward = [&](double fraction) {
    reached = std::max(reached, fraction);
    return !progress || progress(reached);
  };
  try {
    return remesh_tagged(surface, options, done, onward);
  } catch (const CannotProcess&) {
    if (options.domain != Domain::automatic || done.domain.used != Domain::plane) throw;
  }
  RemeshOptions elsewhere = options;
  elsewhere.domain = Domain::surface;
  return remesh_tagged(surface, elsewhere, done, onward);
}

}  // namespace

OpenMesh::PolyMesh remesh(const SurfaceRef& surface, const RemeshOptions& options, RemeshReport* report,
                          const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  options.validate();
  RemeshReport done;
  done.features = tag_features(surface, options.features);
  OpenMesh::PolyMesh result = detail::in_canonical_order(
      surface, [&](const SurfaceRef& ordered) { return remesh_somewhere(ordered, options, done, progress); });
  done.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (report) *report = done;
  return result;
}

}  // namespace anisomesh
