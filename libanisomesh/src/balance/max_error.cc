#include "anisomesh/max_error.hh"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "anisomesh/errors.hh"
#include "balance/patch_changes.hh"
#include "compare/compare_parts.hh"
#include "numerics/hausdorff.hh"
#include "surface/canonical_copy.hh"
#include "surface/unfit_mesh.hh"

namespace anisomesh {

namespace {

using detail::PatchMesh;
using detail::PatchMove;

constexpr int passes_between = 2;
constexpr double near_bound = 0.85;  // of the bound: there vertices are added
constexpr double far_below = 0.6;    // of the bound: what a removal must leave

detail::TriangleTree tree_of(const SurfaceRef& surface) {
  std::vector<detail::Triangle> triangles;
  for (const auto f : surface.connectivity().faces()) {
    const auto c = surface.corners(f);
    triangles.push_back({c.vertex[0].idx(), c.vertex[1].idx(), c.vertex[2].idx()});
  }
  return {surface.points(), triangles};
}

/// Edges as triangles whose last two corners are one.
template <class Mesh, class Takes>
std::vector<detail::Triangle> edges_of(const Mesh& mesh, Takes takes) {
  std::vector<detail::Triangle> edges;
  for (const auto e : mesh.edges())
    if (takes(mesh, e)) edges.push_back({e.v0().idx(), e.v1().idx(), e.v1().idx()});
  return edges;
}

constexpr auto is_border = [](const auto& mesh, OpenMesh::EdgeHandle e) { return mesh.is_boundary(e); };
constexpr auto is_feature = [](const auto& mesh, OpenMesh::EdgeHandle e) {
  return !mesh.is_boundary(e) && mesh.has_edge_status() && mesh.status(e).feature();
};

/// What of the input the result is measured against.
struct Reference {
  explicit Reference(const SurfaceRef& surface)
      : all(tree_of(surface)),
        border(surface.points(), edges_of(surface.connectivity(), is_border)),
        features(surface.points(), edges_of(surface.connectivity(), is_feature)) {}
  detail::TriangleTree all, border, features;
};

/// Bounds of Hausdorff distances, both ways, model units.
struct Bounds {
  detail::DistanceBounds surface, border, features;
  double at_least() const { return std::max({surface.at_least, border.at_least, features.at_least}); }
  double at_most() const { return std::max({surface.at_most, border.at_most, features.at_most}); }
};

detail::DistanceBounds both_ways(const detail::TriangleTree& one, const detail::TriangleTree& other,
                                 double limit) {
  const auto to = detail::farthest_distance(one, other, limit),
             from = detail::farthest_distance(other, one, limit);
  return {std::max(to.at_least, from.at_least), std::max(to.at_most, from.at_most)};
}

Bounds verify(const Reference& input, const OpenMesh::PolyMesh& result, double limit) {
  const detail::PolygonSoup soup(result, FaceDiagonal::shorter);
  return {both_ways(input.all, {soup.points, soup.triangles}, limit),
          both_ways(input.border, {soup.points, edges_of(result, is_border)}, limit),
          both_ways(input.features, {soup.points, edges_of(result, is_feature)}, limit)};
}

/// Applies all moves that are still open. \return how many
size_t apply_all(detail::PatchChanges& changes, const std::vector<PatchMove>& moves) {
  size_t count = 0;
  for (const PatchMove& move : moves)
    if (changes.is_open(move)) changes.apply(move), ++count;
  return count;
}

/// The best result so far: one that meets the bound before one that does not, then the smaller one.
struct Best {
  OpenMesh::PolyMesh mesh;
  Bounds bounds;
  bool met = false, any = false;

  void take(const OpenMesh::PolyMesh& other, const Bounds& found, double limit) {
    const bool meets = found.at_most() <= limit;
    const bool better = !any || (meets && !met) ||
                        (meets == met && (met ? other.n_vertices() < mesh.n_vertices()
                                              : found.at_least() < bounds.at_least()));
    if (!better) return;
    mesh = other;
    bounds = found;
    met = meets;
    any = true;
  }
};

}  // namespace

void MaxErrorOptions::validate() const {
  if (!(max_error_fraction >= 0))
    throw InvalidOption("max_error_fraction must not be negative, but is " +
                        std::to_string(max_error_fraction));
  if (rounds < 1)
    throw InvalidOption("max_error.rounds must be at least 1, but is " + std::to_string(rounds));
  if (max_attempts < 1)
    throw InvalidOption("max_error.max_attempts must be at least 1, but is " + std::to_string(max_attempts));
}

MaxErrorReport bound_error(const SurfaceRef& surface, OpenMesh::PolyMesh& result,
                           const MaxErrorOptions& options, const BalanceOptions& balance,
                           const FitOptions& fit, const Progress& progress) {
  if (!surface.canonical_copy())
    return detail::change_in_canonical_order(
        surface, result, [&](const SurfaceRef& ordered, OpenMesh::PolyMesh& work) {
          return bound_error(ordered, work, options, balance, fit, progress);
        });
  const auto start = std::chrono::steady_clock::now();
  options.validate();
  balance.validate();
  fit.validate();
  if (!(options.max_error_fraction > 0))
    throw InvalidOption("max_error_fraction must be above 0 for bound_error()");
  detail::refuse_unfit_result(result);
  const double limit = options.max_error_fraction * surface.diagonal();
  const Reference reference(surface);
  const detail::FitInput input(surface);
  const bool change = balance.max_degree == 3 || balance.max_degree == 4;
  MaxErrorReport report;
  OpenMesh::PolyMesh work = result;
  Best best;
  auto state = std::make_unique<detail::FitState>(surface, input, work, fit);
  for (int round = 0;; ++round) {
    report_progress(progress, round / (options.rounds + 1.0));
    const bool last = !change || round == options.rounds;
    const double scale = std::sqrt(0.5) / surface.diagonal();
    if (round == 0) report.balance.fit.rms_before = scale * std::sqrt(state->energy());
    report.balance.fit.passes += state->improve_often(last ? fit.passes : passes_between);
    report.balance.fit.rms_after = scale * std::sqrt(state->energy());
    for (const auto v : work.vertices()) work.set_point(v, state->points()[static_cast<size_t>(v.idx())]);
    best.take(work, verify(reference, work, limit), limit);
    if (last) break;
    detail::PatchMoves moves(surface, input, *state, balance);
    moves.set_limit(far_below * limit);
    PatchMesh mesh(work);
    const auto additions = moves.additions_beyond(mesh, near_bound * limit),
               repartitions = moves.repartitions(mesh);
    const bool mend_only = round >= options.rounds / 2;
    const auto removals = mend_only ? std::vector<PatchMove>() : moves.removals(mesh);
    detail::PatchChanges changes(mesh);
    report.balance.added += apply_all(changes, additions);
    report.balance.parted += apply_all(changes, repartitions);
    report.balance.removed += apply_all(changes, removals);
    work = mesh.mesh();
    state = std::make_unique<detail::FitState>(std::move(*state), work, mesh.heirs());
  }
  report.met = best.met;
  const auto fraction = [&](const detail::DistanceBounds& b) {
    return VerifiedDistance{b.at_least / surface.diagonal(), b.at_most / surface.diagonal()};
  };
  report.at_least = fraction(best.bounds.surface).at_least;
  report.at_most = fraction(best.bounds.surface).at_most;
  report.border = fraction(best.bounds.border);
  report.features = fraction(best.bounds.features);
  result = std::move(best.mesh);
  report_progress(progress, 1);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace anisomesh
