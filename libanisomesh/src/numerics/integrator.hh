// One step of an embedded Runge-Kutta method for a direction field in the plane.
#pragma once

#include <OpenMesh/Core/Geometry/VectorT.hh>

namespace anisomesh::detail {

using OpenMesh::Vec2d;

struct EmbeddedStep {
  Vec2d offset{0, 0};  ///< from the start of the step to its end
  double error = 0;    ///< distance of the results of order five and four
};

/// A step of length h along a field of unit vectors: order five with an error estimate of order four.
/// [Cash and Karp 1990; Press et al., Numerical Recipes, section 16.2]
/// \param field the direction at an offset from the start; \param first field at the start
template <class Field>
EmbeddedStep cash_karp_step(const Field& field, const Vec2d& first, double h) {
  const Vec2d& k1 = first;
  const Vec2d k2 = field(h * (1.0 / 5 * k1));
  const Vec2d k3 = field(h * (3.0 / 40 * k1 + 9.0 / 40 * k2));
  const Vec2d k4 = field(h * (3.0 / 10 * k1 - 9.0 / 10 * k2 + 6.0 / 5 * k3));
  const Vec2d k5 = field(h * (-11.0 / 54 * k1 + 5.0 / 2 * k2 - 70.0 / 27 * k3 + 35.0 / 27 * k4));
  const Vec2d k6 = field(h * (1631.0 / 55296 * k1 + 175.0 / 512 * k2 + 575.0 / 13824 * k3 +
                              44275.0 / 110592 * k4 + 253.0 / 4096 * k5));
  const Vec2d fifth = 37.0 / 378 * k1 + 250.0 / 621 * k3 + 125.0 / 594 * k4 + 512.0 / 1771 * k6;
  const Vec2d fourth =
      2825.0 / 27648 * k1 + 18575.0 / 48384 * k3 + 13525.0 / 55296 * k4 + 277.0 / 14336 * k5 + 1.0 / 4 * k6;
  return {h * fifth, h * (fifth - fourth).norm()};
}

}  // namespace anisomesh::detail
