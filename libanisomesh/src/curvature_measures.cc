#include "curvature_measures.hh"

#include <algorithm>
#include <cmath>

#include "numerics/ball_clip.hh"

namespace anisomesh::detail {

namespace {

/// A face whose height is below this fraction of its longest edge has no normal worth the name.
constexpr double degenerate_height = 1e-10;

}  // namespace

Vec3d area_vector(const SurfaceArrays& surface, int face) {
  const Vec3d a = surface.corner_point(face, 1) - surface.corner_point(face, 0);
  const Vec3d b = surface.corner_point(face, 2) - surface.corner_point(face, 0);
  const Vec3d vector = a % b;
  const double longest = std::max({a.sqrnorm(), b.sqrnorm(), (a - b).sqrnorm()});
  return vector.norm() > degenerate_height * longest ? vector : Vec3d(0, 0, 0);
}

CornerNormals::CornerNormals(const SurfaceArrays& surface)
    : sector(static_cast<size_t>(surface.n_faces())),
      normals(static_cast<size_t>(surface.n_vertices()), Vec3d(0, 0, 0)),
      vertex_normals(normals) {
  // Weights 2A / (|a|^2 |b|^2), a and b the edges at the corner: exact on a sphere, whatever the triangles.
  // [Max 1999, "Weights for computing vertex normals from facet normals"]
  const auto weighted = [&](int face, int corner) {
    const Vec3d vector = area_vector(surface, face);
    const Vec3d& p = surface.corner_point(face, corner);
    const double lengths = (surface.corner_point(face, (corner + 1) % 3) - p).sqrnorm() *
                           (surface.corner_point(face, (corner + 2) % 3) - p).sqrnorm();
    return lengths > 0 ? Vec3d(vector / lengths) : Vec3d(0, 0, 0);
  };
  std::vector<int> pending;
  std::vector<char> done;
  for (int v = 0; v < surface.n_vertices(); ++v) {
    const int* star = surface.star_of(v);
    const int size = surface.star_size(v);
    done.assign(static_cast<size_t>(size), 0);
    for (int first = 0; first < size; ++first) {
      if (done[static_cast<size_t>(first)]) continue;
      size_t id = static_cast<size_t>(v);
      if (first > 0) {
        id = normals.size();
        normals.emplace_back(0, 0, 0);
      }
      pending.assign(1, first);
      done[static_cast<size_t>(first)] = 1;
      for (size_t next = 0; next < pending.size(); ++next) {
        const int face = star[pending[next]], corner = surface.corner_of(face, v);
        sector[static_cast<size_t>(face)][static_cast<size_t>(corner)] = static_cast<int>(id);
        normals[id] += weighted(face, corner);
        for (const int side : {corner, (corner + 2) % 3}) {
          const int other = surface.neighbours[static_cast<size_t>(face)][static_cast<size_t>(side)];
          const int where = static_cast<int>(std::find(star, star + size, other) - star);
          if (other < 0 || where == size || done[static_cast<size_t>(where)]) continue;
          done[static_cast<size_t>(where)] = 1;
          pending.push_back(where);
        }
      }
      vertex_normals[static_cast<size_t>(v)] += normals[id].normalize_cond();
    }
    if (!(vertex_normals[static_cast<size_t>(v)].normalize_cond().sqrnorm() > 0.5))
      vertex_normals[static_cast<size_t>(v)] = Vec3d(0, 0, 1);
  }
}

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
    for (int f = 0; f < surface.n_faces(); ++f) measure_normal_cycle(f);
  } else {
    for (int f = 0; f < surface.n_faces(); ++f) measure_corrected(f, normals);
  }
}

/// Each face has half of each of its edges. [Cohen-Steiner and Morvan 2003; ACDLD03, equation 1]
void CurvatureMeasures::measure_normal_cycle(int face) {
  const auto f = static_cast<size_t>(face);
  whole_[f].area = areas_[f];
  const Vec3d normal = area_vector(surface_, face);
  for (int i = 0; i < 3; ++i) {
    const int other = surface_.neighbours[f][static_cast<size_t>(i)];
    if (other < 0 || areas_[f] == 0 || areas_[static_cast<size_t>(other)] == 0) continue;
    const Vec3d edge = surface_.corner_point(face, (i + 1) % 3) - surface_.corner_point(face, i);
    const double length = edge.norm();
    const Vec3d other_normal = area_vector(surface_, other);
    const double angle = std::atan2(((normal % other_normal) | edge) / length, normal | other_normal);
    angles_[f][static_cast<size_t>(i)] = angle;
    whole_[f].tensor += (0.5 * angle / length) * outer(edge);
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
  whole_[f].area = 0.5 * (mean | (a % b));
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
        (0.5 * angles_[f][i] * length_in_ball(p[i], p[(i + 1) % 3], radius) / edge.sqrnorm()) * outer(edge);
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
