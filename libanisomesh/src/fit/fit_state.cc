#include "fit/fit_state.hh"

#include <algorithm>
#include <cmath>
#include <string>

#include "anisomesh/errors.hh"
#include "anisomesh/mesher.hh"
#include "anisomesh/properties.hh"
#include "fit/fit_guard.hh"
#include "fit/fit_strays.hh"
#include "fit/fit_terms.hh"

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

constexpr int max_attempts = 3;
constexpr double settled = 0.995;  // of the squared error: a pass that gains less is the last
constexpr double longer = 1.5;     // than what the linearized terms ask for: with 2 passes as near as 3 to 4
constexpr double shorter = 0.4;    // a step that did not help
constexpr double coarse_share = 0.2, fineness = 10, most_alignment = 2.75;  // [docs/fit.md]

std::vector<Vec3d> points_of(const OpenMesh::PolyMesh& result) {
  std::vector<Vec3d> points;
  for (const auto v : result.vertices()) points.push_back(result.point(v));
  return points;
}

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
std::vector<char> free_vertices(const OpenMesh::PolyMesh& result, const FitMesh& mesh) {
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

/// As if all distances were the mean one: a few places that are far away do not count for all others.
double typical_energy(const FitPairs& pairs) {
  return pairs.weight > 0 ? pairs.mean * pairs.mean / pairs.weight : 0;
}

FitPairs matched(FitMatching& matching, const FitTriangles& triangles, const std::vector<Vec3d>& points) {
  FitPairs pairs;
  matching.match(triangles, points, nullptr, pairs);
  return pairs;
}

}  // namespace

FitState::FitState(const SurfaceRef& surface, const FitInput& input, const OpenMesh::PolyMesh& result,
                   const FitOptions& options)
    : surface_(surface),
      options_(options),
      input_(input),
      mesh_(result),
      free_(free_vertices(result, mesh_)),
      twins_(border_twins(result)),
      pattern_(mesh_),
      points_(points_of(result)),
      triangles_(mesh_, points_),
      matching_(surface, input_, mesh_, sources_of(surface, result), triangles_, points_),
      pairs_(matched(matching_, triangles_, points_)),
      curves_(surface, mesh_, matching_, points_) {}

FitState::FitState(FitState&& earlier, const OpenMesh::PolyMesh& result,
                   const std::vector<PolygonRange>& heirs)
    : surface_(earlier.surface_),
      options_(earlier.options_),
      input_(earlier.input_),
      mesh_(result),
      free_(free_vertices(result, mesh_)),
      twins_(border_twins(result)),
      pattern_(mesh_),
      points_(points_of(result)),
      triangles_(mesh_, points_),
      matching_(std::move(earlier.matching_), mesh_, sources_of(surface_, result), heirs, triangles_,
                points_),
      pairs_(matched(matching_, triangles_, points_)),
      spare_(std::move(earlier.spare_)),
      curves_(surface_, mesh_, matching_, points_) {}

size_t FitState::improve() {
  sum_forms(triangles_, input_, pairs_, points_, options_, forms_);
  std::vector<Vec3d> step = solve();
  for (Vec3d& s : step) s *= longer;
  keep_together(step);
  const FitGuard guard(mesh_, triangles_, forms_);
  FitStrays curve_strays(curves_);
  const auto strays = [&](const std::vector<Vec3d>& points, std::vector<char>& marked) {
    curve_strays.mark(points, marked);
    for (const auto& group : twins_) {
      const bool any = std::any_of(group.begin(), group.end(), [&](int v) { return marked[at(v)] != 0; });
      for (const int v : group) marked[at(v)] = any;
    }
  };
  for (int attempt = 0; attempt < max_attempts; ++attempt) {
    size_t held = 0;
    std::vector<Vec3d> moved = guard.move(points_, step, strays, held);
    FitTriangles split(mesh_, moved);
    matching_.match(split, moved, &pairs_, spare_);
    if (spare_.squared < pairs_.squared) {
      points_ = std::move(moved);
      triangles_ = std::move(split);
      std::swap(pairs_, spare_);
      curves_.match(points_);
      return held;
    }
    for (Vec3d& s : step) s *= shorter;
  }
  return 0;
}

/// The two sides of a slit go the same way, and none where one of them may not.
void FitState::keep_together(std::vector<Vec3d>& step) const {
  for (const auto& group : twins_) {
    Vec3d mean(0, 0, 0);
    for (const int v : group) mean += step[at(v)] / static_cast<double>(group.size());
    const bool free = std::all_of(group.begin(), group.end(), [&](int v) { return free_[at(v)] != 0; });
    for (const int v : group) step[at(v)] = free ? mean : Vec3d(0, 0, 0);
  }
}

int FitState::improve_often(int passes, size_t* held, const Progress& progress) {
  int done = 0;
  while (done < passes) {
    report_progress(progress, done / static_cast<double>(passes));
    const double before = energy();
    const size_t held_now = improve();
    if (held) *held = std::max(*held, held_now);
    ++done;
    if (!(energy() < settled * before)) break;
  }
  report_progress(progress, 1);
  return done;
}

double FitState::alignment_factor() const {
  const double share =
      static_cast<double>(points_.size()) / static_cast<double>(surface_.connectivity().n_vertices());
  return std::clamp(1 + fineness * (share - coarse_share), 1.0, most_alignment);
}

std::vector<Vec3d> FitState::solve() const {
  FitSystem system(free_, pattern_);
  add_surface_terms(mesh_, triangles_, input_, forms_, points_, options_,
                    alignment_factor() * typical_energy(pairs_), system);
  double area = 0;
  for (const double a : triangles_.area) area += a;
  if (area > 0) curves_.add_terms(points_, std::sqrt(area / mesh_.n_polygons()), area, system);
  return system.solve();
}

}  // namespace anisomesh::detail
