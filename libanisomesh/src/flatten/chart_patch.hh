// Some faces of a surface as a patch of their own.
#pragma once

#include <array>
#include <vector>

#include "anisomesh/surface.hh"
#include "numerics/patch.hh"

namespace anisomesh::detail {

/// The sides of all faces: side 3 f + i goes from corner i of face f to the next one.
struct FaceSides {
  explicit FaceSides(const SurfaceRef& surface);
  std::vector<int> twin;      ///< the side across; -1 on the border
  std::vector<char> feature;  ///< of each side
  std::vector<int> vertex;    ///< of each corner, 3 f + i
};

inline int next_side(int side) { return side % 3 == 2 ? side - 2 : side + 1; }
inline int previous_side(int side) { return side % 3 == 0 ? side + 2 : side - 1; }

/// A connected part of a surface, to become a chart.
struct Region {
  std::vector<int> faces;  ///< ascending
  std::vector<int> slits;  ///< sides that it is cut open along, ascending; with each its twin
};

/// The place of a face in a list of faces, or -1.
int place_among(const std::vector<int>& faces, int face);

/// A region cut out of its surface: a vertex that it touches several times is as many points.
struct ChartPatch {
  ChartPatch(const SurfaceRef& surface, const FaceSides& sides, const Region& region);
  Patch patch;  ///< triangle i is face i of the region; its border is that of the first loop
  std::vector<std::vector<int>> loops;  ///< sides of the surface, each with the region on its left
  long euler = 0;
  bool is_disc() const { return loops.size() == 1 && euler == 1; }
};

/// The shortest way over edges from one border loop of a patch to the other: sides and twins, ascending.
/// \pre two loops
std::vector<int> shortest_slit(const FaceSides& sides, const Region& region, const ChartPatch& patch);

}  // namespace anisomesh::detail
