// Lines, samples and polygons; where a number of faces is wanted, with the epsilon that gives it.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "anisomesh/properties.hh"
#include "anisomesh/remesh.hh"
#include "balance/faces_left.hh"
#include "lines/crossing_model.hh"
#include "mesher/grids.hh"
#include "mesher/polygon_attempt.hh"
#include "prepare/feature_tolerance.hh"
#include "remesh/epsilon_search.hh"
#include "remesh/feature_model.hh"
#include "surface/canonical_copy.hh"
#include "surface/recorded.hh"

namespace anisomesh {

namespace {

/// Farther off, polygons need not be sound: their number tells the next epsilon.
constexpr double kWanted = 0.3;
/// A target buys most where lines leave wide gaps alone and samples go where the surface is farthest.
constexpr double kSeedFraction = 0.8, kCellTolerance = 4;
/// Polygons for the fit (MeshOptions::for_fit) in those for none, of the same lines.
constexpr double kForFit = 0.765, kFacesForFit = 0.84;
/// Off by so much, the balance that follows a fit makes up for it: better by adding vertices, which go to
/// where the error is largest, than by taking them out, which costs quads.
constexpr double kEnoughBelow = 0.10, kEnoughAbove = 0.07;

/// Where lines for so few would not tell the shape, the balance takes vertices out, of up to so many times as
/// many.
constexpr double kMostCoarsening = 8;

constexpr size_t most_wanted = 10'000'000;  // more than memory holds

/// Vertices made in attempts that were refused, once for each time they were made anew: no more are spent.
constexpr size_t kMostInVain = 60'000;
/// So many times the vertices that there have to be, no other epsilon need be tried for fewer.
constexpr double kHardlyMore = 1.05;

/// What the components alone need, however coarse: tetrahedra, and triangles of those with a border.
size_t least_vertices(const OpenMesh::TriConnectivity& mesh) {
  std::vector<char> seen(mesh.n_faces(), 0);
  std::vector<OpenMesh::FaceHandle> open;
  size_t count = 0;
  const auto reach = [&](OpenMesh::FaceHandle f) {
    if (seen[static_cast<size_t>(f.idx())]) return;
    seen[static_cast<size_t>(f.idx())] = 1;
    open.push_back(f);
  };
  for (const auto start : mesh.all_faces()) {
    if (seen[static_cast<size_t>(start.idx())]) continue;
    bool closed = true;
    for (reach(start); !open.empty();) {
      const auto f = open.back();
      open.pop_back();
      for (const auto h : mesh.fh_range(f)) {
        const auto across = mesh.opposite_halfedge_handle(h);
        closed = closed && !mesh.is_boundary(across);
        if (!mesh.is_boundary(across)) reach(mesh.face_handle(across));
      }
    }
    count += closed ? 4 : 3;
  }
  return count;
}

/// With found features a little more is made than is wanted: which of their vertices buy least the balance
/// knows better.
constexpr double kAimAtFeatures = 1.06, kEnoughAtFeatures = 0.05;

/// Of all that is wanted: what corners of features take at most, where the search begins.
constexpr double kMostCorners = 0.5;

/// What features need that are followed as nearly as epsilon asks for.
class FoundFeatures {
 public:
  FoundFeatures(const SurfaceRef& surface, const MeshOptions& options) : options_(options) {
    const bool asked = options.feature_tolerance > 0 ||
                       detail::recorded(surface.connectivity(), property::feature_tolerance,
                                        detail::asked_feature_tolerance) < detail::found_feature_tolerance;
    if (!asked) model_.emplace(surface, options.corner_angle_degrees);
  }

  /// Vertices, as far as the search should reckon with them. \param epsilon model units
  double needed(double wanted, double epsilon) const {
    if (!model_) return 0;
    return std::min(model_->corners(), kMostCorners * wanted) +
           model_->count(detail::chain_tolerance_of(options_, epsilon));
  }
  bool are_found() const { return model_ && model_->corners() + model_->count(0) > 0; }

