// Epsilon from a number of faces: a guess from the density, then a search in count over epsilon.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>

#include "anisomesh/errors.hh"
#include "anisomesh/flatten.hh"
#include "anisomesh/properties.hh"
#include "anisomesh/remesh.hh"
#include "numerics/tensor2d.hh"
#include "numerics/tensor3d.hh"
#include "surface_field.hh"

namespace anisomesh {

namespace {

/// Faces or vertices for each crossing that the density asks for: the median over the nine discs of the
/// benchmarks at 1,000 and 4,000 faces. Above 1 since spacings may change only slowly from place to place.
constexpr double kFirstRatio = 1.8;
constexpr double kMet = 0.1;  ///< a count within this fraction of the target meets it
/// A target buys most where lines leave wide gaps alone and samples go where the surface is farthest.
constexpr double kSeedFraction = 0.8, kCellTolerance = 4;
/// Where polygons cannot be made, those of an epsilon so much smaller often can, a few times.
constexpr double kNextAfterRefusal = 0.85;
constexpr int kMostRefusals = 4;
/// A count that falls by a smaller power of epsilon is not the density's any more: features, the border or
/// what the tolerances ask for need as many, and a larger epsilon only spoils what is there.
constexpr double kStalled = 0.2;
constexpr double kLowest = 1e-8, kHighest = 0.5;  ///< epsilon, fraction of the diagonal

/// The number of crossings that the density asks for: one for each rectangle of the two spacings.
class CrossingModel {
 public:
  CrossingModel(const SurfaceRef& surface, const DensityOptions& options)
      : options_(options), diagonal_(surface.diagonal()) {
    const auto& mesh = surface.connectivity();
    patches_.resize(mesh.n_vertices());
    if (is_flattened(surface))
      take_plane_tensors(mesh);
    else
      take_surface_tensors(mesh);
    double total = 0, bent = 0;
    for (const auto f : mesh.faces()) {
      const auto corners = surface.corners(f);
      const Vec3d &a = surface.point(corners.vertex[0]), &b = surface.point(corners.vertex[1]),
                  &c = surface.point(corners.vertex[2]);
      const double third = ((b - a) % (c - a)).norm() / 6;
      for (const auto v : corners.vertex) {
        auto& patch = patches_[static_cast<size_t>(v.idx())];
        patch.area += third;
        total += third;
        bent += third * std::max(std::abs(patch.k_min), std::abs(patch.k_max));
      }
    }
    mean_curvature_ = total > 0 ? bent / total : 0;
  }

  double count(double epsilon_fraction) const {
    DensityOptions options = options_;
    options.epsilon_fraction = epsilon_fraction;
    const Density density(options, diagonal_, mean_curvature_);
    double sum = 0;
    for (const Patch& patch : patches_)
      sum += patch.area / (density.min_line_spacing(patch.k_min, patch.k_max) *
                           density.max_line_spacing(patch.k_min, patch.k_max));
    return sum;
  }

  /// The epsilon that gives this count; the count falls as epsilon grows.
  double epsilon(double wanted) const {
    double low = std::log(kLowest), high = std::log(kHighest);
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      (count(std::exp(middle)) > wanted ? low : high) = middle;
    }
    return std::exp(0.5 * (low + high));
  }

 private:
  struct Patch {
    double area = 0, k_min = 0, k_max = 0;
  };

  void take_plane_tensors(const OpenMesh::TriConnectivity& mesh) {
    const auto tensor = require_property(mesh, property::tensor2d);
    for (const auto v : mesh.vertices()) {
      auto& patch = patches_[static_cast<size_t>(v.idx())];
      detail::eigenvalues(mesh.property(tensor, v), patch.k_min, patch.k_max);
    }
  }

  void take_surface_tensors(const OpenMesh::TriConnectivity& mesh) {
    const auto tensor = require_property(mesh, property::surface_tensor);
    const auto normal = require_property(mesh, property::normal);
    for (const auto v : mesh.vertices()) {
      auto& patch = patches_[static_cast<size_t>(v.idx())];
      const detail::TangentFrame frame(mesh.property(normal, v));
      detail::eigenvalues(detail::in_frame(mesh.property(tensor, v), frame), patch.k_min, patch.k_max);
    }
  }

  DensityOptions options_;
  double diagonal_;
  double mean_curvature_ = 0;
  std::vector<Patch> patches_;
};

struct Trial {
  double log_epsilon = 0;
  double log_ratio = 0;  ///< log of count over target
  double off() const { return std::abs(std::exp(log_ratio) - 1); }
};

/// Where to look next: the model scaled to the nearest attempt, or the secant through the two that enclose
/// the target, kept inside what is known.
double next_epsilon(const std::vector<Trial>& attempts, const CrossingModel& model) {
  const auto nearest = *std::min_element(attempts.begin(), attempts.end(), [](const auto& a, const auto& b) {
    return std::abs(a.log_ratio) < std::abs(b.log_ratio);
  });
  const Trial *above = nullptr, *below = nullptr;  // the tightest attempts with too many and too few
  for (const Trial& a : attempts) {
    if (a.log_ratio > 0 && (!above || a.log_epsilon > above->log_epsilon)) above = &a;
    if (a.log_ratio <= 0 && (!below || a.log_epsilon < below->log_epsilon)) below = &a;
  }
  if (above && below && above->log_epsilon < below->log_epsilon) {
    const double t = std::clamp(above->log_ratio / (above->log_ratio - below->log_ratio), 0.1, 0.9);
    return std::exp(above->log_epsilon + t * (below->log_epsilon - above->log_epsilon));
  }
  const double count_there = model.count(std::exp(nearest.log_epsilon));
  // Past the first attempts the model has shown to be wrong in the slope too: step further each time.
  const double push = 1 + 0.25 * static_cast<double>(attempts.size() - 1);
  return model.epsilon(count_there * std::exp(-push * nearest.log_ratio));
}

/// Whether the last step to a larger epsilon brought next to nothing, though there are still too many.
bool is_stalled(const std::vector<Trial>& attempts) {
  if (attempts.size() < 2) return false;
  const Trial &last = attempts.back(), &before = attempts[attempts.size() - 2];
  const double step = last.log_epsilon - before.log_epsilon;
  return last.log_ratio > 0 && step > 0 && before.log_ratio - last.log_ratio < kStalled * step;
}

}  // namespace

