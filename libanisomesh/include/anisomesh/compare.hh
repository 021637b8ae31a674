// The honest ruler: how far a result lies from its reference, and how good its polygons are.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>
#include <map>

#include "anisomesh/progress.hh"
#include "anisomesh/surface.hh"

namespace anisomesh {

/// Which diagonal splits a polygon whose corners lie in no plane; distances are measured on its triangles.
enum class FaceDiagonal {
  shorter,  ///< independent of the order of the corners, and not chosen by looking at the reference
  longer    ///< the other surface the polygon may stand for: says how much the choice matters
};

struct CompareOptions {
  size_t samples = 200000;  ///< points sampled by area on each of the two; >= 1000
  unsigned seed = 1;
  FaceDiagonal diagonal = FaceDiagonal::shorter;
  double anisotropy_threshold =
      0.3;  ///< alignment counts where (|k_max| - |k_min|) / (|k_max| + |k_min|), by magnitude, is above this
  void validate() const;  ///< \throw InvalidOption
};

struct Distances {  ///< fraction of the reference's bounding box diagonal
  double mean = 0, rms = 0, hausdorff = 0;
};

struct Comparison {
  Distances to_reference;                    ///< from samples on the result to the reference
  Distances from_reference;                  ///< from samples on the reference to the result
  Distances two_sided;                       ///< mean and rms over both sample sets, the larger hausdorff
  double p99_fraction = 0;                   ///< 99 % of all samples are nearer than this
  double mean_normal_deviation_degrees = 0;  ///< of polygons, one normal each, of the plane of best fit
  double mean_surface_normal_deviation_degrees = 0;  ///< of the triangles that distances are measured on

  size_t vertices = 0, faces = 0, edges = 0;
  size_t isolated_vertices = 0;  ///< without a face; not counted anywhere else
  std::map<int, size_t> faces_by_degree;
  std::map<int, size_t> vertices_by_valence;
  double quad_fraction = 0;
  double mean_planarity = 0,
         max_planarity = 0;  ///< distance of a corner from the plane of best fit over the face's diameter
  size_t concave_faces = 0;  ///< a corner turns back by more than 5 degrees in the plane of best fit
  size_t folded_faces =
      0;  ///< normal against that of the reference beside it, or two neighbours folded onto each other
  size_t self_intersecting_faces = 0;  ///< cross, overlap or touch a face beyond the corners and sides shared
  size_t degenerate_faces = 0;
  size_t non_manifold_edges = 0, non_manifold_vertices = 0;
  size_t t_junctions = 0;  ///< vertices that lie on an edge they are no end of
  int components = 0, euler_characteristic = 0, border_loops = 0;
  bool same_topology = false;  ///< components, Euler characteristic and border loops of the reference
  double mean_alignment_degrees =
      0;  ///< length-weighted mean angle of edges to the nearer principal direction; 22.5 by chance
  double aspect_ratio_error = 0;  ///< mean |log2(aspect of a quad / aspect by equation 7)|
  double seconds = 0;
};

/// Compares a polygonal result with the triangle mesh it stands for.
/// Reads: of the reference points, and k_min, k_max, gamma_min, gamma_max where they are there (alignment is
/// 0 without them). Writes on `result`: error (distance of the vertex) and face_error (root of the mean
/// squared distance over the face, both ways), model units. \throw InvalidInput, InvalidOption, Cancelled
Comparison compare(const SurfaceRef& reference, OpenMesh::PolyMesh& result,
                   const CompareOptions& options = {}, const Progress& progress = {});

}  // namespace anisomesh
