#include "curvature/noise.hh"

#include <algorithm>
#include <cmath>

#include "curvature/curvature_measures.hh"

namespace anisomesh::detail {

namespace {

constexpr double kDefaultRadius = 0.0125, kLargestRadius = 0.075;  // fractions of the extent
constexpr double kNormalFraction = 1.0 / 3;
constexpr double kTolerated = 0.15;  // relative error of the curvature in balls of the default radius
constexpr double kLeft = 0.2;     // of the noise of normals, once they are averaged over a third of the ball
constexpr double kWanted = 0.02;  // relative error that larger balls are to leave
constexpr int kMostPasses = 300, kFewestPasses = 6;

double total_area(const SurfaceArrays& surface) {
  double sum = 0;
  for (int f = 0; f < surface.n_faces(); ++f) sum += 0.5 * area_vector(surface, f).norm();
  return sum;
}

/// Edge length of as many equilateral triangles with the same area.
double mean_edge(const SurfaceArrays& surface) {
  return std::sqrt(4 / std::sqrt(3.0) * total_area(surface) / surface.n_faces());
}

/// Area-weighted mean angle, in radians, between the normals of faces and those of a smoother field.
double mean_tilt(const SurfaceArrays& surface, const CornerNormals& rough, const CornerNormals& smooth) {
  double sum = 0, total = 0;
  for (int f = 0; f < surface.n_faces(); ++f) {
    const double area = area_vector(surface, f).norm();
    for (int i = 0; i < 3; ++i) {
      const Vec3d &a = rough.at(f, i), &b = smooth.at(f, i);
      sum += area * std::atan2((a % b).norm(), a | b);
      total += area;
    }
  }
  return total > 0 ? sum / total : 0;
}

/// Area-weighted mean size of the curvature tensor, 1/length.
double mean_curvature(const SurfaceArrays& surface, const CornerNormals& normals) {
  const CurvatureMeasures measures(surface, normals, CurvatureEstimator::corrected_normal_current);
  double sum = 0, area = 0;
  for (int f = 0; f < surface.n_faces(); ++f) {
    const Vec6d& t = measures.whole(f).tensor;
    sum += std::sqrt(t[0] * t[0] + t[3] * t[3] + t[5] * t[5] + 2 * (t[1] * t[1] + t[2] * t[2] + t[4] * t[4]));
    area += measures.whole(f).area;
  }
  return area > 0 ? sum / area : 0;
}

}  // namespace

int smoothing_passes(const SurfaceArrays& surface, double radius) {
  if (!(radius > 0)) return 0;
  const double edges = radius / mean_edge(surface);
  return static_cast<int>(std::lround(std::min<double>(2.5 * edges * edges, kMostPasses)));
}

// The mean change of normals over a disc of radius r is a sum around its rim: of 2 pi r / h normals, h the
// edge length, each off by the tilt t. So curvature is off by about 0.8 t sqrt(h / r) / r
// (docs/curvature.md).
NoiseChoice choose_by_noise(const SurfaceRef& surface) {
  const SurfaceArrays arrays(surface);
  const double edge = mean_edge(arrays), radius = kDefaultRadius * surface.extent();
  const CornerNormals rough(arrays),
      smoothed(arrays, std::max(kFewestPasses, smoothing_passes(arrays, radius)));
  NoiseChoice choice;
  const double bending = mean_curvature(arrays, smoothed);
  const double ball = std::max(radius, 1.5 * edge);
  if (!(bending > 0)) return choice;
  // Smoothing the normals of a curved surface tilts them too, by what they differ over an edge squared.
  const double tilt = mean_tilt(arrays, rough, CornerNormals(arrays, 1));
  choice.noise = 0.8 * tilt * std::sqrt(edge / ball) / (ball * bending);
  if (choice.noise <= kTolerated) return choice;
  choice.normal_fraction = kNormalFraction;
  choice.radius_fraction = std::clamp(kDefaultRadius * std::pow(kLeft * choice.noise / kWanted, 2.0 / 3),
                                      kDefaultRadius, kLargestRadius);
  return choice;
}

}  // namespace anisomesh::detail
