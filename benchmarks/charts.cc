// Charts against the surface: the same meshes remeshed in both domains, and what can be seen of the seams.
//
//   ANISOMESH_DATA=FOLDER charts [--target FACES] [--feature-angle DEGREES] [--no-fit] [--seams [--repeats
//   N]]
//          [NAME...]
//
// Without --seams a markdown table with a row for each mesh and domain, then the geometric means of charts
// over surface; memory and processor time are those of a process that does this run alone, and "broken"
// counts what is folded, concave, degenerate, non-manifold or a T-junction where the input has none of the
// kind, and 1 for another topology. With
// --seams a table of the results inside a band of two edges along the seams and elsewhere: quads, alignment
// and error (root of the mean squared face_error, % of the diagonal). Since seams keep to creases the surface
// is another there; the same band of the result that was made on the surface, where seams never were, says
// how much of the difference that is. Figures are means over the result for the target and N - 1 more, for
// epsilons up to some percent smaller and larger, since those of one result go up and down by as much.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "anisomesh/charts.hh"
#include "anisomesh/properties.hh"
#include "anisomesh/remesh.hh"
#include "arguments.hh"
#include "bench.hh"

using namespace anisomesh;

namespace {

struct Settings {
  size_t target = 4000, repeats = 1;
  FeatureOptions features;
  bool seams = false, unfitted = false;
};

const std::vector<std::string>& ten_meshes() {
  static const std::vector<std::string> names = {"pig.stl",     "hand.off",  "bunny00.off", "camel.off",
                                                 "cow.off",     "homer.off", "bull.off",    "elephant.off",
                                                 "fandisk.off", "knot1.off"};
  return names;
}

// Logarithms of ratios; printed as their geometric mean, with the standard error where there are several.
class Ratios {
 public:
  void add(double a, double b) {
    if (a > 0 && b > 0) logs_.push_back(std::log(a / b));
  }
  size_t count() const { return logs_.size(); }
  double mean_log() const {
    return std::accumulate(logs_.begin(), logs_.end(), 0.0) /
           static_cast<double>(std::max<size_t>(1, count()));
  }
  double mean() const { return std::exp(mean_log()); }
  std::string text() const {
    if (count() < 2) return bench::format("%.3f", mean());
    double sum = 0;
    for (const double l : logs_) sum += (l - mean_log()) * (l - mean_log());
    const double n = static_cast<double>(count());
    return bench::format("%.3f", mean()) + bench::format(" +- %.3f", mean() * std::sqrt(sum / (n - 1) / n));
  }

