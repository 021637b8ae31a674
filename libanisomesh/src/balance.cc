#include "anisomesh/balance.hh"

#include <chrono>
#include <cmath>
#include <memory>
#include <string>

#include "anisomesh/errors.hh"
#include "anisomesh/properties.hh"
#include "canonical_copy.hh"
#include "compare_parts.hh"
#include "far_moves.hh"
#include "patch_moves.hh"
#include "quad_splits.hh"
#include "recorded.hh"
#include "unfold.hh"

namespace anisomesh {

namespace {

using detail::PatchChanges;
using detail::PatchMesh;
using detail::PatchMove;

constexpr int passes_before = 2, passes_between = 1;
constexpr double sure = 1.2;  // an exchange must gain this many times what it costs

/// Takes removals and additions in turn, as long as that pays, or the number of vertices is not what it is to
/// be.
void exchange(PatchChanges& changes, const std::vector<PatchMove>& removals,
              const std::vector<PatchMove>& additions, long surplus, BalanceReport& report) {
  size_t r = 0, a = 0;
  while (true) {
    while (r < removals.size() && !changes.is_open(removals[r])) ++r;
    while (a < additions.size() && !changes.is_open(additions[a])) ++a;
    const bool can_remove = r < removals.size(), can_add = a < additions.size();
    if (surplus > 0) {
      if (!can_remove) return;
      changes.apply(removals[r]), --surplus, ++report.removed;
    } else if (surplus < 0) {
      if (!can_add) return;
      changes.apply(additions[a]), ++surplus, ++report.added;
    } else {
      if (!can_remove || !can_add || !(additions[a].gain > -sure * removals[r].gain)) return;
      changes.apply(additions[a]), --surplus, ++report.added;
      surplus += 2;  // one more than wanted
    }
  }
}

/// How many there are to be in the end.
struct Wanted {
  size_t vertices = 0, faces = 0;  ///< the one or the other

  Wanted(const SurfaceRef& surface, const OpenMesh::PolyMesh& result, const BalanceOptions& options) {
    const auto& mesh = surface.connectivity();
    const auto of_search = [&](const auto& declaration) {
      return static_cast<size_t>(detail::recorded(mesh, declaration, 0));
    };
    vertices = options.target_vertices;
    if (vertices == 0) vertices = of_search(property::target_vertices);
    if (vertices == 0) faces = of_search(property::target_faces);
    if (vertices + faces == 0) vertices = result.n_vertices();
  }

  /// Vertices that are too many: each stands for about as many faces as there are for one.
  long surplus(const OpenMesh::PolyMesh& mesh) const {
    const auto n = static_cast<double>(mesh.n_vertices()), f = static_cast<double>(mesh.n_faces());
    if (faces > 0) return std::lround((f - static_cast<double>(faces)) * n / f);
    return static_cast<long>(mesh.n_vertices()) - static_cast<long>(vertices);
  }
};

}  // namespace

void BalanceOptions::validate() const {
  if (rounds < 0)
    throw InvalidOption("balance.rounds must not be negative, but is " + std::to_string(rounds));
  if (!(triangle_cost >= 0)) throw InvalidOption("balance.triangle_cost must not be negative");
  if (!(alignment_cost >= 0)) throw InvalidOption("balance.alignment_cost must not be negative");
  if (!(split_gain >= 0)) throw InvalidOption("balance.split_gain must not be negative");
  if (!(least_quads >= 0 && least_quads <= 1)) throw InvalidOption("balance.least_quads must be in [0, 1]");
}

BalanceReport balance_vertices(const SurfaceRef& surface, OpenMesh::PolyMesh& result,
                               const BalanceOptions& options, const FitOptions& fit_options,
                               const Progress& progress) {
  if (!surface.canonical_copy())
    return detail::change_in_canonical_order(
        surface, result, [&](const SurfaceRef& ordered, OpenMesh::PolyMesh& work) {
          return balance_vertices(ordered, work, options, fit_options, progress);
        });
  const auto start = std::chrono::steady_clock::now();
  options.validate();
  fit_options.validate();
  BalanceReport report;
  const detail::FitInput input(surface);
  const detail::ReferenceSurface reference(surface);
  OpenMesh::PolyMesh work = result, fitted;
  double rms_fitted = 0;
  const auto rms = [&](double energy) { return std::sqrt(0.5 * energy) / surface.diagonal(); };
  auto state = std::make_unique<detail::FitState>(surface, input, work, fit_options);
  report.fit.rms_before = rms(state->energy());
  const auto fit = [&](int passes) {
    report.fit.passes += state->improve_often(passes);
    for (const auto v : work.vertices()) work.set_point(v, state->points()[static_cast<size_t>(v.idx())]);
  };
  const size_t n_before = result.n_vertices();
  const Wanted wanted(surface, result, options);
  const bool change = options.rounds > 0 && (options.max_degree == 3 || options.max_degree == 4);
  for (int round = 0; change && round < options.rounds; ++round) {
    report_progress(progress, round / (options.rounds + 1.0));
    fit(round == 0 ? passes_before : passes_between);
    if (round == 0) {
      fitted = work;
      rms_fitted = rms(state->energy());
    }
    const detail::PatchMoves moves(surface, input, *state, options);
    PatchMesh mesh(work);
    PatchChanges changes(mesh);
    const long surplus = wanted.surplus(work);
    const auto removals = moves.removals(mesh), additions = moves.additions(mesh, surplus < 0);
    const double triangle = options.triangle_cost * moves.mean_error();
    const detail::FarMoves far(reference, *state, options.max_degree == 4, triangle);
    const auto far_moves = far.repartitions(mesh), repartitions = moves.repartitions(mesh);
    const auto apply = [&](const std::vector<PatchMove>& found) {
      for (const PatchMove& move : found)
        if (changes.is_open(move)) changes.apply(move), ++report.parted;
    };
    apply(far_moves);
    exchange(changes, removals, additions, surplus, report);
    apply(repartitions);
    work = mesh.mesh();
    state = std::make_unique<detail::FitState>(std::move(*state), work, mesh.heirs());
  }
  report_progress(progress, options.rounds / (options.rounds + 1.0));
  fit(change ? (3 * fit_options.passes + 3) / 4 : fit_options.passes);  // what was changed begins near
  report.fit.rms_after = rms(state->energy());
  report_progress(progress, 1);
  // A given number of vertices may have cost more than the moves have gained; error falls as 1 / vertices.
  const bool worse = change && options.target_vertices == 0 &&
                     report.fit.rms_after * static_cast<double>(work.n_vertices()) >
                         rms_fitted * static_cast<double>(n_before);
  if (worse) report.fit.rms_after = rms_fitted;
  if (change && !worse) {
    PatchMesh mesh(work);
    report.split = split_bent_quads(*state, input, options.split_gain, options.least_quads, mesh);
    if (report.split > 0) work = mesh.mesh();
  }
  std::vector<OpenMesh::PolyMesh> candidates{result};
  if (change) candidates.push_back(std::move(fitted));
  if (!worse) candidates.push_back(std::move(work));
  const auto taken = static_cast<size_t>(detail::choose_unfolded(surface, reference, candidates));
  if (taken + 1 < candidates.size()) report.fit.rms_after = taken == 0 ? report.fit.rms_before : rms_fitted;
  result = std::move(candidates[taken]);
  report.fit.seconds = report.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace anisomesh
