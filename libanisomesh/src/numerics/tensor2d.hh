// Symmetric 2x2 tensors, kept as (uu, uv, vv): eigenvalues, eigenvectors, deviator, rotation.
#pragma once

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <cmath>

namespace anisomesh::detail {

using OpenMesh::Vec2d;
using OpenMesh::Vec3d;

/// (alpha, beta) of the deviator (alpha beta; beta -alpha): what is left without the mean of the eigenvalues.
/// [ACDLD03, equation 4]
inline Vec2d deviator(const Vec3d& tensor) { return {0.5 * (tensor[0] - tensor[2]), tensor[1]}; }

/// Half the difference of the eigenvalues, >= 0; 0 at an umbilic.
inline double deviator_norm(const Vec3d& tensor) {
  const Vec2d d = deviator(tensor);
  return std::hypot(d[0], d[1]);
}

struct Eigen2 {
  double min = 0, max = 0;                         ///< eigenvalues, min <= max
  Vec2d direction_min{1, 0}, direction_max{0, 1};  ///< unit eigenvectors, a right-handed pair, sign arbitrary
};

/// Eigenvalues alone.
inline void eigenvalues(const Vec3d& tensor, double& min, double& max) {
  const double mean = 0.5 * (tensor[0] + tensor[2]), radius = deviator_norm(tensor);
  min = mean - radius;
  max = mean + radius;
}

/// Unit eigenvector of the larger eigenvalue; (1, 0) for a multiple of the identity. Exact to rounding for
/// every angle: the half angle of (alpha, beta), from whichever of its two forms loses no digits.
inline Vec2d max_direction(const Vec3d& tensor) {
  const Vec2d d = deviator(tensor);
  const double radius = std::hypot(d[0], d[1]);
  if (!(radius > 0)) return {1, 0};
  const Vec2d v = d[0] >= 0 ? Vec2d(d[0] + radius, d[1]) : Vec2d(d[1], radius - d[0]);
  return v / std::hypot(v[0], v[1]);
}

/// Unit eigenvector of the smaller eigenvalue.
inline Vec2d min_direction(const Vec3d& tensor) {
  const Vec2d v = max_direction(tensor);
  return {v[1], -v[0]};
}

inline Eigen2 eigen_decomposition(const Vec3d& tensor) {
  Eigen2 result;
  eigenvalues(tensor, result.min, result.max);
  result.direction_max = max_direction(tensor);
  result.direction_min = {result.direction_max[1], -result.direction_max[0]};
  return result;
}

/// The tensor min * n n^T + max * m m^T, m the unit direction of `max` and n orthogonal to it.
inline Vec3d tensor_from(double min, double max, const Vec2d& direction_max) {
  const double c = direction_max[0], s = direction_max[1];
  return {min * s * s + max * c * c, (max - min) * c * s, min * c * c + max * s * s};
}

/// R T R^T for the rotation R by the angle of the unit vector (cosine, sine).
inline Vec3d rotated(const Vec3d& tensor, const Vec2d& rotation) {
  const double mean = 0.5 * (tensor[0] + tensor[2]);
  const Vec2d d = deviator(tensor);
  const double c2 = rotation[0] * rotation[0] - rotation[1] * rotation[1], s2 = 2 * rotation[0] * rotation[1];
  const double alpha = c2 * d[0] - s2 * d[1], beta = s2 * d[0] + c2 * d[1];
  return {mean + alpha, beta, mean - alpha};
}

/// The tensor with its eigenvectors turned counter-clockwise by atan(sqrt(|smaller| / |larger eigenvalue|))
/// where the eigenvalues have opposite signs, and as it is elsewhere: continuous, and what was the
/// eigenvector of the eigenvalue nearer to 0 is a direction in which the given tensor is 0.
inline Vec3d turned_to_asymptotic(const Vec3d& tensor) {
  double min = 0, max = 0;
  eigenvalues(tensor, min, max);
  if (!(min < 0 && max > 0)) return tensor;
  const double ratio = -min < max ? -min / max : max / -min;
  return rotated(tensor, Vec2d(1, std::sqrt(ratio)) / std::sqrt(1 + ratio));
}

/// Frobenius norm.
inline double frobenius_norm(const Vec3d& t) {
  return std::sqrt(t[0] * t[0] + 2 * t[1] * t[1] + t[2] * t[2]);
}

/// The z component of the cross product.
inline double cross2(const Vec2d& a, const Vec2d& b) { return a[0] * b[1] - a[1] * b[0]; }

}  // namespace anisomesh::detail
