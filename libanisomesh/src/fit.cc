#include "anisomesh/fit.hh"

#include <chrono>
#include <cmath>
#include <string>

#include "anisomesh/errors.hh"
#include "anisomesh/mesher.hh"
#include "anisomesh/properties.hh"
#include "fit_curves.hh"
#include "fit_guard.hh"
#include "fit_matching.hh"
#include "fit_terms.hh"

namespace anisomesh {

namespace {

using detail::FitPair;

constexpr double settled = 0.995;  // of the squared error: a pass that gains less is the last

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

/// All but corners: where a feature or border ends, meets another, or turns sharply.
std::vector<char> free_vertices(const OpenMesh::PolyMesh& result, const detail::FitMesh& mesh) {
  const auto origin = require_property(result, property::origin);
  std::vector<int> on_curves(result.n_vertices(), 0);
  for (const auto& side : mesh.sides)
    if (side.on_curve)
      for (const int v : {side.from, side.to}) ++on_curves[static_cast<size_t>(v)];
  std::vector<char> free;
  for (const auto v : result.vertices()) {
    const int curves = on_curves[static_cast<size_t>(v.idx())];
    free.push_back((curves == 0 || curves == 2) &&
                   result.property(origin, v) != static_cast<int>(Origin::corner));
  }
  return free;
}

double energy_of(const std::vector<FitPair>& pairs) {
  double sum = 0;
  for (const FitPair& pair : pairs) sum += pair.weight * pair.distance * pair.distance;
  return sum;
}

/// One state of the fit, and what the next is made from.
class Fit {
 public:
  Fit(const SurfaceRef& surface, const OpenMesh::PolyMesh& result, const FitOptions& options)
      : options_(options),
        mesh_(result),
        free_(free_vertices(result, mesh_)),
        points_(points_of(result)),
        input_(surface),
        triangles_(mesh_, points_),
        matching_(surface, input_, mesh_, sources_of(surface, result), triangles_, points_),
        curves_(surface, mesh_, matching_, points_),
        pairs_(matching_.match(triangles_, points_)),
        energy_(energy_of(pairs_)) {}

  double energy() const { return energy_; }
  const std::vector<Vec3d>& points() const { return points_; }

  /// Takes one step, if there is one that lowers the energy. \return vertices that were held back
  size_t improve() {
    std::vector<Vec3d> step = solve();
    const detail::FitGuard guard(mesh_, triangles_, input_, pairs_);
    const auto strays = [&](const std::vector<Vec3d>& points, std::vector<char>& marked) {
      curves_.mark_strays(points, marked);
    };
    for (int attempt = 0; attempt < max_attempts; ++attempt) {
      size_t held = 0;
      std::vector<Vec3d> moved = guard.move(points_, step, strays, held);
      detail::FitTriangles split(mesh_, moved);
      std::vector<FitPair> matched = matching_.match(split, moved);
      const double reached = energy_of(matched);
      if (reached < energy_) {
        energy_ = reached;
        points_ = std::move(moved);
        triangles_ = std::move(split);
        pairs_ = std::move(matched);
        curves_.match(points_);
        return held;
      }
      for (Vec3d& s : step) s *= shorter;
    }
    return 0;
  }

 private:
  static constexpr int max_attempts = 3;
  static constexpr double shorter = 0.4;

  static std::vector<Vec3d> points_of(const OpenMesh::PolyMesh& result) {
    std::vector<Vec3d> points;
    for (const auto v : result.vertices()) points.push_back(result.point(v));
    return points;
  }

  std::vector<Vec3d> solve() const {
    detail::FitSystem system(free_, 6 * triangles_.corner.size() + 16 * mesh_.sides.size());
    detail::add_surface_terms(mesh_, triangles_, input_, pairs_, points_, options_, system);
    double area = 0;
    for (const double a : triangles_.area) area += a;
    if (area > 0) {
      detail::add_planarity(mesh_, points_, options_.planarity_weight, area, system);
      curves_.add_terms(points_, std::sqrt(area / mesh_.n_polygons()), area, system);
    }
    return system.solve();
  }

  const FitOptions& options_;
  const detail::FitMesh mesh_;
  const std::vector<char> free_;
  std::vector<Vec3d> points_;
  const detail::FitInput input_;
  detail::FitTriangles triangles_;
  detail::FitMatching matching_;
  detail::FitCurves curves_;
  std::vector<FitPair> pairs_;
  double energy_;
};

}  // namespace

void FitOptions::validate() const {
  if (passes < 1) throw InvalidOption("fit.passes must be at least 1, but is " + std::to_string(passes));
  if (!(normal_weight >= 0)) throw InvalidOption("fit.normal_weight must not be negative");
  if (!(planarity_weight >= 0)) throw InvalidOption("fit.planarity_weight must not be negative");
  if (!(alignment_weight >= 0)) throw InvalidOption("fit.alignment_weight must not be negative");
  if (!(damping > 0)) throw InvalidOption("fit.damping must be above 0");
}

FitReport fit_vertices(const SurfaceRef& surface, OpenMesh::PolyMesh& result, const FitOptions& options,
                       const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  options.validate();
  Fit fit(surface, result, options);
  const std::vector<Vec3d> original = fit.points();
  FitReport report;
  const auto rms = [&] { return std::sqrt(0.5 * fit.energy()) / surface.diagonal(); };
  report.rms_before = rms();
  while (report.passes < options.passes) {
    report_progress(progress, report.passes / static_cast<double>(options.passes));
    const double before = fit.energy();
    report.held = std::max(report.held, fit.improve());
    ++report.passes;
    if (!(fit.energy() < settled * before)) break;
  }
  report.rms_after = rms();
  report_progress(progress, 1);
  for (const auto v : result.vertices()) {
    const auto i = static_cast<size_t>(v.idx());
    report.moved += fit.points()[i] != original[i];
    result.set_point(v, fit.points()[i]);
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace anisomesh