 private:
  const MeshOptions& options_;
  std::optional<detail::FeatureModel> model_;
};

}  // namespace

void TargetOptions::validate() const {
  if (target_faces > 0 && target_vertices > 0)
    throw InvalidOption("target_faces and target_vertices exclude each other: give one");
  const size_t most = std::max(target_faces, target_vertices);
  if (most > most_wanted)
    throw InvalidOption((target_faces > 0 ? "target_faces" : "target_vertices") +
                        std::string(" must be at most ") + std::to_string(most_wanted) + ", but is " +
                        std::to_string(most));
  if (!(tolerance > 0 && tolerance < 1))
    throw InvalidOption("tolerance must be above 0 and below 1, but is " + std::to_string(tolerance));
  if (max_attempts < 1)
    throw InvalidOption("max_attempts must be at least 1, but is " + std::to_string(max_attempts));
}

OpenMesh::PolyMesh trace_and_mesh(const SurfaceRef& surface, const TraceOptions& trace,
                                  const MeshOptions& mesh, const TargetOptions& target,
                                  TraceAndMeshReport* report, const Progress& progress) {
  if (!surface.canonical_copy())
    return detail::in_canonical_order(surface, [&](const SurfaceRef& ordered) {
      return trace_and_mesh(ordered, trace, mesh, target, report, progress);
    });
  const auto start = std::chrono::steady_clock::now();
  target.validate();
  trace.validate();
  mesh.validate();

  const double diagonal = surface.diagonal();
  const double wanted = static_cast<double>(std::max(target.target_faces, target.target_vertices));
  TraceOptions options = trace;
  MeshOptions polygons = mesh;
  if (wanted > 0 && options.seed_fraction == 0)
    options.seed_fraction = std::max(options.stop_fraction, kSeedFraction);
  if (wanted > 0 && !options.relax_passes) options.relax_passes = 0;
  if (wanted > 0 && polygons.cell_tolerance == 0) polygons.cell_tolerance = kCellTolerance;
  TraceAndMeshReport done;
  const bool balanced = mesh.for_fit && (mesh.max_degree == 3 || mesh.max_degree == 4);
  auto& connectivity = surface.connectivity();
  const double euler = static_cast<double>(connectivity.n_vertices() + connectivity.n_faces()) -
                       static_cast<double>(connectivity.n_edges());
  const FoundFeatures features(surface, polygons);
  const auto count_of = [&](const MeshReport& made) {
    if (target.target_faces == 0) return made.vertices;
    return balanced && mesh.max_degree == 4 ? detail::faces_left(made.faces, made.vertices, euler)
                                            : made.faces;
  };
  // With `any` count, or only one that is near the target, worth being made sound.
  const auto run = [&](double from, double to, bool any) {
    const double span = to - from;
    done.trace = trace_lines(surface, options, sub_progress(progress, from, from + 0.5 * span));
    done.isotropic = place_isotropic_samples(surface, options,
                                             sub_progress(progress, from + 0.5 * span, from + 0.6 * span));
    done.epsilon_fraction = options.density.epsilon(diagonal, surface.extent()) / diagonal;
    if (wanted > 0) {  // for a build_polygons() to come
      connectivity.property(provide_property(connectivity, property::cell_tolerance)) =
          polygons.cell_tolerance;
    }
    const auto is_wanted = [&](const MeshReport& made) {
      return any || std::abs(static_cast<double>(count_of(made)) / wanted - 1) <= kWanted;
    };
    return detail::attempt_polygons(surface, polygons, is_wanted, &done.mesh,
                                    sub_progress(progress, from + 0.6 * span, to));
  };
  const auto finish = [&](OpenMesh::PolyMesh&& result) {
    report_progress(progress, 1);  // the search may have ended early
    done.attempts_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (report) *report = done;
    return std::move(result);
  };
  if (wanted == 0) return finish(run(0, 1, true).mesh);

  const detail::CrossingModel model(surface, trace.density);
  const size_t least = least_vertices(connectivity);
  OpenMesh::PolyMesh last, best;
  TraceAndMeshReport of_best;
  LineNetwork lines_of_best;
  bool is_last_best = false;
  detail::EpsilonSearch search;
  if (balanced) search.enough_below = kEnoughBelow, search.enough_above = kEnoughAbove;
  const double aim = balanced && features.are_found() ? kAimAtFeatures * wanted : wanted;
  if (aim > wanted) search.enough_below = search.enough_above = kEnoughAtFeatures;
  // For as many crossings there are fewer polygons where tolerances are wider.
  const double share = !mesh.for_fit ? 1 : target.target_faces > 0 ? kFacesForFit : kForFit;
  // In fractions of the extent, so that the same ones are tried however the surface is turned.
  search.crossings = [&](double fraction) {
    const double epsilon = fraction * surface.extent();
    return share * model.count(epsilon) + features.needed(wanted, epsilon) / detail::kFirstRatio;
  };
  size_t in_vain = 0;
  search.is_spent = [&] { return in_vain > kMostInVain; };
  if (balanced && target.coarsen)
    search.coarsest = std::max(model.coarsest_epsilon() / surface.extent(),
                               detail::epsilon_of(kMostCoarsening * wanted, search.crossings));
  search.make = [&, made = 0](double epsilon, bool any) mutable {
    options.density.epsilon_fraction = epsilon * surface.extent() / diagonal;
    is_last_best = false;
    ++made;
    done.mesh = {};
    detail::PolygonAttempt attempt;
    try {
      attempt = run(1 - std::pow(0.6, made - 1), 1 - std::pow(0.6, made), any);
    } catch (const CannotProcess&) {
      in_vain += done.mesh.retries * done.mesh.vertices;
      throw;
    }
    last = std::move(attempt.mesh);
    return detail::EpsilonSearch::Made{
        count_of(done.mesh), attempt.sound,
        static_cast<double>(done.mesh.vertices) <= kHardlyMore * static_cast<double>(least)};
  };
  search.keep = [&] {
    best = std::move(last);
    of_best = done;
    lines_of_best = read_lines(surface);
    is_last_best = true;
  };
  const detail::FoundEpsilon found = detail::search_epsilon(aim, target, search);
  done = of_best;
  done.attempts = found.attempts;
  done.tried = found.tried;
  for (Attempt& attempt : done.tried) attempt.epsilon_fraction *= surface.extent() / diagonal;
  done.target_met = found.met;
  if (!is_last_best) {
    write_lines(surface, lines_of_best);
    const auto epsilon = provide_property(surface.connectivity(), property::epsilon);
    surface.connectivity().property(epsilon) = done.epsilon_fraction * diagonal;
  }
  // What is too much because features, say, ask for as many, the balance takes out as far as that is cheap.
  const bool too_many = static_cast<double>(count_of(done.mesh)) > wanted;
  const bool divided =
      detail::divide_into_grids(surface, mesh, target.target_faces, target.target_vertices, best, done.mesh);
  if (divided) {
    const size_t count = target.target_faces > 0 ? done.mesh.faces : done.mesh.vertices;
    done.target_met = std::abs(static_cast<double>(count) / wanted - 1) <= detail::kMet;
  }
  if (divided || (balanced && (found.met || (target.coarsen && too_many)))) {
    const auto leave = [&](const auto& declaration, size_t count) {
      connectivity.property(provide_property(connectivity, declaration)) = static_cast<int>(count);
    };
    leave(property::target_vertices, target.target_vertices);
    leave(property::target_faces, target.target_faces);
  }
  return finish(std::move(best));
}

}  // namespace anisomesh
