// Charts against the surface: the same meshes remeshed in both domains, and what can be seen of the seams.
//
//   ANISOMESH_DATA=FOLDER charts [--target FACES] [--feature-angle DEGREES] [--seams] [NAME...]
//
// Without --seams a markdown table with a row for each mesh and domain; memory is the peak of a process that
// does this run alone. With --seams a table of the results inside a band of two edges along the seams and
// elsewhere: quads, alignment and error (root of the mean squared face_error, % of the diagonal). Since seams
// keep to creases the surface is another there; the same band of the result that was made on the surface,
// where seams never were, says how much of the difference that is.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <exception>
#include <string>
#include <vector>

#include "anisomesh/charts.hh"
#include "anisomesh/properties.hh"
#include "anisomesh/remesh.hh"
#include "arguments.hh"
#include "bench.hh"

using namespace anisomesh;

namespace {

struct Settings {
  size_t target = 4000;
  FeatureOptions features;
  bool seams = false;
};

const std::vector<std::string>& ten_meshes() {
  static const std::vector<std::string> names = {"pig.stl",     "hand.off",  "bunny00.off", "camel.off",
                                                 "cow.off",     "homer.off", "bull.off",    "elephant.off",
                                                 "fandisk.off", "knot1.off"};
  return names;
}

// Geometric means of what is inside over what is elsewhere.
struct Ratios {
  double quads = 0, alignment = 0, error = 0;  // sums of logarithms
  int count = 0;
  void print(const char* domain) const {
    std::printf("%s: inside over elsewhere, geometric means of %d: quads %.3f, alignment %.3f, error %.3f\n",
                domain, count, std::exp(quads / count), std::exp(alignment / count), std::exp(error / count));
  }
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

OpenMesh::PolyMesh remeshed(OpenMesh::TriMesh& mesh, Domain domain, const Settings& settings,
                            RemeshReport& report) {
  RemeshOptions options;
  options.fit.enabled = false;
  options.domain = domain;
  options.features = settings.features;
  options.target_faces = std::min(settings.target, mesh.n_faces() / 2);
  return remesh(mesh, options, &report);
}

void compare_domains(const std::string& name, const std::string& path, const Settings& settings) {
  for (const Domain domain : {Domain::charts, Domain::surface}) {
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
      int code = 0;
      try {
        auto mesh = read_surface(path);
        RemeshReport report;
        auto result = remeshed(mesh, domain, settings, report);
        rusage usage{};
        getrusage(RUSAGE_SELF, &usage);
        const auto c = bench::Ruler(mesh)(result);
        const bool charts = domain == Domain::charts;
        std::printf("| %s | %s | %s | %zu + %zu | %zu | %zu | %.1f | %.4f | %.3f | %.2f | %.2f | %ld |\n",
                    name.c_str(), charts ? "charts" : "surface",
                    charts ? std::to_string(report.domain.charts.charts).c_str() : "", report.umbilics.wedges,
                    report.umbilics.trisectors, c.vertices, c.faces, 100 * c.quad_fraction,
                    100 * c.two_sided.rms, 100 * c.two_sided.hausdorff, c.mean_alignment_degrees,
                    report.seconds, usage.ru_maxrss / 1024);
      } catch (const std::exception& e) {
        std::printf("| %s | refused: %s |\n", name.c_str(), e.what());
        code = 1;
      }
      std::fflush(stdout);
      _exit(code);
    }
    waitpid(child, nullptr, 0);
  }
}

void compare_bands(const std::string& name, const std::string& path, const Settings& settings,
                   Ratios ratios[2]) {
  auto mesh = read_surface(path);
  bench::Ruler ruler(mesh);
  std::vector<Vec3d> seams;
  for (const Domain domain : {Domain::charts, Domain::surface}) {
    RemeshReport report;
    auto result = remeshed(mesh, domain, settings, report);
    if (domain == Domain::charts) seams = seam_points(mesh);
    ruler(result);
    const auto inside = band(seams, result);
    std::vector<char> outside;
    for (const char in : inside) outside.push_back(in ? 0 : 1);
    const auto in = figures(ruler.reference, result, inside), out = figures(ruler.reference, result, outside);
    Ratios& sums = ratios[domain == Domain::charts ? 0 : 1];
    sums.quads += std::log(in.quads / out.quads);
    sums.alignment += std::log(in.alignment / out.alignment);
    sums.error += std::log(in.error / out.error);
    ++sums.count;
    std::printf("| %s | %s | %zu | %zu | %.1f | %.1f | %.3f | %.2f | %.2f | %.3f | %.4f | %.4f | %.3f |\n",
                name.c_str(), domain == Domain::charts ? "charts" : "surface", in.faces, out.faces,
                100 * in.quads, 100 * out.quads, in.quads / out.quads, in.alignment, out.alignment,
                in.alignment / out.alignment, 100 * in.error, 100 * out.error, in.error / out.error);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  bench::Arguments arguments;
  arguments.number("--target", settings.target);
  arguments.features("--feature-angle", settings.features);
  arguments.flag("--seams", settings.seams);
  auto names = arguments.read(argc, argv);
  if (names.empty()) names = ten_meshes();
  if (settings.seams)
    std::printf(
        "| mesh | domain | faces in | out | quads %% in | out | ratio | alignment in | out | ratio | error "
        "%% in | "
        "out | ratio |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  else
    std::printf(
        "| mesh | domain | charts | wedges + trisectors | vertices | faces | quads %% | RMS %% | Hausdorff "
        "%% | "
        "alignment | seconds | memory MiB |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  bool found = false;
  Ratios ratios[2];
  for (const std::string& name : names) {
    const auto path = demo_mesh(name);
    if (!path) continue;
    found = true;
    try {
      if (settings.seams)
        compare_bands(name, *path, settings, ratios);
      else
        compare_domains(name, *path, settings);
    } catch (const std::exception& e) {
      std::printf("| %s | refused: %s |\n", name.c_str(), e.what());
    }
  }
  if (settings.seams && found) {
    std::printf("\n");
    ratios[0].print("charts");
    ratios[1].print("surface");
  }
  return found ? 0 : 77;
}
