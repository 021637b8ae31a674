// The closed synthetic shapes: sphere, ellipsoid, torus, cube.
#pragma once

#include <array>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "anisomesh/shapes.hh"

namespace anisomesh::detail {

/// A triangulation of a closed surface, oriented outward.
struct ClosedSampling {
  std::vector<Vec3d> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::pair<int, int>> creases;
};

/// Nothing where no closed shape has this name.
std::optional<ClosedSampling> sample_closed_shape(const std::string& name, const ShapeOptions& options,
                                                  std::mt19937& generator);

}  // namespace anisomesh::detail
