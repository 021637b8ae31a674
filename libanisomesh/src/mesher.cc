#include "anisomesh/mesher.hh"

#include <chrono>
#include <cmath>
#include <limits>
#include <string>

#include "anisomesh/errors.hh"
#include "anisomesh/properties.hh"
#include "decimation.hh"
#include "joining.hh"
#include "network_graph.hh"
#include "polygon_output.hh"
#include "polygons.hh"
#include "soundness.hh"

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

double epsilon_of(const OpenMesh::TriConnectivity& mesh) {
  if (!has_property(mesh, property::epsilon)) return std::numeric_limits<double>::infinity();
  return mesh.property(require_property(mesh, property::epsilon));
}

// Polygons that would be folded, concave or without area are given another chance with more samples.
constexpr size_t max_retries = 4;

// A tolerance, or a share of it; of one that is infinite, a share of a small fraction of the diagonal.
double limited(double tolerance, double share, const SurfaceRef& surface) {
  if (share == 1) return tolerance;
  return share * (std::isfinite(tolerance) ? tolerance : 0.01 * surface.diagonal());
}

[[noreturn]] void refuse(const std::vector<int>& polygon, const NetworkGraph& network, size_t count) {
  Vec3d middle(0, 0, 0);
  for (const int n : polygon) middle += network.positions[at(n)] / static_cast<double>(polygon.size());
  throw CannotProcess(std::to_string(count) + " polygons would be folded or degenerate, one of them near (" +
                      std::to_string(middle[0]) + ", " + std::to_string(middle[1]) + ", " +
                      std::to_string(middle[2]) + "); smooth the input there or try a smaller epsilon");
}

void count_faces(const OpenMesh::PolyMesh& mesh, MeshReport& report) {
  report.vertices = mesh.n_vertices();
  report.faces = mesh.n_faces();
  for (const auto f : mesh.faces()) {
    const auto degree = mesh.valence(f);
    report.triangles += degree == 3;
    report.quads += degree == 4;
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
  if (!(cell_tolerance > 0)) throw InvalidOption("cell_tolerance must be above 0");
  if (!(merge_fraction >= 0 && merge_fraction < 1)) throw InvalidOption("merge_fraction must be in [0, 1)");
  if (!(max_bend_degrees > 0 && max_bend_degrees <= 180))
    throw InvalidOption("max_bend_degrees must be above 0 and at most 180");
}

OpenMesh::PolyMesh build_polygons(const SurfaceRef& surface, const MeshOptions& options, MeshReport* report,
                                  const Progress& progress) {
  options.validate();
  MeshReport local;
  Stopwatch total, stopwatch;
  report_progress(progress, 0);
  const LineNetwork lines = read_lines(surface);
  const detail::UvLocator locator(surface);
  const double epsilon = epsilon_of(surface.connectivity());

  const detail::SurfaceNormals normals(surface);
  const NetworkGraph arranged =
      detail::arrange_network(surface, locator, normals, lines, options.corner_angle_degrees);
  local.crossings = arranged.crossings;
  local.arrangement_seconds = stopwatch.lap();
  report_progress(progress, 0.4);

  NetworkGraph network;
  std::vector<std::vector<int>> polygons;
  for (double share = 1;; share /= 2) {
    network = arranged;
    const auto decimated = detail::decimate(
        network, {limited(options.chain_tolerance * epsilon, share, surface), options.merge_fraction});
    local.trimmed = decimated.trimmed;
    local.straightened = decimated.straightened;
    local.merged = decimated.merged;
    local.decimation_seconds += stopwatch.lap();
    report_progress(progress, 0.6);

    const detail::PolygonJudge judge(surface, locator, normals, {epsilon, options.max_bend_degrees});
    auto set = detail::extract_polygons(network, surface, locator, normals, judge,
                                        {{options.max_degree, options.convex},
                                         limited(options.cell_tolerance * epsilon, share, surface),
                                         options.flip_edges});
    if (options.max_degree == 4) detail::pair_triangles(set.polygons, network, judge, options.join_lines);
    local.added_samples = set.added_samples;
    local.dropped_samples = set.dropped_samples;
    local.convexity_splits = set.convexity_splits;
    local.conforming_edges = set.conforming_edges;
    polygons = std::move(set.polygons);
    const detail::Soundness soundness(surface, locator, judge, options.convex);
    soundness.require_topology(polygons);
    const auto unsound = soundness.repair(polygons, network, options.max_degree);
    local.polygon_seconds += stopwatch.lap();
    report_progress(progress, 0.8);
    if (unsound.empty()) break;
    ++local.retries;
    if (local.retries > max_retries) refuse(unsound.front(), network, unsound.size());
  }
  OpenMesh::PolyMesh mesh = detail::make_mesh(network, polygons);
  local.polygon_seconds += stopwatch.lap();
  report_progress(progress, 1);

  count_faces(mesh, local);
  local.seconds = total.lap();
  if (report) *report = local;
  return mesh;
}

}  // namespace anisomesh