 private:
  std::vector<double> logs_;
};

struct Figures {
  size_t faces = 0;
  double quads = 0, alignment = 0, error = 0;
};

double face_area(const OpenMesh::PolyMesh& mesh, OpenMesh::FaceHandle face) {
  const auto first = mesh.point(mesh.to_vertex_handle(mesh.halfedge_handle(face)));
  Vec3d twice(0, 0, 0);
  for (const auto h : mesh.fh_range(face))
    twice += (mesh.point(h.from()) - first) % (mesh.point(h.to()) - first);
  return 0.5 * twice.norm();
}

// Of some of the faces of a result that compare() has written face_error on.
Figures figures(OpenMesh::TriMesh& reference, const OpenMesh::PolyMesh& result,
                const std::vector<char>& wanted) {
  const auto face_error = require_property(result, property::face_error);
  OpenMesh::PolyMesh part;
  for (const auto v : result.vertices()) part.add_vertex(result.point(v));
  double squares = 0, area = 0;
  for (const auto f : result.faces()) {
    if (!wanted[static_cast<size_t>(f.idx())]) continue;
    std::vector<OpenMesh::VertexHandle> corners;
    for (const auto v : f.vertices()) corners.push_back(v);
    const auto made = part.add_face(corners);
    const double size = face_area(part, made), error = result.property(face_error, f);
    squares += size * error * error;
    area += size;
  }
  CompareOptions options;
  options.samples = 20000;
  const auto c = compare(reference, part, options);
  return {c.faces, c.quad_fraction, c.mean_alignment_degrees,
          std::sqrt(squares / area) / SurfaceRef(reference).diagonal()};
}

// Faces with a corner at most one edge away from what is nearest to a seam.
std::vector<char> band(const std::vector<Vec3d>& seam_points, const OpenMesh::PolyMesh& result) {
  std::vector<char> near(result.n_vertices(), 0);
  for (const Vec3d& p : seam_points) {
    int best = 0;
    double least = 1e300;
    for (const auto v : result.vertices()) {
      const double d = (result.point(v) - p).sqrnorm();
      if (d < least) least = d, best = v.idx();
    }
    near[static_cast<size_t>(best)] = 1;
  }
  std::vector<char> wide = near;
  for (const auto v : result.vertices())
    if (near[static_cast<size_t>(v.idx())])
      for (const auto w : result.vv_range(v)) wide[static_cast<size_t>(w.idx())] = 1;
  std::vector<char> faces(result.n_faces(), 0);
  for (const auto f : result.faces())
    for (const auto v : f.vertices())
      if (wide[static_cast<size_t>(v.idx())]) faces[static_cast<size_t>(f.idx())] = 1;
  return faces;
}

std::vector<Vec3d> seam_points(OpenMesh::TriMesh& mesh) {
  const SurfaceRef surface = mesh;
  std::vector<char> on(mesh.n_vertices(), 0);
  for (const auto e : mesh.edges())
    if (!mesh.status(e).feature() && is_seam(surface, e))
      for (const auto v : {e.v0(), e.v1()}) on[static_cast<size_t>(v.idx())] = 1;
  std::vector<Vec3d> points;
  for (const auto v : mesh.vertices())
    if (on[static_cast<size_t>(v.idx())]) points.push_back(mesh.point(v));
  return points;
}

RemeshOptions options_for(const OpenMesh::TriMesh& mesh, Domain domain, const Settings& settings) {
  RemeshOptions options;
  options.fit.enabled = !settings.unfitted;
  options.domain = domain;
  options.features = settings.features;
  options.target_faces = std::min(settings.target, mesh.n_faces() / 2);
  return options;
}

// What a run tells the process that started it.
struct Run {
  char done = 0;
  double error = 0, hausdorff = 0, quads = 0, alignment = 0, vertices = 0, wall = 0, processor = 0,
         memory = 0;
};

double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

// What is wrong with a result and not with its input.
size_t broken(const Comparison& c, const Comparison& input) {
  const std::pair<size_t, size_t> kinds[] = {
      {c.folded_faces, input.folded_faces},
      {c.concave_faces, input.concave_faces},
      {c.degenerate_faces, input.degenerate_faces},
      {c.non_manifold_edges, input.non_manifold_edges},
      {c.non_manifold_vertices, input.non_manifold_vertices},
      {c.t_junctions, input.t_junctions + input.non_manifold_vertices}};
  size_t sum = c.same_topology ? 0 : 1;
  for (const auto& [found, given] : kinds) sum += given > 0 ? 0 : found;
  return sum;
}

Run run_in(Domain domain, const std::string& name, const std::string& path, const Settings& settings) {
  auto mesh = read_surface(path);
  RemeshReport report;
  auto result = remesh(mesh, options_for(mesh, domain, settings), &report);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  bench::Ruler ruler(mesh);
  const auto c = ruler(result);
  OpenMesh::PolyMesh same;
  same.assign(ruler.reference, true);
  const auto input = ruler(same);
  const bool charts = domain == Domain::charts;
  const Run run{1,
                c.two_sided.rms,
                c.two_sided.hausdorff,
                c.quad_fraction,
                c.mean_alignment_degrees,
                static_cast<double>(c.vertices),
                report.seconds,
                seconds(usage.ru_utime) + seconds(usage.ru_stime),
                static_cast<double>(usage.ru_maxrss) / 1024};
  std::printf(
      "| %s | %s | %s | %zu + %zu | %zu | %zu%s | %zu | %.1f | %.4f | %.3f | %.2f | %.2f | %.2f | %.0f |\n",
      name.c_str(), charts ? "charts" : "surface",
      charts ? std::to_string(report.domain.charts.charts).c_str() : "", report.umbilics.wedges,
      report.umbilics.trisectors, c.vertices, c.faces, report.target_met ? "" : " (missed)", broken(c, input),
      100 * c.quad_fraction, 100 * c.two_sided.rms, 100 * c.two_sided.hausdorff, c.mean_alignment_degrees,
      run.wall, run.processor, run.memory);
  return run;
}

Run run_apart(Domain domain, const std::string& name, const std::string& path, const Settings& settings) {
  std::fflush(stdout);
  int ends[2];
  if (pipe(ends) != 0) return {};
  const pid_t child = fork();
  if (child == 0) {
    Run run;
    try {
      run = run_in(domain, name, path, settings);
    } catch (const std::exception& e) {
      std::printf("| %s | refused: %s |\n", name.c_str(), e.what());
    }
    std::fflush(stdout);
    const bool sent = write(ends[1], &run, sizeof run) == static_cast<ssize_t>(sizeof run);
    _exit(run.done && sent ? 0 : 1);
  }
  close(ends[1]);
  Run run;
  if (read(ends[0], &run, sizeof run) != static_cast<ssize_t>(sizeof run)) run = {};
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return run;
}

// Charts over surface, and how often charts have the smaller error and the more quads.
struct Tally {
  Ratios error, hausdorff, alignment, wall, processor, memory;
  double quads = 0;  // sum of differences, points
  int smaller_error = 0, more_quads = 0, better_aligned = 0;

