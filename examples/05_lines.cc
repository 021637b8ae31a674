// Traces lines of curvature and isotropic samples, and walks along them on the surface.
#include <anisomesh/curvature.hh>
#include <anisomesh/flatten.hh>
#include <anisomesh/lines.hh>
#include <anisomesh/shapes.hh>
#include <anisomesh/smoothing.hh>
#include <anisomesh/umbilics.hh>
#include <cstdio>

int main() {
  OpenMesh::TriMesh mesh = anisomesh::make_shape("ellipsoid-cap");  // or anisomesh::read_surface("scan.obj")
  anisomesh::estimate_curvature(mesh);
  anisomesh::flatten(mesh);
  anisomesh::smooth_tensors(mesh);
  anisomesh::find_umbilics(mesh);

  anisomesh::TraceOptions options;
  options.density.epsilon_fraction = 0.001;  // tolerated distance from the surface, of the diagonal
  const auto report = anisomesh::trace_lines(mesh, options);
  const auto samples = anisomesh::place_isotropic_samples(mesh, options);
  std::printf("%zu min lines, %zu max lines, %zu of them closed; %zu isotropic samples\n", report.min_lines,
              report.max_lines, report.closed_lines, samples.from_umbilics + samples.random);

  // Lines are chains of surface points: a face and barycentric coordinates.
  const anisomesh::SurfaceRef surface = mesh;
  double length = 0;
  for (const auto& line : anisomesh::read_lines(surface).lines)
    for (size_t i = 1; i < line.points.size(); ++i)
      length += (position(surface, line.points[i]) - position(surface, line.points[i - 1])).norm();
  std::printf("%.2f times the diagonal in all\n", length / surface.diagonal());
  return report.min_lines > 5 && report.max_lines > 5 && report.closed_lines > 0 ? 0 : 1;
}
