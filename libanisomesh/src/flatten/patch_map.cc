#include "flatten/patch_map.hh"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "anisomesh/errors.hh"
#include "numerics/conformal_map.hh"
#include "numerics/planar_map.hh"
#include "numerics/tensor2d.hh"

namespace anisomesh::detail {

namespace {

/// Moments of the border, weighed by length: their principal axis becomes the u axis.
struct BorderFrame {
  Vec2d centre{0, 0}, axis{1, 0};
};

BorderFrame border_frame(const Patch& patch, const std::vector<Vec2d>& map) {
  const size_t n = patch.border.size();
  const auto place = [&](size_t i) -> const Vec2d& { return map[static_cast<size_t>(patch.border[i % n])]; };
  BorderFrame frame;
  double total = 0;
  for (size_t i = 0; i < n; ++i) {
    const double length = (place(i + 1) - place(i)).norm();
    frame.centre += 0.5 * length * (place(i) + place(i + 1));
    total += length;
  }
  frame.centre /= total;
  Vec3d second(0, 0, 0);
  for (size_t i = 0; i < n; ++i) {
    const double length = (place(i + 1) - place(i)).norm();
    const Vec2d p = 0.5 * (place(i) + place(i + 1)) - frame.centre;
    second += length * Vec3d(p[0] * p[0], p[0] * p[1], p[1] * p[1]);
  }
  frame.axis = max_direction(second);
  const Vec2d across(-frame.axis[1], frame.axis[0]);
  double skew = 0, skew_across = 0, size = 0;  // third moments tell one end of the axis from the other
  for (size_t i = 0; i < n; ++i) {
    const double length = (place(i + 1) - place(i)).norm();
    const Vec2d p = 0.5 * (place(i) + place(i + 1)) - frame.centre;
    skew += length * std::pow(p | frame.axis, 3);
    skew_across += length * std::pow(p | across, 3);
    size += length * std::pow(p.norm(), 3);
  }
  if (std::abs(skew) < 1e-6 * size) skew = skew_across;
  if (skew < 0) frame.axis = -frame.axis;
  return frame;
}

std::string where(const Patch& patch, int triangle) {
  const Vec3d p =
      patch.origin + patch.points[static_cast<size_t>(patch.triangles[static_cast<size_t>(triangle)][0])];
  return "at (" + std::to_string(p[0]) + ", " + std::to_string(p[1]) + ", " + std::to_string(p[2]) + ")";
}

}  // namespace

std::vector<Vec2d> valid_map(const Patch& patch, FlattenReport& report, const Progress& progress) {
  const auto shapes = triangle_shapes(patch);
  for (const double roundness : {0.0, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9}) {
    auto map = boundary_first_map(patch, shapes, roundness);
    report_progress(progress, 0.6);
    report.border_roundness = roundness;
    report.repaired_triangles = invalid_triangles(patch, map).size();
    if (!repair(patch, shapes, map)) break;
    if (border_is_simple(patch, map)) return map;
  }
  report.free_boundary = false;
  report.border_roundness = 1;
  auto map = disc_map(patch, shapes);
  report.repaired_triangles = invalid_triangles(patch, map).size();
  if (repair(patch, shapes, map) && border_is_simple(patch, map)) return map;
  const auto invalid = invalid_triangles(patch, map);
  throw CannotProcess(
      "no one-to-one conformal map of the patch was found: " + std::to_string(invalid.size()) +
      " triangle(s) stay flipped or too small for double precision" +
      (invalid.empty() ? std::string() : ", the first one " + where(patch, invalid.front())) +
      "; cut long features off, or the patch into shorter ones");
}

std::optional<std::vector<Vec2d>> free_map(const Patch& patch, FlattenReport& report) {
  constexpr size_t kFew = 8;  // and one in a hundred: more are no slip of the discretization
  const auto shapes = triangle_shapes(patch);
  auto map = boundary_first_map(patch, shapes);
  report.repaired_triangles = invalid_triangles(patch, map).size();
  if (report.repaired_triangles > kFew + patch.triangles.size() / 100) return std::nullopt;
  if (!repair(patch, shapes, map) || !border_is_simple(patch, map)) return std::nullopt;
  return map;
}

std::vector<TriangleJacobian> jacobians(const Patch& patch, const std::vector<Vec2d>& map) {
  std::vector<TriangleJacobian> result(patch.triangles.size());
  tbb::parallel_for(size_t{0}, result.size(), [&](size_t f) {
    const auto& t = patch.triangles[f];
    const auto a = static_cast<size_t>(t[0]), b = static_cast<size_t>(t[1]), c = static_cast<size_t>(t[2]);
    result[f] = triangle_jacobian(patch.points[a], patch.points[b], patch.points[c], map[a], map[b], map[c]);
  });
  return result;
}

void normalize(const Patch& patch, std::vector<Vec2d>& map) {
  double plane = 0, surface = 0;
  for (size_t t = 0; t < patch.triangles.size(); ++t) {
    plane += signed_area(patch, map, t);
    const auto& p = patch.points;
    const auto& c = patch.triangles[t];
    surface += 0.5 * ((p[static_cast<size_t>(c[1])] - p[static_cast<size_t>(c[0])]) %
                      (p[static_cast<size_t>(c[2])] - p[static_cast<size_t>(c[0])]))
                         .norm();
  }
  const auto frame = border_frame(patch, map);
  const double scale = std::sqrt(surface / plane);
  for (Vec2d& p : map) {
    const Vec2d q = p - frame.centre;
    p = scale * Vec2d(q | frame.axis, cross2(frame.axis, q));
  }
}

std::vector<double> area_stretches(const Patch& patch, const std::vector<TriangleJacobian>& faces) {
  std::vector<double> plane(patch.points.size(), 0.0), surface(patch.points.size(), 0.0);
  for (size_t t = 0; t < faces.size(); ++t) {
    const double in_plane =
        faces[t].area * (std::norm(faces[t].conformal) - std::norm(faces[t].anticonformal));
    for (const int v : patch.triangles[t]) {
      plane[static_cast<size_t>(v)] += in_plane;
      surface[static_cast<size_t>(v)] += faces[t].area;
    }
  }
  for (size_t v = 0; v < plane.size(); ++v)  // a star without area on the surface: the mean of the whole map
    plane[v] = surface[v] > 0 ? plane[v] / surface[v] : 1;
  return plane;
}

void measure(const std::vector<TriangleJacobian>& faces, const std::vector<double>& stretch,
             FlattenReport& report) {
  double sum = 0, area = 0;
  for (const auto& j : faces) {
    if (!(j.area > 0)) continue;
    const double conformal = std::abs(j.conformal), rest = std::abs(j.anticonformal);
    const double ratio = (conformal + rest) / (conformal - rest);
    sum += j.area * ratio;
    area += j.area;
    report.max_conformal_distortion = std::max(report.max_conformal_distortion, ratio);
  }
  report.mean_conformal_distortion = sum / area;
  const auto [low, high] = std::minmax_element(stretch.begin(), stretch.end());
  report.min_area_stretch = *low;
  report.max_area_stretch = *high;
}

}  // namespace anisomesh::detail
