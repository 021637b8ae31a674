// The cells that the edges of the decimated network enclose, before they become polygons.
#pragma once

#include <array>
#include <vector>

#include "mesher/region_mesher.hh"

namespace anisomesh::detail {

/// Corners are nodes of the network, counter-clockwise.
struct Cell {
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> sides;  ///< edges of the network around the triangles, these on their left
  std::vector<int> samples;               ///< isotropic, inside
  bool holds_samples = false;             ///< the triangles have the samples among their corners
  std::vector<Probe> probes;
  std::vector<std::array<int, 2>> forbidden;  ///< corners that are joined elsewhere, on the surface only
};

/// The nodes around a cell, in order; none if its sides are not one loop that passes each node once.
std::vector<int> loop_around(const Cell& cell);

}  // namespace anisomesh::detail
