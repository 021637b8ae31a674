// Distances and normals, by area samples on both meshes.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "compare/compare_parts.hh"
#include "numerics/sampling.hh"

namespace anisomesh::detail {

namespace {

constexpr double degrees = 180 / 3.14159265358979323846;

std::vector<ClosestPoint> closest_to(const TriangleTree& tree, const std::vector<Vec3d>& points) {
  std::vector<ClosestPoint> hits(points.size());
  // Each element is written by itself and all sums are taken afterwards in order: any number of threads gives
  // the same figures.
  tbb::parallel_for(tbb::blocked_range<size_t>(0, points.size(), 256), [&](const auto& range) {
    for (size_t i = range.begin(); i != range.end(); ++i) hits[i] = tree.closest(points[i]);
  });
  return hits;
}

std::vector<Vec3d> points_of(const std::vector<AreaSample>& samples) {
  std::vector<Vec3d> points;
  points.reserve(samples.size());
  for (const AreaSample& sample : samples) points.push_back(sample.point);
  return points;
}

double largest_distance(const std::vector<ClosestPoint>& hits) {
  double largest = 0;
  for (const ClosestPoint& hit : hits) largest = std::max(largest, hit.squared_distance);
  return std::sqrt(largest);
}

/// Mean and rms over the area samples; Hausdorff over the vertices too, where the extremes often are. The
/// vertices stay out of the means, since they are denser where there is detail.
Distances summarize(const std::vector<ClosestPoint>& samples, const std::vector<ClosestPoint>& vertices,
                    double diagonal) {
  Distances distances;
  double sum = 0, squares = 0;
  for (const ClosestPoint& hit : samples) {
    sum += std::sqrt(hit.squared_distance);
    squares += hit.squared_distance;
  }
  const double count = std::max<double>(1, static_cast<double>(samples.size()));
  distances.mean = sum / count / diagonal;
  distances.rms = std::sqrt(squares / count) / diagonal;
  distances.hausdorff = std::max(largest_distance(samples), largest_distance(vertices)) / diagonal;
  return distances;
}

double quantile(const std::vector<ClosestPoint>& a, const std::vector<ClosestPoint>& b, double fraction) {
  std::vector<double> all;
  all.reserve(a.size() + b.size());
  for (const ClosestPoint& hit : a) all.push_back(hit.squared_distance);
  for (const ClosestPoint& hit : b) all.push_back(hit.squared_distance);
  if (all.empty()) return 0;
  const auto at = all.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(all.size() - 1));
  std::nth_element(all.begin(), at, all.end());
  return std::sqrt(*at);
}

Vec3d normal_of(const PolygonSoup& result, size_t triangle) {
  const Triangle& corner = result.triangles[triangle];
  const Vec3d& a = result.points[static_cast<size_t>(corner[0])];
  const Vec3d normal = cross(result.points[static_cast<size_t>(corner[1])] - a,
                             result.points[static_cast<size_t>(corner[2])] - a);
  const double length = normal.norm();
  return length > 0 ? normal / length : normal;
}

/// \param normal_at of each triangle of the result
template <class NormalAt>
double mean_normal_deviation(const ReferenceSurface& reference, const std::vector<AreaSample>& samples,
                             const std::vector<ClosestPoint>& hits, NormalAt normal_at) {
  double sum = 0;
  size_t count = 0;
  for (size_t i = 0; i < samples.size(); ++i) {
    const Vec3d a = normal_at(static_cast<size_t>(samples[i].triangle)),
                b = reference.normals[static_cast<size_t>(hits[i].triangle)];
    if (!(a.sqrnorm() > 0) || !(b.sqrnorm() > 0)) continue;
    sum += std::atan2(cross(a, b).norm(), dot(a, b)) * degrees;
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

/// Root of the mean squared distance over the samples on a face and those of the reference nearest to it.
std::vector<double> errors_of_faces(const PolygonSoup& result, const std::vector<AreaSample>& on_result,
                                    const std::vector<ClosestPoint>& forward,
                                    const std::vector<ClosestPoint>& backward) {
  std::vector<double> squares(result.faces.size(), 0), counts(result.faces.size(), 0);
  const auto add = [&](int triangle, double squared_distance) {
    const auto face = static_cast<size_t>(result.face_of[static_cast<size_t>(triangle)]);
    squares[face] += squared_distance;
    counts[face] += 1;
  };
  for (size_t i = 0; i < on_result.size(); ++i) add(on_result[i].triangle, forward[i].squared_distance);
  for (const ClosestPoint& hit : backward) add(hit.triangle, hit.squared_distance);
  for (size_t f = 0; f < squares.size(); ++f)
    squares[f] = counts[f] > 0 ? std::sqrt(squares[f] / counts[f]) : 0;
  return squares;
}

}  // namespace

void measure_distances(const ReferenceSurface& reference, const PolygonSoup& result,
                       const CompareOptions& options, const Progress& progress, Comparison& comparison,
                       std::vector<double>& vertex_errors, std::vector<double>& face_errors) {
  const double diagonal = reference.diagonal;
  const auto on_result = sample_by_area(result.points, result.triangles, options.samples, options.seed);
  const auto on_reference =
      sample_by_area(reference.tree.points(), reference.tree.triangles(), options.samples, options.seed + 1);
  const auto forward = closest_to(reference.tree, points_of(on_result));
  const auto forward_vertices = closest_to(reference.tree, result.points);
  report_progress(progress, 0.4);
  const TriangleTree result_tree(result.points, result.triangles);
  const auto backward = closest_to(result_tree, points_of(on_reference));
  const auto backward_vertices = closest_to(result_tree, reference.tree.points());
  report_progress(progress, 0.8);

  Distances &to = comparison.to_reference, &from = comparison.from_reference, &both = comparison.two_sided;
  to = summarize(forward, forward_vertices, diagonal);
  from = summarize(backward, backward_vertices, diagonal);
  both.mean = 0.5 * (to.mean + from.mean);
  both.rms = std::sqrt(0.5 * (to.rms * to.rms + from.rms * from.rms));
  both.hausdorff = std::max(to.hausdorff, from.hausdorff);
  comparison.p99_fraction = quantile(forward, backward, 0.99) / diagonal;
  comparison.mean_normal_deviation_degrees = mean_normal_deviation(
      reference, on_result, forward,
      [&](size_t triangle) { return result.normals[static_cast<size_t>(result.face_of[triangle])]; });
  comparison.mean_surface_normal_deviation_degrees = mean_normal_deviation(
      reference, on_result, forward, [&](size_t triangle) { return normal_of(result, triangle); });

  vertex_errors.clear();
  for (const ClosestPoint& hit : forward_vertices) vertex_errors.push_back(std::sqrt(hit.squared_distance));
  face_errors = errors_of_faces(result, on_result, forward, backward);
}

}  // namespace anisomesh::detail
