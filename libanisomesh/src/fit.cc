#include "anisomesh/fit.hh"

#include <chrono>
#include <cmath>
#include <string>

#include "anisomesh/errors.hh"
#include "anisomesh/properties.hh"
#include "fit_guard.hh"
#include "fit_matching.hh"
#include "fit_system.hh"

namespace anisomesh {

namespace {

using detail::FitPair;

std::vector<OpenMesh::FaceHandle> sources_of(const SurfaceRef& surface, const OpenMesh::PolyMesh& result) {
  const auto source = require_property(result, property::source_face);
  const int n_faces = static_cast<int>(surface.connectivity().n_faces());
  std::vector<OpenMesh::FaceHandle> sources;
  for (const auto v : result.vertices()) {
    const int face = result.property(source, v);
    if (face < 0 || face >= n_faces)
      throw InvalidInput("vertex " + std::to_string(v.idx()) + " of the result comes from face " +
                         std::to_string(face) +
                         ", which the surface does not have; it was made from another");
    sources.emplace_back(face);
  }
  return sources;
}

std::vector<char> free_vertices(const OpenMesh::PolyMesh& result) {
  std::vector<char> free(result.n_vertices(), 1);
  for (const auto e : result.edges())
    if (result.is_boundary(e) || (result.has_edge_status() && result.status(e).feature()))
      free[static_cast<size_t>(e.v0().idx())] = free[static_cast<size_t>(e.v1().idx())] = 0;
  return free;
}

double energy_of(const std::vector<FitPair>& pairs) {
  double sum = 0;
  for (const FitPair& pair : pairs) sum += pair.weight * pair.distance * pair.distance;
  return sum;
}

}  // namespace

void FitOptions::validate() const {
  if (passes < 1) throw InvalidOption("fit.passes must be at least 1, but is " + std::to_string(passes));
  if (!(normal_weight >= 0)) throw InvalidOption("fit.normal_weight must not be negative");
  if (!(planarity_weight >= 0)) throw InvalidOption("fit.planarity_weight must not be negative");
  if (!(damping > 0)) throw InvalidOption("fit.damping must be above 0");
}

FitReport fit_vertices(const SurfaceRef& surface, OpenMesh::PolyMesh& result, const FitOptions& options,
                       const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  options.validate();
  const auto sources = sources_of(surface, result);
  const detail::FitMesh mesh(result);
  const std::vector<char> free = free_vertices(result);
  std::vector<Vec3d> points;
  for (const auto v : result.vertices()) points.push_back(result.point(v));
  const std::vector<Vec3d> original = points;

  detail::FitTriangles triangles(mesh, points);
  detail::FitMatching matching(surface, mesh, sources, triangles, points);
  std::vector<FitPair> pairs = matching.match(triangles, points);
  double energy = energy_of(pairs);
  FitReport report;
  const auto rms = [&](double e) { return std::sqrt(0.5 * e) / surface.diagonal(); };
  report.rms_before = rms(energy);
  for (int pass = 0; pass < options.passes; ++pass) {
    report_progress(progress, pass / static_cast<double>(options.passes));
    std::vector<Vec3d> step = detail::solve_fit(mesh, triangles, pairs, points, free, options);
    const detail::FitGuard guard(mesh, triangles, pairs);
    double next = energy;
    for (int attempt = 0; attempt < 3; ++attempt) {
      size_t held = 0;
      std::vector<Vec3d> moved = guard.move(points, step, held);
      detail::FitTriangles split(mesh, moved);
      std::vector<FitPair> matched = matching.match(split, moved);
      const double reached = energy_of(matched);
      if (reached < energy) {
        next = reached;
        report.held = std::max(report.held, held);
        points = std::move(moved);
        triangles = std::move(split);
        pairs = std::move(matched);
        break;
      }
      for (Vec3d& s : step) s *= 0.4;
    }
    ++report.passes;
    const bool done = !(next < 0.998 * energy);
    energy = next;
    if (done) break;
  }
  report.rms_after = rms(energy);
  for (const auto v : result.vertices()) {
    const auto i = static_cast<size_t>(v.idx());
    report.moved += points[i] != original[i];
    result.set_point(v, points[i]);
  }
  report_progress(progress, 1);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace anisomesh