void TargetOptions::validate() const {
  if (target_faces > 0 && target_vertices > 0)
    throw InvalidOption("target_faces and target_vertices exclude each other: give one");
  if (!(tolerance > 0 && tolerance < 1))
    throw InvalidOption("tolerance must be above 0 and below 1, but is " + std::to_string(tolerance));
  if (max_attempts < 1)
    throw InvalidOption("max_attempts must be at least 1, but is " + std::to_string(max_attempts));
}

OpenMesh::PolyMesh trace_and_mesh(const SurfaceRef& surface, const TraceOptions& trace,
                                  const MeshOptions& mesh, const TargetOptions& target,
                                  TraceAndMeshReport* report, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  target.validate();
  trace.validate();
  mesh.validate();

  const double wanted = static_cast<double>(std::max(target.target_faces, target.target_vertices));
  TraceOptions options = trace;
  MeshOptions polygons = mesh;
  if (wanted > 0 && options.seed_fraction == 0)
    options.seed_fraction = std::max(options.stop_fraction, kSeedFraction);
  if (wanted > 0 && polygons.cell_tolerance == 0) polygons.cell_tolerance = kCellTolerance;
  TraceAndMeshReport done;
  const auto run = [&](double from, double to) {
    const double span = to - from;
    done.trace = trace_lines(surface, options, sub_progress(progress, from, from + 0.5 * span));
    done.isotropic = place_isotropic_samples(surface, options,
                                             sub_progress(progress, from + 0.5 * span, from + 0.6 * span));
    done.epsilon_fraction = options.density.epsilon_fraction;
    if (wanted > 0) {  // for a build_polygons() to come
      auto& connectivity = surface.connectivity();
      connectivity.property(provide_property(connectivity, property::cell_tolerance)) =
          polygons.cell_tolerance;
    }
    return build_polygons(surface, polygons, &done.mesh, sub_progress(progress, from + 0.6 * span, to));
  };
  const auto finish = [&](OpenMesh::PolyMesh&& result) {
    report_progress(progress, 1);  // the search may have ended early
    done.attempts_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (report) *report = done;
    return std::move(result);
  };
  if (wanted == 0) return finish(run(0, 1));

  const CrossingModel model(surface, trace.density);
  options.density.epsilon_fraction = model.epsilon(wanted / kFirstRatio);
  std::vector<Trial> attempts;
  OpenMesh::PolyMesh best;
  TraceAndMeshReport of_best;
  LineNetwork lines_of_best;
  double best_off = std::numeric_limits<double>::infinity();
  for (int i = 1, refusals = 0;; ++i) {
    OpenMesh::PolyMesh result;
    try {
      result = run(1 - std::pow(0.6, i - 1), 1 - std::pow(0.6, i));
    } catch (const CannotProcess&) {
      done.attempts = i;
      if (++refusals > kMostRefusals || i >= target.max_attempts) {
        if (std::isfinite(best_off)) break;
        throw;
      }
      options.density.epsilon_fraction *= kNextAfterRefusal;
      continue;
    }
    done.tried.push_back(
        {options.density.epsilon_fraction, target.target_faces > 0 ? result.n_faces() : result.n_vertices()});
    const double count = static_cast<double>(done.tried.back().count);
    attempts.push_back({std::log(options.density.epsilon_fraction), std::log(std::max(count, 0.5) / wanted)});
    const double off = attempts.back().off();
    done.attempts = i;
    done.target_met = off <= kMet;
    if (off <= target.tolerance || (i >= 3 && off <= kMet)) return finish(std::move(result));
    const bool stalled = is_stalled(attempts);
    if (off < best_off && !stalled) {
      best = std::move(result);
      best_off = off;
      of_best = done;
      lines_of_best = read_lines(surface);
    }
    const double next = next_epsilon(attempts, model);
    const bool stuck = std::abs(std::log(next) - attempts.back().log_epsilon) < 1e-3;
    if (i >= target.max_attempts || stuck || stalled || (i >= 3 && best_off <= kMet)) break;
    options.density.epsilon_fraction = next;
  }
  of_best.attempts = done.attempts;
  of_best.tried = done.tried;
  done = of_best;
  write_lines(surface, lines_of_best);
  const auto epsilon = provide_property(surface.connectivity(), property::epsilon);
  surface.connectivity().property(epsilon) = done.epsilon_fraction * surface.diagonal();
  return finish(std::move(best));
}

}  // namespace anisomesh
