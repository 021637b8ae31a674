// The lines, samples, features and the border of a surface as one planar graph. [ACDLD03, section 4.1]
#pragma once

#include <memory>
#include <vector>

#include "anisomesh/lines.hh"
#include "anisomesh/mesher.hh"
#include "network/uv_locator.hh"
#include "numerics/planar_graph.hh"
#include "surface/surface_normals.hh"

namespace anisomesh::detail {

class FeatureSides;

/// Where no more than this share of the tolerances holds, samples and vertices of the input stay where they
/// are: the last thing that is tried for sound polygons.
constexpr double kept_share = 1.0 / 64;

/// A graph whose nodes are points of the surface. Edge kinds are EdgeKind.
struct NetworkGraph {
  bool planar = true;  ///< drawn in the plane; otherwise on the surface, and uv means nothing
  PlanarGraph graph;
  std::vector<SurfacePoint> points;  ///< of each node
  std::vector<Vec3d> positions;      ///< of each node, model units
  std::vector<Vec3d> normals;        ///< of the surface at each node
  std::vector<Origin> origins;       ///< of each node
  std::vector<char> fixed;           ///< of each node: not to be removed (corners, isotropic samples)
  std::vector<double> share;         ///< of the tolerances that holds at each node; empty: all of them
  std::shared_ptr<const FeatureSides> feature_sides;  ///< once there are cells; none in the plane
  size_t crossings = 0;

  /// Whether an edge of that kind ends at a node.
  bool touches(int node, EdgeKind kind) const {
    for (int e = graph.first_edge(node); e >= 0; e = graph.next_edge(e, node))
      if (graph.edge(e).kind == static_cast<int>(kind)) return true;
    return false;
  }
};

/// \throw CannotProcess if the border or a feature crosses itself in the plane beyond what rounding explains
NetworkGraph arrange_network(const SurfaceRef& surface, const UvLocator& locator,
                             const SurfaceNormals& normals, const LineNetwork& lines,
                             double corner_angle_degrees);

inline bool is_line(int kind) {
  return kind == static_cast<int>(EdgeKind::min) || kind == static_cast<int>(EdgeKind::max);
}

}  // namespace anisomesh::detail
