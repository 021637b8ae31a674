// Features: which edges are sharp, and the skeleton of creases and corners they make.
#pragma once

#include <OpenMesh/Core/Mesh/Handles.hh>
#include <utility>
#include <vector>

#include "anisomesh/surface.hh"

namespace anisomesh {

struct FeatureOptions {
  double angle_degrees =
      0;  ///< tag an edge when its faces' normals differ by more than this; 0 tags none by angle; [0, 180)
  /// Where nothing else says what a feature is (no angle, no edges, no tags that are kept): tag what turns by
  /// more than 40 degrees if FeatureReport::is_mechanical(). Such features are followed as nearly as epsilon
  /// asks for, and not to 0.048 % of the extent as those that somebody asked for.
  bool automatic = true;
  std::vector<std::pair<int, int>> edges;  ///< vertex index pairs to tag; each must be an edge of the mesh
  bool keep_existing = true;               ///< keep the tags that are already on the mesh
  void validate() const;                   ///< \throw InvalidOption
};

struct FeatureReport {
  size_t feature_edges = 0;  ///< tagged after the call, border edges not counted
  size_t by_angle = 0;       ///< of these, edges the angle asks for
  double angle_degrees = 0;  ///< that was tagged by; 0: none
  bool automatic = false;    ///< whether these features were found and not asked for
  size_t by_list = 0;        ///< of these, edges of FeatureOptions::edges
  double sharp = 0;          ///< of the length of all edges inside, how much turns by more than 40 degrees
  double rounded = 0;        ///< likewise by 20 to 40 degrees
  size_t corners = 0;        ///< vertices where edges that turn by more than 40 degrees end, meet or turn
  size_t vertices = 0;       ///< of the mesh
  double seconds = 0;
  /// Sharp edges, little in between and long creases, not steps: a part that was made, not grown, scanned or
  /// put together from boxes. Over the 62 meshes of libcgal-demo with 400 to 40,000 triangles this tells them
  /// apart (docs/features.md).
  bool is_mechanical() const {
    return sharp > 0.005 && sharp > 2 * rounded && (corners < 100 || 4 * corners < vertices);
  }
};

/// Tags feature edges in OpenMesh's own feature status (requested if absent). [ACDLD03, section 1.3, 2.5]
/// Reads: points. Writes: status(edge).feature(), feature_tolerance.
/// \throw InvalidOption, InvalidInput (a pair that is no edge of the mesh)
FeatureReport tag_features(const SurfaceRef& surface, const FeatureOptions& options = {});

/// A maximal chain of feature or border edges between two corners, or a closed one without a corner.
struct FeatureCurve {
  std::vector<OpenMesh::HalfedgeHandle> halfedges;  ///< head to tail
  bool closed = false;
  bool border = false;
};

/// The graph of feature curves; border loops belong to it.
struct FeatureSkeleton {
  std::vector<OpenMesh::VertexHandle>
      corners;  ///< valence other than 2 in the graph, or a sharp turn; ascending
  std::vector<FeatureCurve> curves;
};

/// The feature skeleton of the tagged edges and the border. [ACDLD03, section 1.3]
/// \param corner_angle_degrees a vertex of valence 2 whose two edges turn by more than this is a corner
FeatureSkeleton feature_skeleton(const SurfaceRef& surface, double corner_angle_degrees = 45);

/// Whether the edge is on the border or tagged. Safe where the mesh has no edge status.
bool is_feature_or_border(const OpenMesh::TriConnectivity& mesh, OpenMesh::EdgeHandle edge);

}  // namespace anisomesh
