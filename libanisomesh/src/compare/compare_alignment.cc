// How edges and quads follow the principal directions of the reference.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "compare/compare_parts.hh"

namespace anisomesh::detail {

namespace {

constexpr double degrees = 180 / 3.14159265358979323846;
/// Aspects beyond this count as this much: equation 7 grows without bound where one curvature vanishes.
constexpr double largest_aspect = 8;

/// The principal frame of the interpolated curvature tensor at a point of the reference.
struct Frame {
  double k_min = 0, k_max = 0, anisotropy = 0;
  Vec3d gamma_min{0, 0, 0}, gamma_max{0, 0, 0};
};

/// The tensor applied to x: interpolated between the corners of a triangle.
Vec3d apply(const ReferenceSurface& reference, const ClosestPoint& at, const Vec3d& x) {
  const Triangle& corner = reference.tree.triangles()[static_cast<size_t>(at.triangle)];
  Vec3d sum(0, 0, 0);
  for (int i = 0; i < 3; ++i) {
    const auto v = static_cast<size_t>(corner[static_cast<size_t>(i)]);
    const Vec3d &g = reference.gamma_min[v], &h = reference.gamma_max[v];
    sum += at.barycentric[i] * (reference.k_min[v] * dot(g, x) * g + reference.k_max[v] * dot(h, x) * h);
  }
  return sum;
}

/// Unit mean of the corners' normals gamma_min x gamma_max, on the side of the triangle's own.
Vec3d interpolated_normal(const ReferenceSurface& reference, const ClosestPoint& at) {
  const auto triangle = static_cast<size_t>(at.triangle);
  Vec3d sum(0, 0, 0);
  for (int i = 0; i < 3; ++i) {
    const auto v = static_cast<size_t>(reference.tree.triangles()[triangle][static_cast<size_t>(i)]);
    const Vec3d n = cross(reference.gamma_min[v], reference.gamma_max[v]);
    sum += at.barycentric[i] * (dot(n, reference.normals[triangle]) < 0 ? -n : n);
  }
  const double length = sum.norm();
  return length > 0 ? sum / length : reference.normals[triangle];
}

Frame frame_at(const ReferenceSurface& reference, const Vec3d& p) {
  Frame frame;
  const ClosestPoint at = reference.tree.closest(p);
  const Vec3d normal = interpolated_normal(reference, at);
  if (!(normal.sqrnorm() > 0)) return frame;
  const int axis = std::abs(normal[0]) < 0.6 ? 0 : std::abs(normal[1]) < 0.6 ? 1 : 2;
  Vec3d other(0, 0, 0);
  other[axis] = 1;
  const Vec3d x = cross(normal, other).normalized(), y = cross(normal, x);
  const Vec3d tx = apply(reference, at, x), ty = apply(reference, at, y);
  const double xx = dot(x, tx), xy = 0.5 * (dot(y, tx) + dot(x, ty)), yy = dot(y, ty);
  const double mean = 0.5 * (xx + yy), half = 0.5 * (xx - yy), deviator = std::hypot(half, xy);
  const double angle = 0.5 * std::atan2(xy, half);  // of the larger eigenvalue's direction
  frame.gamma_max = std::cos(angle) * x + std::sin(angle) * y;
  frame.gamma_min = cross(normal, frame.gamma_max);
  frame.k_min = mean - deviator;
  frame.k_max = mean + deviator;
  const double small = std::min(std::abs(frame.k_min), std::abs(frame.k_max)),
               large = std::max(std::abs(frame.k_min), std::abs(frame.k_max));
  frame.anisotropy = small + large > 0 ? (large - small) / (large + small) : 0;
  return frame;
}

/// Angle of a segment, seen in the tangent plane, to the nearer principal direction: 0 to 45 degrees.
double angle_to_frame(const Frame& frame, const Vec3d& along) {
  const double a = std::abs(dot(along, frame.gamma_min)), b = std::abs(dot(along, frame.gamma_max));
  return std::atan2(std::min(a, b), std::max(a, b)) * degrees;
}

double alignment(const ReferenceSurface& reference, const PolygonSoup& result, const OpenMesh::PolyMesh& mesh,
                 double threshold) {
  std::vector<double> angles(mesh.n_edges(), 0), weights(mesh.n_edges(), 0);
  tbb::parallel_for(size_t{0}, mesh.n_edges(), [&](size_t e) {
    const auto halfedge = mesh.halfedge_handle(OpenMesh::EdgeHandle(static_cast<int>(e)), 0);
    const Vec3d &a = result.points[static_cast<size_t>(mesh.from_vertex_handle(halfedge).idx())],
                &b = result.points[static_cast<size_t>(mesh.to_vertex_handle(halfedge).idx())];
    // At its middle: towards its ends a chord leaves the direction of a line that turns within the surface,
    // however well it follows it, and the grid of a torus along its own circles would not be aligned.
    const Frame frame = frame_at(reference, 0.5 * (a + b));
    if (!(frame.anisotropy > threshold)) return;
    weights[e] = (b - a).norm();
    angles[e] = angle_to_frame(frame, b - a) * weights[e];
  });
  double sum = 0, weight = 0;
  for (size_t e = 0; e < angles.size(); ++e) sum += angles[e], weight += weights[e];
  return weight > 0 ? sum / weight : 0;
}

/// |log2| of a quad's aspect over sqrt(|k_max| / |k_min|) [ACDLD03, equation 7]; negative where it has none.
double aspect_error(const Frame& frame, const std::array<Vec3d, 4>& corner) {
  const auto mean_side = [&](size_t i) {
    return 0.5 *
           ((corner[(i + 1) % 4] - corner[i]).norm() + (corner[(i + 2) % 4] - corner[(i + 3) % 4]).norm());
  };
  double along_min = mean_side(0), along_max = mean_side(1);
  const Vec3d first = (corner[1] - corner[0]) + (corner[2] - corner[3]);
  if (std::abs(dot(first, frame.gamma_min)) < std::abs(dot(first, frame.gamma_max)))
    std::swap(along_min, along_max);
  if (!(along_min > 0) || !(along_max > 0)) return -1;
  const auto bounded = [](double aspect) { return std::clamp(aspect, 1 / largest_aspect, largest_aspect); };
  const double wanted = std::sqrt(std::abs(frame.k_max) / std::abs(frame.k_min));
  return std::abs(std::log2(bounded(along_min / along_max) / bounded(wanted)));
}

double mean_aspect_error(const ReferenceSurface& reference, const PolygonSoup& result, double threshold) {
  std::vector<double> errors(result.faces.size(), -1);
  tbb::parallel_for(size_t{0}, result.faces.size(), [&](size_t f) {
    if (result.faces[f].size() != 4) return;
    std::array<Vec3d, 4> corner;
    Vec3d centre(0, 0, 0);
    for (size_t i = 0; i < 4; ++i) {
      corner[i] = result.points[static_cast<size_t>(result.faces[f][i])];
      centre += 0.25 * corner[i];
    }
    const Frame frame = frame_at(reference, centre);
    if (frame.anisotropy > threshold) errors[f] = aspect_error(frame, corner);
  });
  double sum = 0;
  size_t count = 0;
  for (const double error : errors)
    if (error >= 0) sum += error, ++count;
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

}  // namespace

void measure_alignment(const ReferenceSurface& reference, const PolygonSoup& result,
                       const OpenMesh::PolyMesh& mesh, double anisotropy_threshold, Comparison& comparison) {
  if (!reference.has_curvature) return;
  comparison.mean_alignment_degrees = alignment(reference, result, mesh, anisotropy_threshold);
  comparison.aspect_ratio_error = mean_aspect_error(reference, result, anisotropy_threshold);
}

}  // namespace anisomesh::detail
