// The half torus (R = 1, r = 0.4) with 500 vertices against the best regular grid along its own circles.
//
//   torus_grid [VERTICES]
//
// The grid is found by trying every number of circles both ways whose product is within 4 % of the wanted
// count; its error is scaled to exactly that count (error goes as 1 / vertices).
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "anisomesh/remesh.hh"
#include "anisomesh/shapes.hh"
#include "bench.hh"

using namespace anisomesh;

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double slit = 170 * pi / 180;  // the tube of make_shape("half-torus") runs from -slit to slit

/// Quads between `rings` arcs of the tube and `circles` half circles around the axis, evenly spaced.
OpenMesh::PolyMesh torus_grid(int arcs, int circles) {
  OpenMesh::PolyMesh mesh;
  for (int j = 0; j < circles; ++j)
    for (int i = 0; i < arcs; ++i) {
      const double around = pi * i / (arcs - 1), tube = -slit + 2 * slit * j / (circles - 1);
      const double distance = 1 + 0.4 * std::cos(tube);
      mesh.add_vertex(Vec3d(distance * std::cos(around), distance * std::sin(around), 0.4 * std::sin(tube)));
    }
  const auto at = [&](int i, int j) { return OpenMesh::VertexHandle(j * arcs + i); };
  for (int j = 0; j + 1 < circles; ++j)
    for (int i = 0; i + 1 < arcs; ++i) mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  return mesh;
}

struct Grid {
  int arcs = 0, circles = 0;
  double rms = 1;  // scaled to the wanted number of vertices
};

double scaled_rms(OpenMesh::TriMesh& reference, const Grid& grid, int vertices, size_t samples) {
  CompareOptions options;
  options.samples = samples;
  auto mesh = torus_grid(grid.arcs, grid.circles);
  return compare(reference, mesh, options).two_sided.rms * grid.arcs * grid.circles / vertices;
}

/// Every aspect roughly, then the five best with all samples.
Grid best_grid(OpenMesh::TriMesh& reference, int vertices) {
  ShapeOptions coarse;
  coarse.vertices = 10000;
  auto rough = make_shape("half-torus", coarse);
  std::vector<Grid> grids;
  for (int arcs = 3; arcs <= vertices / 3; ++arcs)
    for (int circles = std::max(3, static_cast<int>(std::ceil(0.96 * vertices / arcs)));
         circles <= 1.04 * vertices / arcs; ++circles) {
      grids.push_back({arcs, circles, 0});
      grids.back().rms = scaled_rms(rough, grids.back(), vertices, 5000);
    }
  const auto better = [](const Grid& a, const Grid& b) { return a.rms < b.rms; };
  std::sort(grids.begin(), grids.end(), better);
  grids.resize(std::min<size_t>(grids.size(), 5));
  for (Grid& grid : grids) grid.rms = scaled_rms(reference, grid, vertices, 200000);
  return *std::min_element(grids.begin(), grids.end(), better);
}

}  // namespace

int main(int argc, char** argv) {
  const int vertices = argc > 1 ? std::stoi(argv[1]) : 500;
  ShapeOptions shape;
  shape.vertices = 40000;
  auto input = make_shape("half-torus", shape);
  bench::Ruler ruler(input);

  RemeshOptions options;
  options.fit.enabled = false;
  options.target_vertices = static_cast<size_t>(vertices);
  RemeshReport report;
  auto result = remesh(input, options, &report);
  const Comparison c = ruler(result);
  const Grid grid = best_grid(ruler.reference, static_cast<int>(c.vertices));
  auto grid_mesh = torus_grid(grid.arcs, grid.circles);
  const Comparison of_grid = ruler(grid_mesh);

  std::printf("| mesh | vertices | quads | rms %% | mean alignment |\n|---|---|---|---|---|\n");
  std::printf("| best grid, %d arcs x %d circles | %zu | %.2f | %.4f | %.2f |\n", grid.arcs, grid.circles,
              of_grid.vertices, of_grid.quad_fraction, 100 * of_grid.two_sided.rms,
              of_grid.mean_alignment_degrees);
  std::printf("| remesh | %zu | %.2f | %.4f | %.2f |\n\n", c.vertices, c.quad_fraction, 100 * c.two_sided.rms,
              c.mean_alignment_degrees);
  bench::Bars bars;
  bars.check(c.two_sided.rms <= 1.25 * grid.rms,
             "rms over the best grid's: " + bench::format("%.2f", c.two_sided.rms / grid.rms) + " (1.25)");
  bars.check(c.quad_fraction >= 0.95, "quads: " + bench::format("%.3f", c.quad_fraction) + " (0.95)");
  bars.check(c.mean_alignment_degrees < 1,
             "alignment: " + bench::format("%.2f", c.mean_alignment_degrees) + " degrees (1)");
  bars.check(report.target_met, "within 10 % of " + std::to_string(vertices) + " vertices");
  return bars.missed() > 0 ? 1 : 0;
}
