#include "field/linear_field.hh"

#include <algorithm>
#include <cmath>

#include "numerics/tensor2d.hh"

namespace anisomesh::detail {

namespace {

// Derivatives of the tensor by the two coordinates.
struct TensorGradient {
  Vec3d x, y;
  explicit TensorGradient(const LinearField& field) {
    const Vec2d u = field.corner[1] - field.corner[0], v = field.corner[2] - field.corner[0];
    const Vec3d du = field.tensor[1] - field.tensor[0], dv = field.tensor[2] - field.tensor[0];
    const double area = cross2(u, v);
    x = (v[1] * du - u[1] * dv) / area;
    y = (u[0] * dv - v[0] * du) / area;
  }
};

// Of three directions the one in the middle, where they lie on one side.
double middle_of_three(const std::vector<double>& angles) {
  double largest_gap = -1;
  size_t after = 0;
  for (size_t i = 0; i < 3; ++i) {
    double gap = angles[(i + 1) % 3] - angles[i];
    if (gap < 0) gap += 2 * M_PI;
    if (gap > largest_gap) largest_gap = gap, after = i;
  }
  return angles[(after + 2) % 3];
}

}  // namespace

Vec3d followed(const Vec3d& tensor, Follow follow) {
  return follow == Follow::min_abs ? turned_to_asymptotic(tensor) : tensor;
}

Orientation orientation(const Vec3d& tensor) {
  double k_min = 0, k_max = 0;
  eigenvalues(tensor, k_min, k_max);
  const double small = std::min(std::abs(k_min), std::abs(k_max)),
               large = std::max(std::abs(k_min), std::abs(k_max));
  const Vec2d d = deviator(tensor);
  return {0.5 * std::atan2(d[1], d[0]), large > 0 ? (large - small) / (large + small) : 0};
}

double turning_length(const LinearField& field, const Vec3d& tensor_here) {
  const TensorGradient g(field);
  const double gradient = std::hypot(deviator_norm(g.x), deviator_norm(g.y));
  return deviator_norm(tensor_here) / gradient;
}

std::vector<Vec2d> separatrix_directions(const LinearField& field, const UmbilicPoint& umbilic, LineKind kind,
                                         Follow follow, double reach) {
  const TensorGradient gradient(field);
  const Vec3d& b = umbilic.point.barycentric;
  const Vec3d there = b[0] * field.tensor[0] + b[1] * field.tensor[1] + b[2] * field.tensor[2];
  const double mean = 0.5 * (there[0] + there[2]);  // all there is at an umbilic, but for rounding
  const auto deviator_at = [&](double angle) {
    const Vec3d ahead = reach * (std::cos(angle) * gradient.x + std::sin(angle) * gradient.y);
    return deviator(followed(Vec3d(mean, 0, mean) + ahead, follow));
  };
  // Along a separatrix the deviator, seen from the umbilic, is an eigenvector of itself: its angle is twice
  // that of the ray, up to a half turn that tells min from max.
  const double sign = kind == LineKind::max ? 1 : -1;
  const auto off_ray = [&](double angle) {
    return sign * cross2(Vec2d(std::cos(2 * angle), std::sin(2 * angle)), deviator_at(angle));
  };
  const auto along = [&](double angle) {
    return sign * (deviator_at(angle) | Vec2d(std::cos(2 * angle), std::sin(2 * angle)));
  };
  std::vector<double> angles;
  constexpr int kSamples = 360;
  const double step = 2 * M_PI / kSamples;
  bool high_negative = off_ray(0) < 0;
  for (int i = 0; i < kSamples; ++i) {
    double low = i * step, high = (i + 1) * step;
    const bool low_negative = high_negative;
    high_negative = off_ray(high) < 0;
    if (low_negative == high_negative) continue;
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (low + high);
      ((off_ray(middle) < 0) == low_negative ? low : high) = middle;
    }
    if (along(low) > 0) angles.push_back(low);
  }
  // A wedge with three rays has them on one side: the middle one stands for them.
  if (umbilic.index > 0 && angles.size() == 3) angles = {middle_of_three(angles)};
  std::vector<Vec2d> directions;
  directions.reserve(angles.size());
  for (const double angle : angles) directions.emplace_back(std::cos(angle), std::sin(angle));
  return directions;
}

}  // namespace anisomesh::detail
