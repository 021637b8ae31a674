// Errors of an estimated curvature field against the truth; shared by the tests and the convergence
// benchmark.
#pragma once

#include <algorithm>

#include "anisomesh/properties.hh"
#include "shapes.hh"

namespace shapes {

struct CurvatureError {
  double direction_degrees = 0;  ///< area-weighted mean where anisotropy is over 0.1
  double curvature =
      0;  ///< area-weighted mean of the larger error of k_min and k_max, over that of the larger |k|
  double normal_degrees = 0;
  double border_direction_degrees = 0, border_curvature = 0;  ///< the same at the border's vertices
  double worst_curvature = 0;                                 ///< the largest error over the mean larger |k|
};

inline double angle_degrees(const Vec3d& a, const Vec3d& b, bool sign_matters = false) {
  const double dot = a | b;
  return std::atan2((a % b).norm(), sign_matters ? dot : std::abs(dot)) * 180 / pi;
}

inline CurvatureError curvature_error(const Sampled& sampled) {
  using namespace anisomesh;
  const auto& mesh = sampled.mesh;
  const auto normal = require_property(mesh, property::normal),
             gamma = require_property(mesh, property::gamma_min);
  const auto low = require_property(mesh, property::k_min), high = require_property(mesh, property::k_max);
  const auto areas = vertex_areas(mesh);
  CurvatureError e;
  double area[2] = {0, 0}, anisotropic[2] = {0, 0}, directions[2] = {0, 0}, errors[2] = {0, 0},
         sizes[2] = {0, 0};
  double worst = 0;
  for (const auto v : mesh.vertices()) {
    const auto i = static_cast<size_t>(v.idx());
    const Exact& truth = sampled.truth[i];
    const double error = std::max(std::abs(mesh.property(low, v) - truth.k_min),
                                  std::abs(mesh.property(high, v) - truth.k_max));
    worst = std::max(worst, error);
    e.normal_degrees += areas[i] * angle_degrees(mesh.property(normal, v), truth.normal, true);
    for (const int part : {0, 1}) {
      if (part == 1 && !v.is_boundary()) continue;
      area[part] += areas[i];
      errors[part] += areas[i] * error;
      sizes[part] += areas[i] * std::max(std::abs(truth.k_min), std::abs(truth.k_max));
      if (truth.anisotropy() <= 0.1) continue;
      anisotropic[part] += areas[i];
      directions[part] += areas[i] * angle_degrees(mesh.property(gamma, v), truth.gamma_min);
    }
  }
  e.normal_degrees /= area[0];
  e.curvature = errors[0] / sizes[0];
  e.border_curvature = errors[1] / sizes[1];
  e.worst_curvature = worst / (sizes[0] / area[0]);
  if (anisotropic[0] > 0) e.direction_degrees = directions[0] / anisotropic[0];
  if (anisotropic[1] > 0) e.border_direction_degrees = directions[1] / anisotropic[1];
  return e;
}

}  // namespace shapes