  void add(const Run& charts, const Run& surface) {
    if (!charts.done || !surface.done) return;
    const double c = charts.error * charts.vertices, s = surface.error * surface.vertices;
    error.add(c, s);
    hausdorff.add(charts.hausdorff, surface.hausdorff);
    alignment.add(charts.alignment, surface.alignment);
    wall.add(charts.wall, surface.wall);
    processor.add(charts.processor, surface.processor);
    memory.add(charts.memory, surface.memory);
    quads += 100 * (charts.quads - surface.quads);
    smaller_error += c < s;
    more_quads += charts.quads > surface.quads;
    better_aligned += charts.alignment < surface.alignment;
  }
  void print() const {
    std::printf(
        "\nCharts over surface, geometric means of %zu with their standard errors: error times vertices %s, "
        "Hausdorff %s, alignment %s, seconds %s, processor %s, memory %s; quads %+.1f points. Charts have "
        "the "
        "smaller error on %d, more quads on %d, the better alignment on %d.\n",
        error.count(), error.text().c_str(), hausdorff.text().c_str(), alignment.text().c_str(),
        wall.text().c_str(), processor.text().c_str(), memory.text().c_str(),
        quads / static_cast<double>(error.count()), smaller_error, more_quads, better_aligned);
  }
};

void compare_domains(const std::string& name, const std::string& path, const Settings& settings,
                     Tally& tally) {
  const Run charts = run_apart(Domain::charts, name, path, settings);
  tally.add(charts, run_apart(Domain::surface, name, path, settings));
}

// Sums over the results of one mesh and domain: what is inside the band, and what is elsewhere.
struct Sides {
  Figures in, out;
};

Figures mean(const std::vector<Sides>& all, Figures Sides::*side) {
  Figures sum;
  for (const Sides& one : all) {
    const Figures& f = one.*side;
    sum.faces += f.faces;
    sum.quads += f.quads;
    sum.alignment += f.alignment;
    sum.error += f.error * f.error;
  }
  const double n = static_cast<double>(all.size());
  return {sum.faces / all.size(), sum.quads / n, sum.alignment / n, std::sqrt(sum.error / n)};
}

// The result for the target, and some for epsilons a little smaller and larger, one after the other.
std::vector<Sides> sides_of(OpenMesh::TriMesh& mesh, Domain domain, const Settings& settings,
                            bench::Ruler& ruler, std::vector<Vec3d>& seams) {
  RemeshOptions options = options_for(mesh, domain, settings);
  std::vector<Sides> sides;
  double epsilon = 0;
  for (size_t k = 0; k < settings.repeats; ++k) {
    RemeshReport report;
    auto result = remesh(mesh, options, &report);
    if (domain == Domain::charts && k == 0) seams = seam_points(mesh);
    if (seams.empty()) return {};
    ruler(result);
    const auto inside = band(seams, result);
    std::vector<char> outside;
    for (const char in : inside) outside.push_back(in ? 0 : 1);
    sides.push_back({figures(ruler.reference, result, inside), figures(ruler.reference, result, outside)});
    if (k == 0) epsilon = report.epsilon_fraction;
    options.target_faces = 0;  // the options that a target sets
    options.trace.seed_fraction = 0.8;
    options.trace.relax_passes = 0;
    options.mesh.cell_tolerance = 4;
    const size_t steps = k / 2 + 1;
    const double step = 1 + 0.02 * static_cast<double>(steps);
    options.trace.density.epsilon_fraction = epsilon * std::pow(step, k % 2 == 0 ? 1 : -1);
  }
  return sides;
}

// Of all meshes: [0] in charts, [1] on the surface, [2] the one over the other.
struct BandRatios {
  Ratios quads[3], alignment[3], error[3];

