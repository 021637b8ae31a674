#include "curvature/curvature_measures.hh"

#include <algorithm>
#include <cmath>

#include "numerics/ball_clip.hh"

namespace anisomesh::detail {

CurvatureMeasures::CurvatureMeasures(const SurfaceArrays& surface, const CornerNormals& normals,
                                     CurvatureEstimator estimator)
    : surface_(surface),
      estimator_(estimator),
      whole_(static_cast<size_t>(surface.n_faces())),
      areas_(whole_.size()) {
  for (int f = 0; f < surface.n_faces(); ++f) {
    areas_[static_cast<size_t>(f)] = 0.5 * area_vector(surface, f).norm();
    degenerate_faces_ += areas_[static_cast<size_t>(f)] == 0;
  }
  if (estimator == CurvatureEstimator::normal_cycle) {
    angles_.assign(whole_.size(), {0, 0, 0});
    for (int f = 0; f < surface.n_faces(); ++f) measure_normal_cycle(f, normals);
  } else {
    for (int f = 0; f < surface.n_faces(); ++f) measure_corrected(f, normals);
  }
}

/// Each face has half of the angle of each of its edges. Over a wall there is no other half; this one's is
/// the angle from the face to the normals at the ends of the edge. [Cohen-Steiner and Morvan 2003; ACDLD03,
/// equation 1]
void CurvatureMeasures::measure_normal_cycle(int face, const CornerNormals& normals) {
  const auto f = static_cast<size_t>(face);
  whole_[f].area = areas_[f];
  if (areas_[f] == 0) return;
  const Vec3d normal = area_vector(surface_, face);
  for (int i = 0; i < 3; ++i) {
    const int other = surface_.neighbours[f][static_cast<size_t>(i)], next = (i + 1) % 3;
    if (other >= 0 && areas_[static_cast<size_t>(other)] == 0) continue;
    const Vec3d edge = surface_.corner_point(face, next) - surface_.corner_point(face, i);
    const double length = edge.norm();
    const Vec3d outside =
        other >= 0 ? area_vector(surface_, other) : normals.at(face, i) + normals.at(face, next);
    const double angle = std::atan2(((normal % outside) | edge) / length, normal | outside);
    const double half = other >= 0 ? 0.5 * angle : angle;
    angles_[f][static_cast<size_t>(i)] = half;
    whole_[f].tensor += (half / length) * outer(edge);
  }
}

/// mu_0 and the anisotropic measure mu_XY of a triangle with interpolated corner normals. [Lachaud, Romon,
/// Thibert, Coeurjolly 2020, "Interpolated corrected curvature measures for polygonal surfaces"]
void CurvatureMeasures::measure_corrected(int face, const CornerNormals& normals) {
  const auto f = static_cast<size_t>(face);
  if (areas_[f] == 0) return;
  const Vec3d& u = normals.at(face, 0);
  const Vec3d &v = normals.at(face, 1), &w = normals.at(face, 2);
  const Vec3d a = surface_.corner_point(face, 1) - surface_.corner_point(face, 0);
  const Vec3d b = surface_.corner_point(face, 2) - surface_.corner_point(face, 0);
  const Vec3d mean = (u + v + w) / 3;
  // Where the normals fold over against the face the measure could vanish: keep it a fair part of the area.
  whole_[f].area = std::max(0.5 * (mean | (a % b)), 0.1 * areas_[f]);
  whole_[f].tensor = 0.5 * (symmetric_outer(b % mean, v - u) - symmetric_outer(a % mean, w - u));
}

Measure CurvatureMeasures::clipped(int face, const Vec3d& centre, double radius) const {
  const auto f = static_cast<size_t>(face);
  Measure result;
  if (areas_[f] == 0) return result;
  const Vec3d p[3] = {surface_.corner_point(face, 0) - centre, surface_.corner_point(face, 1) - centre,
                      surface_.corner_point(face, 2) - centre};
  const double area = area_in_ball(p[0], p[1], p[2], radius);
  if (estimator_ == CurvatureEstimator::corrected_normal_current) {
    const double fraction = area / areas_[f];
    result.area = fraction * whole_[f].area;
    result.tensor = fraction * whole_[f].tensor;
    return result;
  }
  result.area = area;
  for (size_t i = 0; i < 3; ++i) {
    if (angles_[f][i] == 0) continue;
    const Vec3d edge = p[(i + 1) % 3] - p[i];
    result.tensor +=
        (angles_[f][i] * length_in_ball(p[i], p[(i + 1) % 3], radius) / edge.sqrnorm()) * outer(edge);
  }
  return result;
}

Vec3d CurvatureMeasures::curvature(const Measure& sum, const TangentFrame& frame) const {
  if (!(sum.area > 0)) return {0, 0, 0};
  const Vec3d t = in_frame(sum.tensor, frame) / sum.area;
  if (estimator_ == CurvatureEstimator::corrected_normal_current) return t;
  return {t[2], -t[1], t[0]};  // along an edge the normal cycle has the curvature across it: switch
}

}  // namespace anisomesh::detail
