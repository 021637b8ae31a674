// From a surface to polygons, and what the result says of itself.
#include <algorithm>
#include <anisomesh/curvature.hh>
#include <anisomesh/flatten.hh>
#include <anisomesh/lines.hh>
#include <anisomesh/mesher.hh>
#include <anisomesh/properties.hh>
#include <anisomesh/shapes.hh>
#include <anisomesh/smoothing.hh>
#include <anisomesh/umbilics.hh>
#include <cstdio>

int main() {
  using namespace anisomesh;
  OpenMesh::TriMesh mesh = make_shape("squeezed-dome");
  const SurfaceRef surface = mesh;
  estimate_curvature(surface);
  flatten(surface);
  smooth_tensors(surface);
  find_umbilics(surface);
  TraceOptions trace;
  trace.density.epsilon_fraction = 0.002;
  trace_lines(surface, trace);
  place_isotropic_samples(surface, trace);

  MeshOptions options;
  options.max_degree = 4;  // quads and triangles; 0 leaves the polygons as extracted
  MeshReport report;
  const OpenMesh::PolyMesh result = build_polygons(surface, options, &report);
  std::printf("%zu vertices, %zu faces, %zu of them quads, %.3f s\n", report.vertices, report.faces,
              report.quads, report.seconds);

  // Every vertex is a point of the input: any of its properties can be carried over.
  const auto face = require_property(result, property::source_face);
  const auto barycentric = require_property(result, property::source_barycentric);
  const auto k_max = require_property(mesh, property::k_max);
  double largest = 0;
  for (const auto vertex : result.vertices()) {
    const auto corners = surface.corners(OpenMesh::FaceHandle(result.property(face, vertex)));
    double value = 0;
    for (size_t k = 0; k < 3; ++k)
      value += result.property(barycentric, vertex)[k] * mesh.property(k_max, corners.vertex[k]);
    largest = std::max(largest, value);
  }
  const auto kind = require_property(result, property::edge_kind);
  double aligned = 0, all = 0;
  for (const auto edge : result.edges()) {
    const double length = result.calc_edge_length(edge);
    all += length;
    if (result.property(kind, edge) != static_cast<int>(EdgeKind::conforming)) aligned += length;
  }
  std::printf("largest k_max at a vertex %.3f; %.0f %% of the edges' length is lines, features or border\n",
              largest, 100 * aligned / all);
  return report.quads > report.triangles ? 0 : 1;
}