  void print() const {
    const char* names[3] = {"charts", "surface", "charts over surface"};
    std::printf(
        "\nInside over elsewhere, geometric means of %zu with their standard errors:\n\n"
        "| domain | quads | alignment | error |\n|---|---|---|---|\n",
        quads[0].count());
    for (int k = 0; k < 3; ++k)
      std::printf("| %s | %s | %s | %s |\n", names[k], quads[k].text().c_str(), alignment[k].text().c_str(),
                  error[k].text().c_str());
  }
};

void compare_bands(const std::string& name, const std::string& path, const Settings& settings,
                   BandRatios& ratios) {
  auto mesh = read_surface(path);
  bench::Ruler ruler(mesh);
  std::vector<Vec3d> seams;
  Figures in[2], out[2];
  for (const int k : {0, 1}) {
    const auto sides = sides_of(mesh, k == 0 ? Domain::charts : Domain::surface, settings, ruler, seams);
    if (sides.empty()) {
      std::printf("| %s | no seams but features |\n", name.c_str());
      return;
    }
    in[k] = mean(sides, &Sides::in), out[k] = mean(sides, &Sides::out);
    ratios.quads[k].add(in[k].quads, out[k].quads);
    ratios.alignment[k].add(in[k].alignment, out[k].alignment);
    ratios.error[k].add(in[k].error, out[k].error);
    std::printf("| %s | %s | %zu | %zu | %.1f | %.1f | %.3f | %.2f | %.2f | %.3f | %.4f | %.4f | %.3f |\n",
                name.c_str(), k == 0 ? "charts" : "surface", in[k].faces, out[k].faces, 100 * in[k].quads,
                100 * out[k].quads, in[k].quads / out[k].quads, in[k].alignment, out[k].alignment,
                in[k].alignment / out[k].alignment, 100 * in[k].error, 100 * out[k].error,
                in[k].error / out[k].error);
    std::fflush(stdout);
  }
  ratios.quads[2].add(in[0].quads * out[1].quads, out[0].quads * in[1].quads);
  ratios.alignment[2].add(in[0].alignment * out[1].alignment, out[0].alignment * in[1].alignment);
  ratios.error[2].add(in[0].error * out[1].error, out[0].error * in[1].error);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  bench::Arguments arguments;
  arguments.number("--target", settings.target);
  arguments.features("--feature-angle", settings.features);
  arguments.flag("--seams", settings.seams);
  arguments.number("--repeats", settings.repeats);
  arguments.flag("--no-fit", settings.unfitted);
  auto names = arguments.read(argc, argv);
  if (names.empty()) names = ten_meshes();
  if (settings.seams)
    std::printf(
        "| mesh | domain | faces in | out | quads %% in | out | ratio | alignment in | out | ratio | error "
        "%% in | "
        "out | ratio |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  else
    std::printf(
        "| mesh | domain | charts | wedges + trisectors | vertices | faces | broken | quads %% | RMS %% | "
        "Hausdorff %% | alignment | seconds | processor | memory MiB "
        "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  bool found = false;
  BandRatios ratios;
  Tally tally;
  for (const std::string& name : names) {
    const auto path = demo_mesh(name);
    if (!path) continue;
    found = true;
    try {
      if (settings.seams)
        compare_bands(name, *path, settings, ratios);
      else
        compare_domains(name, *path, settings, tally);
    } catch (const std::exception& e) {
      std::printf("| %s | refused: %s |\n", name.c_str(), e.what());
    }
  }
  if (ratios.quads[2].count() > 0) ratios.print();
  if (tally.error.count() > 0) tally.print();
  return found ? 0 : 77;
}
