#include "anisomesh/balance.hh"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "anisomesh/errors.hh"
#include "anisomesh/properties.hh"
#include "balance/faces_left.hh"
#include "balance/far_moves.hh"
#include "balance/patch_changes.hh"
#include "balance/quad_splits.hh"
#include "balance/unfold.hh"
#include "compare/compare_parts.hh"
#include "prepare/feature_tolerance.hh"
#include "remesh/epsilon_search.hh"
#include "surface/canonical_copy.hh"
#include "surface/recorded.hh"
#include "surface/unfit_mesh.hh"

namespace anisomesh {

namespace {

using detail::PatchChanges;
using detail::PatchMesh;
using detail::PatchMove;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr int passes_before = 2, passes_between = 1;
constexpr int more_rounds = 3;  // where the number is not met after those asked for
constexpr double near_enough = 0.05;
/// Fraction of the diagonal: what is the surface itself, but for rounding, nothing makes better.
constexpr double exact_rms = 1e-9;
/// Taken out at once where there are far too many, those that cost least then; and what a round must take out
/// of all for another to follow.
constexpr double most_at_once = 0.15, least_at_once = 0.02;
constexpr int trials = 12;    // of a round of moves, each without those that have broken a polygon
constexpr double sure = 1.2;  // an exchange must gain this many times what it costs
/// Where features that were asked for take more than this share of the vertices that are wanted, the others
/// go only as long as one costs no more than so many mean errors of a polygon: they tell all of the shape.
constexpr double features_alone = 0.9, dearest_of_few = 8;
/// ... or so many, where that meets a count that is missed by so little.
constexpr double dearest_for_count = 128, nearly_met = 0.3;

/// Takes removals and additions in turn, as long as that pays, or the number of vertices is not what it is to
/// be. \param dearest no vertex that is too many goes for more error than this
void exchange(PatchChanges& changes, const std::vector<PatchMove>& removals,
              const std::vector<PatchMove>& additions, long surplus, double dearest, BalanceReport& report) {
  size_t r = 0, a = 0;
  while (true) {
    while (r < removals.size() && !changes.is_open(removals[r])) ++r;
    while (a < additions.size() && !changes.is_open(additions[a])) ++a;
    const bool can_remove = r < removals.size(), can_add = a < additions.size();
    if (surplus > 0) {
      if (!can_remove) return;
      if (-removals[r].gain > dearest)
        surplus = 0;
      else
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

  /// Vertices that are too many: each stands for about as many faces as there are for one. \param left faces
  /// that there will be without that
  long surplus(const OpenMesh::PolyMesh& mesh, size_t left) const {
    const auto n = static_cast<double>(mesh.n_vertices()), f = static_cast<double>(left);
    if (faces > 0) return std::lround((f - static_cast<double>(faces)) * n / f);
    return static_cast<long>(mesh.n_vertices()) - static_cast<long>(vertices);
  }
  bool is_met(const OpenMesh::PolyMesh& mesh, double within) const {
    return std::abs(excess(mesh)) <= within;
  }
  bool is_exceeded(const OpenMesh::PolyMesh& mesh, double by) const { return excess(mesh) > by; }
  /// Vertices that the result would have.
  double of(const OpenMesh::PolyMesh& mesh) const {
    return static_cast<double>(mesh.n_vertices()) / (1 + excess(mesh));
  }

 private:
  /// As a fraction of what is wanted.
  double excess(const OpenMesh::PolyMesh& mesh) const {
    const auto there = static_cast<double>(faces > 0 ? mesh.n_faces() : mesh.n_vertices());
    return there / static_cast<double>(faces > 0 ? faces : vertices) - 1;
  }
};

bool takes_few(size_t before, size_t after) {
  return static_cast<double>(after) > (1 - least_at_once) * static_cast<double>(before);
}

/// On features that are followed however large epsilon is.
size_t vertices_on_asked_features(const SurfaceRef& surface, const OpenMesh::PolyMesh& result) {
  if (!result.has_edge_status() ||
      detail::recorded(surface.connectivity(), property::feature_tolerance,
                       detail::asked_feature_tolerance) >= detail::found_feature_tolerance)
    return 0;
  std::vector<char> on_feature(result.n_vertices(), 0);
  for (const auto e : result.edges())
    if (result.status(e).feature() && !result.is_boundary(e))
      for (const auto v : {e.v0(), e.v1()}) on_feature[static_cast<size_t>(v.idx())] = 1;
  return detail::count_marked(on_feature);
}

/// The result on its way, and what is known of it.
class Balance {
 public:
  Balance(const SurfaceRef& surface, const OpenMesh::PolyMesh& result, const BalanceOptions& options,
          const FitOptions& fit_options)
      : surface_(surface),
        input_(surface),
        reference_(surface),
        judge_(reference_, result),
        options_(options),
        fit_options_(fit_options),
        wanted_(surface, result, options),
        is_dear_(static_cast<double>(vertices_on_asked_features(surface, result)) >
                 features_alone * wanted_.of(result)),
        work_(result),
        state_(std::make_unique<detail::FitState>(surface, input_, work_, fit_options)) {}

  double rms() const { return std::sqrt(0.5 * state_->energy()) / surface_.diagonal(); }
  const detail::ReferenceSurface& reference() const { return reference_; }
  OpenMesh::PolyMesh& work() { return work_; }
  BalanceReport& report() { return report_; }
  const Wanted& wanted() const { return wanted_; }
  bool is_dear() const { return is_dear_; }

  void fit(int passes) {
    report_.fit.passes += state_->improve_often(passes);
    for (const auto v : work_.vertices()) work_.set_point(v, state_->points()[static_cast<size_t>(v.idx())]);
  }

  /// Moves that break a polygon are taken back, and others may take their place. \param at_any_cost vertices
  /// that are lacking come also where they gain nothing
  void move(bool at_any_cost = false) {
    const detail::PatchMoves moves(surface_, input_, *state_, options_);
    const PatchMesh start(work_);
    const auto at_once = static_cast<long>(most_at_once * static_cast<double>(work_.n_vertices()));
    const long surplus = std::min(wanted_.surplus(work_, faces_left()), at_once);
    const auto removals = moves.removals(start, surplus == at_once),
               additions = moves.additions(start, surplus < 0, at_any_cost),
               far = detail::FarMoves(reference_, *state_, options_).repartitions(start),
               repartitions = moves.repartitions(start);
    const double dearest = is_dear_ ? dearest_ * moves.mean_error() : infinite;
    PatchChanges::Moves refused;
    for (int trial = 1;; ++trial) {
      PatchMesh mesh = start;
      PatchChanges changes(mesh, refused);
      BalanceReport report = report_;
      part(changes, far, report);
      exchange(changes, removals, additions, surplus, dearest, report);
      part(changes, repartitions, report);
      const PatchChanges::Moves breaking =
          trial < trials ? changes.breaking(judge_, work_) : PatchChanges::Moves();
      if (breaking.empty()) {
        report_ = report;
        go_on_with(mesh);
        return;
      }
      refused.insert(breaking.begin(), breaking.end());
    }
  }

  /// Far too many are taken out a few at a time, each time those that cost least of what is there by then.
  /// \return whether some were
  bool coarsen(const Progress& progress) {
    bool any = false;
    while (wanted_.is_exceeded(work_, most_at_once)) {
      const size_t before = work_.n_vertices();
      report_progress(progress, 0);
      fit(any ? passes_between : passes_before);
      move();
      if (takes_few(before, work_.n_vertices())) break;
      any = true;
    }
    return any;
  }

  /// Takes out what costs more, if the number comes to be met by that.
  void meet_nearly(const Progress& progress) {
    const auto is_missed = [&] { return wanted_.is_exceeded(work_, detail::kMet); };
    if (!is_dear_ || !is_missed() || wanted_.is_exceeded(work_, nearly_met)) return;
    const OpenMesh::PolyMesh before = work_;
    const BalanceReport report = report_;
    dearest_ = dearest_for_count;
    for (int round = 0; round < more_rounds && is_missed(); ++round) {
      report_progress(progress, 0);
      fit(passes_between);
      move(true);
    }
    if (!is_missed()) return;
    work_ = before;
    report_ = report;
    state_ = std::make_unique<detail::FitState>(surface_, input_, work_, fit_options_);
  }

  /// The farthest places alone.
  void part_far() {
    PatchMesh mesh(work_);
    PatchChanges changes(mesh);
    const auto far = detail::FarMoves(reference_, *state_, options_).repartitions(mesh);
    part(changes, far, report_);
    if (!far.empty()) go_on_with(mesh);
  }

  void split_quads() {
    PatchMesh mesh(work_);
    report_.split = split_bent_quads(*state_, input_, options_.split_gain, options_.least_quads, mesh);
    if (report_.split > 0) work_ = mesh.mesh();
  }

 private:
  /// Triangles that the mesher left become quads in the first round, and stay those that cannot.
  size_t faces_left() const {
    const size_t n = work_.n_vertices(), f = work_.n_faces();
    if (report_.parted > 0 || options_.max_degree != 4) return f;
    return detail::faces_left(f, n, static_cast<double>(n + f) - static_cast<double>(work_.n_edges()));
  }
  static void part(PatchChanges& changes, const std::vector<PatchMove>& moves, BalanceReport& report) {
    for (const PatchMove& move : moves)
      if (changes.is_open(move)) changes.apply(move), ++report.parted;
  }
  void go_on_with(const PatchMesh& mesh) {
    work_ = mesh.mesh();
    state_ = std::make_unique<detail::FitState>(std::move(*state_), work_, mesh.heirs());
  }

  const SurfaceRef& surface_;
  const detail::FitInput input_;
  const detail::ReferenceSurface reference_;
  const detail::FaceJudge judge_;
  const BalanceOptions& options_;
  const FitOptions& fit_options_;
  const Wanted wanted_;
  const bool is_dear_;  // what is too much, since there are few vertices besides those on features
  double dearest_ = dearest_of_few;
  BalanceReport report_;
  OpenMesh::PolyMesh work_;
  std::unique_ptr<detail::FitState> state_;
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
  detail::refuse_unfit_result(result);
  Balance balance(surface, result, options, fit_options);
  BalanceReport& report = balance.report();
  OpenMesh::PolyMesh fitted;
  double rms_fitted = 0;
  report.fit.rms_before = balance.rms();
  if (report.fit.rms_before < exact_rms && balance.wanted().is_met(result, detail::kMet)) {
    report.fit.rms_after = report.fit.rms_before;
    report_progress(progress, 1);
    return report;
  }
  const bool change = options.rounds > 0 && (options.max_degree == 3 || options.max_degree == 4);
  const bool coarsened = change && balance.coarsen(progress);
  for (int round = 0; change && round < options.rounds + more_rounds; ++round) {
    if (round >= options.rounds && balance.wanted().is_met(balance.work(), near_enough)) break;
    report_progress(progress, std::min(round, options.rounds) / (options.rounds + 1.0));
    balance.fit(round == 0 ? passes_before : passes_between);
    if (round == 0) fitted = balance.work(), rms_fitted = balance.rms();
    const size_t before = balance.work().n_vertices();
    balance.move(round + 1 >= options.rounds);
    if (round + 1 >= options.rounds && balance.is_dear() && takes_few(before, balance.work().n_vertices()))
      break;
  }
  if (change)
    balance.meet_nearly(
        [&](double) { return !progress || progress(options.rounds / (options.rounds + 1.0)); });
  report_progress(progress, options.rounds / (options.rounds + 1.0));
  const int last = change ? (3 * fit_options.passes + 3) / 4 : fit_options.passes;  // it begins near then
  balance.fit(1);
  if (change) balance.part_far();
  balance.fit(last - 1);
  report.fit.rms_after = balance.rms();
  report_progress(progress, 1);
  // A number that the search has met may have cost more than the moves have gained; error falls as 1 /
  // vertices.
  const bool worse = change && options.target_vertices == 0 &&
                     balance.wanted().is_met(result, detail::kMet) &&
                     report.fit.rms_after * static_cast<double>(balance.work().n_vertices()) >
                         rms_fitted * static_cast<double>(result.n_vertices());
  if (change && !worse) balance.split_quads();
  std::vector<OpenMesh::PolyMesh> candidates;
  std::vector<double> rms;
  const auto add = [&](OpenMesh::PolyMesh&& candidate, double of_it) {
    candidates.push_back(std::move(candidate));
    rms.push_back(of_it);
  };
  if (!coarsened) add(OpenMesh::PolyMesh(result), report.fit.rms_before);
  if (change) add(std::move(fitted), rms_fitted);
  if (!worse) add(std::move(balance.work()), report.fit.rms_after);
  const auto taken = static_cast<size_t>(choose_unfolded(surface, balance.reference(), candidates));
  report.fit.rms_after = rms[taken];
  result = std::move(candidates[taken]);
  report.fit.seconds = report.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace anisomesh
