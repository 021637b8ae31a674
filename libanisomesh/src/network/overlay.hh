// The lines, samples, features and the border drawn on the triangles of the surface themselves: every
// triangle is divided along what crosses it. The arrangement of the paper's section 4.1, on the manifold.
#pragma once

#include <array>
#include <vector>

#include "anisomesh/lines.hh"
#include "anisomesh/mesher.hh"

namespace anisomesh::detail {

/// A triangulation of the whole surface that has all lines among its edges. Nodes 0 to n - 1 are the n
/// vertices of the surface.
struct Overlay {
  std::vector<SurfacePoint> points;  ///< of each node
  std::vector<Origin> origins;       ///< of each node
  std::vector<char> fixed;           ///< of each node: not to be removed (corners, isotropic samples)
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> faces;  ///< of the surface, that each triangle is part of
  struct Drawn {
    std::array<int, 2> node;  ///< ascending
    int kind;                 ///< EdgeKind
  };
  std::vector<Drawn> edges;  ///< those that are part of a line, a feature or the border; each once
  std::vector<int>
      left_out;          ///< the face of each point of a line that is no node, as the line is straight there
  size_t crossings = 0;  ///< of two lines
};

/// Crossings are found once, by exact predicates in the barycentric coordinates of the triangle they lie in.
/// A step of a line that no path leads along is left out.
/// \param kept_faces of the surface, by face: no line enters them nor ends on their edges, which are all
/// drawn (as conforming, where they are no features) between vertices that stay; empty: none
Overlay overlay_lines(const SurfaceRef& surface, const LineNetwork& lines, double corner_angle_degrees,
                      const std::vector<char>& kept_faces = {});

}  // namespace anisomesh::detail
