#include "anisomesh/mesher.hh"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "anisomesh/errors.hh"
#include "anisomesh/properties.hh"
#include "mesher/grids.hh"
#include "mesher/joining.hh"
#include "mesher/more_care.hh"
#include "mesher/polygon_attempt.hh"
#include "mesher/polygon_output.hh"
#include "mesher/polygons.hh"
#include "mesher/slit_seams.hh"
#include "mesher/soundness.hh"
#include "mesher/upright_quads.hh"
#include "network/drawing.hh"
#include "prepare/feature_tolerance.hh"
#include "surface/canonical_copy.hh"
#include "surface/recorded.hh"

namespace anisomesh {

namespace {

using detail::NetworkGraph;
size_t at(int i) { return static_cast<size_t>(i); }

class Stopwatch {
 public:
  /// Seconds since the last call.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// What MeshOptions::for_fit multiplies.
constexpr double fitted_chains = 1.5, fitted_cells = 2, fitted_alignment = 4;

/// Leaves no option of those that epsilon is the unit of to be found elsewhere.
MeshOptions resolved(MeshOptions options, const OpenMesh::TriConnectivity& mesh) {
  if (options.cell_tolerance == 0)
    options.cell_tolerance = detail::recorded(mesh, property::cell_tolerance, 2.0);
  if (options.for_fit) {
    options.chain_tolerance *= fitted_chains;
    options.cell_tolerance *= fitted_cells;
    options.alignment_weight *= fitted_alignment;
    options.for_fit = false;
  }
  return options;
}

/// How nearly features are followed, model units.
double feature_tolerance_of(const SurfaceRef& surface, const MeshOptions& options) {
  if (options.feature_tolerance > 0) return options.feature_tolerance * surface.diagonal();
  return surface.extent() * detail::recorded(surface.connectivity(), property::feature_tolerance,
                                             detail::asked_feature_tolerance);
}

// Polygons that would be folded, concave or without area are given other chances with more samples around
// them.
constexpr size_t max_retries = 8;
constexpr size_t max_phases = 6;  // of so many retries, each with more of the input's triangles kept
// Times the tolerance of features: how far cells beside them may be from the surface, where epsilon grows
// since features alone are more than what is wanted, and what the judge takes for as far.
constexpr double cells_at_features = 10, judged_at_features = 5;
constexpr double tiny = 0.05;            // of epsilon: no edge need be as short
constexpr double widest_merge = 0.0125;  // of the extent: chains that only bend within a share of infinity

[[noreturn]] void refuse(const std::vector<int>& polygon, const NetworkGraph& network, size_t count,
                         const SurfaceRef& surface) {
  Vec3d middle(0, 0, 0);
  for (const int n : polygon) middle += network.positions[at(n)] / static_cast<double>(polygon.size());
  middle = detail::given_place(surface, middle);
  throw CannotProcess(std::to_string(count) + " polygons would be folded or degenerate, one of them near (" +
                      std::to_string(middle[0]) + ", " + std::to_string(middle[1]) + ", " +
                      std::to_string(middle[2]) + "); smooth the input there or try a smaller epsilon");
}

void count_polygons(const std::vector<std::vector<int>>& polygons, MeshReport& report) {
  std::vector<int> nodes;
  for (const auto& polygon : polygons) nodes.insert(nodes.end(), polygon.begin(), polygon.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  report.vertices = nodes.size();
  report.faces = polygons.size();
  report.triangles = report.quads = 0;
  for (const auto& polygon : polygons) {
    report.triangles += polygon.size() == 3;
    report.quads += polygon.size() == 4;
  }
}

}  // namespace

void MeshOptions::validate() const {
  if (max_degree != 0 && max_degree < 3)
    throw InvalidOption("max_degree is " + std::to_string(max_degree) +
                        "; it must be 0 (no bound) or at least 3");
  if (!(corner_angle_degrees >= 0 && corner_angle_degrees <= 180))
    throw InvalidOption("corner_angle_degrees must be between 0 and 180");
  if (!(chain_tolerance >= 0)) throw InvalidOption("chain_tolerance must not be negative");
  if (!(cell_tolerance >= 0)) throw InvalidOption("cell_tolerance must not be negative");
  if (!(alignment_weight >= 0)) throw InvalidOption("alignment_weight must not be negative");
  if (!(feature_tolerance >= 0)) throw InvalidOption("feature_tolerance must not be negative");
  if (!(merge_fraction >= 0 && merge_fraction < 1)) throw InvalidOption("merge_fraction must be in [0, 1)");
  if (!(max_bend_degrees > 0 && max_bend_degrees <= 180))
    throw InvalidOption("max_bend_degrees must be above 0 and at most 180");
}

OpenMesh::PolyMesh build_polygons(const SurfaceRef& surface, const MeshOptions& options, MeshReport* report,
                                  const Progress& progress) {
  if (!surface.canonical_copy())
    return detail::make_in_canonical_order(surface, [&](const SurfaceRef& ordered) {
      return build_polygons(ordered, options, report, progress);
    });
  MeshReport local;
  MeshReport& done = report ? *report : local;
  OpenMesh::PolyMesh result = detail::attempt_polygons(
                                  surface, options, [](const MeshReport&) { return true; }, &done, progress)
                                  .mesh;
  const auto wanted = [&](const auto& declaration) {
    return static_cast<size_t>(detail::recorded(surface.connectivity(), declaration, 0));
  };
  detail::divide_into_grids(surface, options, wanted(property::target_faces),
                            wanted(property::target_vertices), result, done);
  return result;
}

double detail::chain_tolerance_of(const MeshOptions& options, double epsilon) {
  return options.chain_tolerance * (options.for_fit ? fitted_chains : 1) * epsilon;
}

detail::PolygonAttempt detail::attempt_polygons(const SurfaceRef& surface, const MeshOptions& given,
                                                const IsWanted& is_wanted, MeshReport* report,
                                                const Progress& progress) {
  given.validate();
  const MeshOptions options = resolved(given, surface.connectivity());
  MeshReport local;
  Stopwatch total, stopwatch;
  report_progress(progress, 0);
  const LineNetwork lines = read_lines(surface);
  const double epsilon =
      detail::recorded(surface.connectivity(), property::epsilon, std::numeric_limits<double>::infinity());

  const detail::SurfaceNormals normals(surface);
  double reached = 0;  // said again and again, so that it can be cancelled
  const auto drawing =
      detail::make_drawing(surface, normals, lines, options.corner_angle_degrees,
                           options.cell_tolerance * epsilon, [&] { report_progress(progress, reached); });
  local.crossings = drawing->network().crossings;
  local.arrangement_seconds = stopwatch.lap();
  report_progress(progress, reached = 0.4);

  const double chain_tolerance = options.chain_tolerance * epsilon,
               feature_tolerance = feature_tolerance_of(surface, options);
  const detail::DecimationOptions decimation{
      chain_tolerance, std::min(chain_tolerance, widest_merge * surface.extent()), feature_tolerance,
      options.merge_fraction, std::isfinite(epsilon) ? tiny * epsilon : 0};
  const detail::RegionOptions region_options{{options.max_degree, options.convex},
                                             options.cell_tolerance * epsilon,
                                             options.flip_edges,
                                             cells_at_features * feature_tolerance};
  // On the surface nothing but the judge keeps a cell from being bridged, so that a large epsilon, as where
  // the features alone are more than the faces that are wanted, must not make that cheap.
  const bool planar = drawing->network().planar;
  const double judged = planar ? epsilon : std::min(epsilon, judged_at_features * feature_tolerance);
  const detail::PolygonJudge judge(
      surface, drawing->locator(), normals,
      {judged, planar ? 10.0 : 100.0, options.max_bend_degrees, options.alignment_weight});
  const detail::SlitSeams seams(surface);
  NetworkGraph network, start = drawing->network();
  std::vector<std::vector<int>> polygons;
  std::optional<detail::ReferenceSurface> reference;
  std::vector<char> kept_faces;
  size_t phase = 1, retries = 0;  // in this phase
  while (true) {
    network = start;
    detail::DecimationReport decimated;
    auto cells = drawing->cells(network, decimation, std::isfinite(region_options.cell_tolerance), decimated);
    local.trimmed = decimated.trimmed;
    local.straightened = decimated.straightened;
    local.merged = decimated.merged;
    local.decimation_seconds += stopwatch.lap();
    report_progress(progress, 0.6);

    auto set = detail::extract_polygons(network, std::move(cells), surface, normals, judge, region_options);
    if (options.max_degree == 4) detail::pair_triangles(set.polygons, network, judge, options.join_lines);
    if (options.max_degree > 0) detail::split_upright_quads(set.polygons, network);
    local.added_samples = set.added_samples;
    local.dropped_samples = set.dropped_samples;
    local.convexity_splits = set.convexity_splits;
    local.conforming_edges = set.conforming_edges;
    polygons = std::move(set.polygons);
    seams.zip(polygons, network, normals, judge, region_options.partition);
    detail::Soundness soundness(surface, drawing->locator(), judge, options.convex);
    soundness.require_topology(polygons);
    auto unsound = soundness.repair(polygons, network, options.max_degree, retries >= detail::patience);
    local.polygon_seconds += stopwatch.lap();
    report_progress(progress, 0.8);
    if (unsound.empty() && retries < detail::patience) unsound = soundness.coincident(polygons, network);
    // What is to be fitted is judged so when it has been.
    if (unsound.empty() && !given.for_fit && retries < detail::patience) {
      if (!reference) reference.emplace(surface);
      unsound = soundness.folded(polygons, network, *reference);
    }
    if (unsound.empty()) break;
    count_polygons(polygons, local);
    if (!is_wanted(local)) {
      local.seconds = total.lap();
      if (report) *report = local;
      return {};
    }
    ++local.retries;
    if (report) *report = local;  // for those who hear of no more than a refusal
    if (++retries <= max_retries) {
      detail::take_more_care(unsound, network, retries, start);
      continue;
    }
    if (phase++ == max_phases ||
        !detail::keep_triangles_at(unsound, network, surface, drawing->locator(), kept_faces) ||
        !drawing->keep_faces(kept_faces))
      refuse(unsound.front(), network, unsound.size(), surface);
    start = drawing->network();
    retries = 0;
  }
  PolygonAttempt done{detail::make_mesh(network, polygons), true};
  local.polygon_seconds += stopwatch.lap();
  report_progress(progress, 1);

  count_polygons(polygons, local);
  local.seconds = total.lap();
  if (report) *report = local;
  return done;
}

}  // namespace anisomesh
