// Vertices off the surface: half the error and less, with as many of them.
#include <anisomesh/compare.hh>
#include <anisomesh/fit.hh>
#include <anisomesh/remesh.hh>
#include <anisomesh/shapes.hh>
#include <cstdio>

int main() {
  using namespace anisomesh;
  OpenMesh::TriMesh mesh = make_shape("torus");
  RemeshOptions options;
  options.target_vertices = 500;
  options.fit.enabled = false;  // every vertex on the surface, as in the paper
  OpenMesh::PolyMesh result = remesh(mesh, options);
  const double before = compare(mesh, result).two_sided.rms;

  const FitReport report = fit_vertices(mesh, result);
  const double after = compare(mesh, result).two_sided.rms;
  std::printf("rms %.4f %% of the diagonal, %.4f %% after %d passes in %.2f s\n", 100 * before, 100 * after,
              report.passes, report.seconds);
  return after < 0.5 * before ? 0 : 1;
}
