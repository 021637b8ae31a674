// From lines to polygons.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>
#include <vector>

#include "anisomesh/progress.hh"
#include "anisomesh/surface.hh"

namespace anisomesh {

/// Why an output vertex is there.
enum class Origin { crossing = 0, feature = 1, corner = 2, border = 3, isotropic = 4, line = 5 };

/// What an output edge is.
enum class EdgeKind { min = 0, max = 1, feature = 2, border = 3, conforming = 4 };

struct MeshOptions {
  int max_degree =
      4;  ///< split polygons until none has more corners; >= 3; 0: leave them as extracted ("--polygons")
  bool convex = true;                ///< split polygons until each is convex
  bool flip_edges = true;            ///< flip edges at isotropic samples where it lowers the error
  double corner_angle_degrees = 45;  ///< as in feature_skeleton()
  /// A chain of samples may be straightened as long as they stay this near to it, in units of the epsilon the
  /// lines were traced with; infinite: straighten wherever it is planar, as the paper does; >= 0
  double chain_tolerance = 2.6;
  /// A cell that lies this near to the surface does without its isotropic samples, one that lies farther away
  /// gets further ones, in the same units; infinite: all samples are used as they are; >= 0.
  /// 0: what the trace stage has recorded, 2 where epsilon was given and 4 where it was found for a target
  double cell_tolerance = 0;
  /// What an edge that is no line costs for lying in the middle between two principal directions, where a
  /// square costs 1: more turns these edges and takes a little error; >= 0
  double alignment_weight = 1;
  /// The vertices will be moved by fit_vertices(), which takes out much of what wider tolerances cost: edges
  /// follow the directions better and more polygons are quads with 1.5 times chain_tolerance, 2 times
  /// cell_tolerance and 4 times alignment_weight. The search for a count ends farther from it, as the balance
  /// makes up for the rest. remesh() sets it where it fits
  bool for_fit = false;
  /// Features are followed this nearly, whatever epsilon is, fraction of the diagonal; >= 0.
  /// 0: what the feature stage has recorded, 4.8e-4 of the extent for features that were asked for and no
  /// bound for those that it found by itself
  double feature_tolerance = 0;
  bool join_lines = true;        ///< two triangles may become a quad across an edge of a line (max_degree 4)
  double merge_fraction = 0.2;   ///< contract edges shorter than this fraction of those they continue; [0, 1)
  double max_bend_degrees = 60;  ///< split quads that are bent more along a diagonal; (0, 180]
  void validate() const;         ///< \throw InvalidOption
};

struct MeshReport {
  size_t vertices = 0, faces = 0, quads = 0, triangles = 0;
  size_t crossings = 0;     ///< intersections of lines found
  size_t trimmed = 0;       ///< samples removed as dangling or isolated
  size_t straightened = 0;  ///< samples removed on chains
  size_t merged = 0;        ///< edges contracted because they were too short for their place
  size_t added_samples = 0, dropped_samples = 0;  ///< isotropic samples, by cell_tolerance
  size_t convexity_splits = 0, conforming_edges = 0;
  size_t retries = 0;  ///< passes with half the tolerances, because a polygon would have been folded
  double arrangement_seconds = 0, decimation_seconds = 0, polygon_seconds = 0;
  double seconds = 0;
};

/// Builds the polygonal mesh from the lines, samples and features on the surface. [ACDLD03, section 4]
/// Works in the plane where the mesh carries uv, and otherwise on the surface itself, of any topology.
/// Reads: uv, the lines and isotropic samples, edge feature status. Writes nothing on the input; the result
/// carries origin, source_face, source_barycentric and edge_kind (properties.hh), and edge feature status.
/// \throw InvalidOption, InvalidInput, CannotProcess, Cancelled
OpenMesh::PolyMesh build_polygons(const SurfaceRef& surface, const MeshOptions& options = {},
                                  MeshReport* report = nullptr, const Progress& progress = {});

}  // namespace anisomesh
