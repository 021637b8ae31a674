// A surface ruled in closed form.
#pragma once

#include <cmath>

#include "anisomesh/shapes.hh"

/// Half of the hyperboloid of one sheet x^2 + y^2 = 1 + z^2, |z| < sinh 1: one disc. Through each point go
/// two straight lines, its asymptotic lines.
inline anisomesh::ParametricPatch half_hyperboloid() {
  anisomesh::ParametricPatch patch;
  patch.position = [](double around, double up) {
    return anisomesh::Vec3d(std::cosh(up) * std::cos(around), std::cosh(up) * std::sin(around),
                            std::sinh(up));
  };
  patch.u_max = 3.14159265358979323846;
  patch.v_min = -1;
  return patch;
}
