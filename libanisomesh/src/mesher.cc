#include "anisomesh/mesher.hh"

#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <map>
#include <string>

#include "anisomesh/errors.hh"
#include "anisomesh/properties.hh"
#include "decimation.hh"
#include "joining.hh"
#include "mesh_embedding.hh"
#include "near_locator.hh"
#include "plane_cells.hh"
#include "plane_embedding.hh"
#include "polygon_output.hh"
#include "polygons.hh"
#include "soundness.hh"
#include "surface_cells.hh"
#include "surface_network.hh"

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

// Polygons that would be folded, concave or without area are given other chances with more samples around
// them.
constexpr size_t max_retries = 8;
constexpr double around = 1.5;  // diameters of such a polygon

// Halves the share of the tolerances that holds near some polygons.
void take_more_care(const std::vector<std::vector<int>>& polygons, const NetworkGraph& network,
                    NetworkGraph& start) {
  if (start.share.empty()) start.share.assign(start.positions.size(), 1);
  std::vector<char> near(start.share.size(), 0);
  for (const auto& polygon : polygons) {
    Vec3d middle(0, 0, 0);
    for (const int n : polygon) middle += network.positions[at(n)] / static_cast<double>(polygon.size());
    double radius = 0;
    for (const int n : polygon)
      radius = std::max(radius, 2 * around * (network.positions[at(n)] - middle).norm());
    for (size_t n = 0; n < near.size(); ++n)
      near[n] |= (start.positions[n] - middle).norm() <= radius;
  }
  for (size_t n = 0; n < near.size(); ++n)
    if (near[n]) start.share[n] /= 2;
}

[[noreturn]] void refuse(const std::vector<int>& polygon, const NetworkGraph& network, size_t count) {
  Vec3d middle(0, 0, 0);
  for (const int n : polygon) middle += network.positions[at(n)] / static_cast<double>(polygon.size());
  throw CannotProcess(std::to_string(count) + " polygons would be folded or degenerate, one of them near (" +
                      std::to_string(middle[0]) + ", " + std::to_string(middle[1]) + ", " +
                      std::to_string(middle[2]) + "); smooth the input there or try a smaller epsilon");
}

// The network as it was drawn, before anything is taken away, and how to get from it to cells: in the
// parameter plane or on the surface itself.
class Drawing {
 public:
  virtual ~Drawing() = default;
  virtual const detail::SurfaceLocator& locator() const = 0;
  virtual const NetworkGraph& network() const = 0;
  /// Decimates a copy of the network. \return its cells
  virtual std::vector<detail::Cell> cells(NetworkGraph& network, const detail::DecimationOptions& options,
                                          bool probes, detail::DecimationReport& report) const = 0;
};

class PlaneDrawing final : public Drawing {
 public:
  PlaneDrawing(const SurfaceRef& surface, const detail::SurfaceNormals& normals, const LineNetwork& lines,
               double corner_angle)
      : surface_(surface),
        locator_(surface),
        network_(detail::arrange_network(surface, locator_, normals, lines, corner_angle)) {}
  const detail::SurfaceLocator& locator() const override { return locator_; }
  const NetworkGraph& network() const override { return network_; }
  std::vector<detail::Cell> cells(NetworkGraph& network, const detail::DecimationOptions& options, bool probes,
                                  detail::DecimationReport& report) const override {
    detail::PlaneEmbedding embedding(network);
    report = detail::decimate(network, embedding, options);
    if (getenv("DBG")) {
      size_t used = 0, pass = 0, iso = 0;
      for (int n = 0; n < (int)network.graph.n_nodes(); ++n) {
        const int d = network.graph.degree(n);
        if (d > 0) ++used;
        if (d == 0 && network.fixed[at(n)]) ++iso;
        if (d == 2 && !network.fixed[at(n)]) ++pass;
      }
      fprintf(stderr, "P: %zu vertices, %zu iso, %zu pass-through; trimmed %zu straightened %zu merged %zu\n", used+iso, iso,  pass, report.trimmed, report.straightened, report.merged);
    }
    return detail::plane_cells(network, surface_, locator_, probes);
  }

 private:
  const SurfaceRef& surface_;
  detail::UvLocator locator_;
  NetworkGraph network_;
};

class SurfaceDrawing final : public Drawing {
 public:
  SurfaceDrawing(const SurfaceRef& surface, const detail::SurfaceNormals& normals, const LineNetwork& lines,
                 double corner_angle)
      : surface_(surface), locator_(surface) {
    const detail::Overlay overlay = detail::overlay_lines(surface, lines, corner_angle);
    network_ = detail::network_of(surface, normals, overlay);
    embedding_ = std::make_unique<detail::MeshEmbedding>(surface, overlay, network_);
    embedding_->coarsen(network_);
  }
  const detail::SurfaceLocator& locator() const override { return locator_; }
  const NetworkGraph& network() const override { return network_; }
  std::vector<detail::Cell> cells(NetworkGraph& network, const detail::DecimationOptions& options, bool probes,
                                  detail::DecimationReport& report) const override {
    detail::MeshEmbedding embedding = *embedding_;
    report = detail::decimate(network, embedding, options);
    embedding.coarsen(network);
    embedding.flip(network);
    if (getenv("DBG")) {
      size_t used = 0, pass = 0, stuck = 0, iso = 0;
      std::vector<char> in(network.graph.n_nodes(), 0);
      for (const auto& t : embedding.triangles()) for (int n : t.node) in[at(n)] = 1;
      for (int n = 0; n < (int)in.size(); ++n) {
        if (!in[at(n)]) continue;
        ++used;
        const int d = network.graph.degree(n);
        if (d == 0) { if (network.fixed[at(n)]) ++iso; else ++stuck; }
        if (d == 2 && !network.fixed[at(n)]) ++pass;
      }
      fprintf(stderr, "T: %zu vertices, %zu iso, %zu stuck, %zu pass-through; trimmed %zu straightened %zu merged %zu\n", used, iso, stuck, pass, report.trimmed, report.straightened, report.merged);
    }
    return detail::surface_cells(network, surface_, embedding, probes);
  }

