#include "field/umbilic_analysis.hh"

#include <algorithm>
#include <cmath>

#include "numerics/tensor2d.hh"

namespace anisomesh::detail {

namespace {

constexpr double pi = 3.14159265358979323846;

/// Derivatives of the deviator (alpha, beta) by u and v.
struct Gradient {
  double alpha_u = 0, alpha_v = 0, beta_u = 0, beta_v = 0;
};

Gradient gradient(const std::array<Vec2d, 3>& corners, const std::array<Vec3d, 3>& tensors) {
  const Vec2d e1 = corners[1] - corners[0], e2 = corners[2] - corners[0];
  const Vec2d d1 = deviator(tensors[1] - tensors[0]), d2 = deviator(tensors[2] - tensors[0]);
  const double doubled_area = cross2(e1, e2);
  if (!(doubled_area > 0)) return {};
  const Vec2d by_u = (d1 * e2[1] - d2 * e1[1]) / doubled_area,
              by_v = (d2 * e1[0] - d1 * e2[0]) / doubled_area;
  return {by_u[0], by_v[0], by_u[1], by_v[1]};
}

/// On the ray at this angle: the sine-like part is 0 where a line runs straight along the ray, and the
/// cosine-like part is then positive for max lines, negative for min lines.
struct RayField {
  double across, along;
};

RayField on_ray(const Gradient& g, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const double alpha = g.alpha_u * c + g.alpha_v * s, beta = g.beta_u * c + g.beta_v * s;
  const double c2 = std::cos(2 * angle), s2 = std::sin(2 * angle);
  return {beta * c2 - alpha * s2, alpha * c2 + beta * s2};
}

/// Angles in [0, pi) where `across` vanishes. It is a sum of first and third harmonics, the cubic in the
/// tangent without its pole:
///   across = A cos t + B sin t + C cos 3t + D sin 3t
std::vector<double> straight_angles(const Gradient& g) {
  constexpr int steps = 180;  // far below the distance of two roots, except where they are about to meet
  std::vector<double> roots;
  double previous = on_ray(g, 0).across;
  for (int i = 0; i < steps; ++i) {
    double low = pi * i / steps, high = pi * (i + 1) / steps;
    const double next = on_ray(g, high).across;
    if (previous == 0) {
      roots.push_back(low);
    } else if (previous * next < 0) {
      double at_low = previous;
      for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high), value = on_ray(g, middle).across;
        if ((value > 0) == (at_low > 0)) {
          low = middle;
          at_low = value;
        } else {
          high = middle;
        }
      }
      roots.push_back(0.5 * (low + high));
    }
    previous = next;
  }
  return roots;
}

/// Of three rays the one that lies between the two others: that whose neighbours are nearest to it in sum.
double middle_ray(const std::vector<double>& rays) {
  const auto distance = [](double a, double b) {
    const double d = std::fmod(std::abs(a - b), 2 * pi);
    return std::min(d, 2 * pi - d);
  };
  double best = rays.front(), least = 4 * pi;
  for (const double ray : rays) {
    double sum = 0;
    for (const double other : rays) sum += distance(ray, other);
    if (sum < least) {
      least = sum;
      best = ray;
    }
  }
  return best;
}

}  // namespace

// The winding number of the deviators around 0, by crossings of the positive alpha axis. Ties are those of a
// zero moved by an infinitesimal amount, first along alpha, then along beta; the cross product is always
// taken from the lower to the upper end, so that both directions of an edge agree to the last bit.
int doubled_index_of_edge(const Vec2d& a, const Vec2d& b) {
  const bool a_up = a[1] > 0, b_up = b[1] > 0;
  if (a_up == b_up) return 0;
  const Vec2d &low = a_up ? b : a, &high = a_up ? a : b;
  if (!(cross2(low, high) > 0)) return 0;
  return b_up ? 1 : -1;
}

int doubled_index(const std::array<Vec2d, 3>& deviators) {
  return doubled_index_of_edge(deviators[0], deviators[1]) +
         doubled_index_of_edge(deviators[1], deviators[2]) +
         doubled_index_of_edge(deviators[2], deviators[0]);
}

Vec3d degenerate_point(const std::array<Vec2d, 3>& deviators) {
  Vec3d weights(cross2(deviators[1], deviators[2]), cross2(deviators[2], deviators[0]),
                cross2(deviators[0], deviators[1]));
  if (weights[0] + weights[1] + weights[2] < 0) weights = -weights;
  for (size_t i = 0; i < 3; ++i) weights[i] = std::max(weights[i], 0.0);
  const double sum = weights[0] + weights[1] + weights[2];
  return sum > 0 ? weights / sum : Vec3d(1.0 / 3, 1.0 / 3, 1.0 / 3);
}

Separatrices separatrices(const std::array<Vec2d, 3>& corners, const std::array<Vec3d, 3>& tensors,
                          LineKind kind) {
  const Gradient g = gradient(corners, tensors);
  std::vector<double> rays;
  for (const double angle : straight_angles(g)) {
    const bool max_ray = on_ray(g, angle).along > 0;
    rays.push_back(max_ray == (kind == LineKind::max) ? angle : angle + pi);
  }
  Separatrices result;
  if (rays.empty()) return result;
  const bool wedge = g.alpha_u * g.beta_v - g.alpha_v * g.beta_u > 0;
  if (wedge && rays.size() > 1) rays.assign(1, middle_ray(rays));
  std::sort(rays.begin(), rays.end());
  for (const double ray : rays)
    if (result.count < 3) result.angle[static_cast<size_t>(result.count++)] = ray;
  return result;
}

}  // namespace anisomesh::detail
