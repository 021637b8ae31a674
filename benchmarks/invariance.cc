// Whether a surface that is scaled, moved, turned or renumbered gives the same result, stage by stage.
//
//   invariance FACES|EPSILON NAME[:FEATURE_ANGLE]...
//
// A number below 1 is the epsilon, as a fraction of the diagonal before the change; 0: the default. NAME is a
// file of libcgal-demo (with ANISOMESH_DATA=FOLDER, see data.hh) or a shape. "Farthest" is the largest
// distance of a vertex of the result from where it is to be, as a fraction of the diagonal, or says that
// there are others.
#include <string>
#include <vector>

#include "anisomesh/remesh.hh"
#include "anisomesh/shapes.hh"
#include "bench.hh"
#include "copies.hh"

using namespace anisomesh;

namespace {

struct Job {
  std::string name;
  double angle_degrees = -1;  ///< below 0: features are found
  size_t faces = 0;           ///< 0: epsilon
  double epsilon = 0;         ///< of the diagonal
};

OpenMesh::TriMesh load(const std::string& name) {
  if (const auto path = demo_mesh(name + ".off")) return read_surface(*path);
  return make_shape(name, {4000, true});
}

/// How far the vertices of a result are from where the change takes those of another, of the diagonal;
/// "differs" where it has others, or other polygons.
std::string farthest(const OpenMesh::PolyMesh& expected, const OpenMesh::PolyMesh& found,
                     const copies::Change& change, double size) {
  if (expected.n_vertices() != found.n_vertices() || expected.n_faces() != found.n_faces()) return "differs";
  double most = 0;
  for (const auto v : expected.vertices())
    most = std::max(most, (found.point(v) - change.apply(expected.point(v))).norm());
  for (const auto f : expected.faces())
    if (copies::corners(expected, f) != copies::corners(found, f)) return "differs";
  return bench::format("%.1e", most / (size * change.scale));
}

/// \param box the diagonal of the mesh as it was over that of this one
/// \param same how far it is from the result of the mesh as it was
template <class Same>
OpenMesh::PolyMesh run(const Job& job, const char* what, OpenMesh::TriMesh& mesh, double box, Same same) {
  RemeshOptions options;
  if (job.angle_degrees >= 0) {
    options.features.angle_degrees = job.angle_degrees;
    options.features.automatic = false;
  }
  options.target_faces = job.faces;
  options.trace.density.epsilon_fraction = job.epsilon * box;
  RemeshReport report;
  auto result = remesh(mesh, options, &report);
  const std::string off = same(result);
  const double rms = 100 * compare(mesh, result).two_sided.rms / box;
  std::printf("| %s | %s | %.12g | %zu + %zu | %zu | %zu | %zu | %zu | %s | %.5f |\n", job.name.c_str(), what,
              report.epsilon_fraction / box, report.trace.min_lines, report.trace.max_lines,
              report.trace.points, report.isotropic.from_umbilics + report.isotropic.random,
              result.n_vertices(), result.n_faces(), off.c_str(), rms);
  std::fflush(stdout);
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: invariance FACES|EPSILON NAME[:FEATURE_ANGLE]...\n");
    return 1;
  }
  std::printf(
      "| input | copy | epsilon | lines | points | samples | vertices | faces | farthest | rms %% |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n");
  for (int i = 2; i < argc; ++i) {
    Job job;
    job.name = argv[i];
    job.epsilon = std::stod(argv[1]);
    if (job.epsilon >= 1) job.faces = static_cast<size_t>(job.epsilon), job.epsilon = 0;
    if (const auto colon = job.name.find(':'); colon != std::string::npos) {
      job.angle_degrees = std::stod(job.name.substr(colon + 1));
      job.name.resize(colon);
    }
    auto mesh = load(job.name);
    mesh = copies::representable(mesh, SurfaceRef(mesh).diagonal());
    const double size = SurfaceRef(mesh).diagonal();
    const OpenMesh::TriMesh original = mesh;
    const auto expected =
        run(job, "as it is", mesh, 1, [](const OpenMesh::PolyMesh&) { return std::string(); });
    for (const auto& change : copies::changes(size)) {
      auto copy = copies::changed(original, change);
      run(job, change.name, copy, size * change.scale / SurfaceRef(copy).diagonal(),
          [&](const OpenMesh::PolyMesh& found) { return farthest(expected, found, change, size); });
    }
  }
}