 private:
  const SurfaceRef& surface_;
  detail::NearLocator locator_;
  NetworkGraph network_;
  std::unique_ptr<detail::MeshEmbedding> embedding_;
};

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
  const double epsilon = epsilon_of(surface.connectivity());

  const detail::SurfaceNormals normals(surface);
  std::unique_ptr<Drawing> drawing;
  if (has_property(surface.connectivity(), property::uv))
    drawing = std::make_unique<PlaneDrawing>(surface, normals, lines, options.corner_angle_degrees);
  else
    drawing = std::make_unique<SurfaceDrawing>(surface, normals, lines, options.corner_angle_degrees);
  local.crossings = drawing->network().crossings;
  local.arrangement_seconds = stopwatch.lap();
  report_progress(progress, 0.4);

  NetworkGraph network;
  std::vector<std::vector<int>> polygons;
  NetworkGraph start = drawing->network();
  while (true) {
    network = start;
    const double chain_tolerance = options.chain_tolerance * epsilon;
    const detail::RegionOptions region_options{{options.max_degree, options.convex},
                                               options.cell_tolerance * epsilon,
                                               options.flip_edges};
    detail::DecimationReport decimated;
    auto cells = drawing->cells(
        network, {chain_tolerance, std::min(chain_tolerance, 0.01 * surface.diagonal()), options.merge_fraction},
        std::isfinite(region_options.cell_tolerance), decimated);
    local.trimmed = decimated.trimmed;
    local.straightened = decimated.straightened;
    local.merged = decimated.merged;
    local.decimation_seconds += stopwatch.lap();
    report_progress(progress, 0.6);

    const detail::PolygonJudge judge(surface, drawing->locator(), normals,
                                     {epsilon, options.max_bend_degrees});
    auto set =
        detail::extract_polygons(network, std::move(cells), surface, normals, judge, region_options);
    const auto dbg = [&](const char* when) {
      if (!getenv("DBG")) return;
      std::map<std::pair<int,int>, std::vector<size_t>> sides;
      for (size_t p = 0; p < set.polygons.size(); ++p)
        for (size_t i = 0; i < set.polygons[p].size(); ++i) sides[{set.polygons[p][i], set.polygons[p][(i + 1) % set.polygons[p].size()]}].push_back(p);
      for (auto& [e, ps] : sides) if (ps.size() > 1) {
        fprintf(stderr, "%s: side %d %d twice, edge %d deg %d %d\n", when, e.first, e.second, network.graph.find_edge(e.first, e.second), network.graph.degree(e.first), network.graph.degree(e.second));
        for (size_t p : ps) { fprintf(stderr, "   "); for (int n : set.polygons[p]) fprintf(stderr, " %d", n); fprintf(stderr, "\n"); }
      }
      std::map<int,int> faces, edges;
      for (auto& p : set.polygons) for (int n : p) faces[n]++;
      for (auto& [e, ps] : sides) { if (sides.count({e.second, e.first}) && e.first > e.second) continue; edges[e.first]++; edges[e.second]++; }
      for (auto& [n, f] : faces) if (edges[n] != f && edges[n] != f + 1) fprintf(stderr, "%s: node %d faces %d edges %d\n", when, n, f, edges[n]);
    };
    dbg("extract");
    if (options.max_degree == 4) detail::pair_triangles(set.polygons, network, judge, options.join_lines);
    dbg("pair");
    local.added_samples = set.added_samples;
    local.dropped_samples = set.dropped_samples;
    local.convexity_splits = set.convexity_splits;
    local.conforming_edges = set.conforming_edges;
    polygons = std::move(set.polygons);
    const detail::Soundness soundness(surface, drawing->locator(), judge, options.convex);
    soundness.require_topology(polygons);
    const auto unsound = soundness.repair(polygons, network, options.max_degree);
    local.polygon_seconds += stopwatch.lap();
    report_progress(progress, 0.8);
    if (unsound.empty()) break;
    if (getenv("DBG")) { fprintf(stderr, "unsound %zu\n", unsound.size()); for (auto& p : unsound) { fprintf(stderr, " degree %zu at %g %g %g :", p.size(), network.positions[at(p[0])][0], network.positions[at(p[0])][1], network.positions[at(p[0])][2]); for (int n : p) fprintf(stderr, " %d/d%d/o%d", n, network.graph.degree(n), (int)network.origins[at(n)]); fprintf(stderr, "\n"); } }
    ++local.retries;
    if (local.retries > max_retries) refuse(unsound.front(), network, unsound.size());
    take_more_care(unsound, network, start);
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
