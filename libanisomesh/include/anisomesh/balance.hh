// Vertices taken from where they buy little to where they buy much.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>
#include <limits>

#include "anisomesh/fit.hh"
#include "anisomesh/progress.hh"
#include "anisomesh/surface.hh"

namespace anisomesh {

struct BalanceOptions {
  /// Of moves, each after a few passes of the fit, and up to three more where there are over 5 % too many by
  /// then; 0: the fit alone; >= 0.
  int rounds = 2;
  /// So many vertices in the end, as far as the moves can; 0: as many as the search for a count was to find,
  /// where it left that to the balance (properties target_vertices and target_faces), else as many as there
  /// are
  size_t target_vertices = 0;
  /// What a triangle costs on top of its error, in mean errors of a polygon: more keeps more quads; >= 0
  double triangle_cost = 0.8;
  /// What a side of mean length costs that lies diagonally to the principal directions, in the same unit, and
  /// up to 2.75 times that as for FitOptions::alignment_weight; >= 0
  double alignment_cost = 1.5;
  /// At last quads are split whose two triangles' normals are nearer to the input's, by so many times what a
  /// polygon is off on the mean; 0: all that gain, infinite: none; >= 0
  double split_gain = std::numeric_limits<double>::infinity();
  double least_quads = 0.76;  ///< ... as long as this share of the polygons is quads; [0, 1]
  int max_degree = 4;         ///< 3: makes no quads; other than 3 and 4: no polygon is changed
  void validate() const;      ///< \throw InvalidOption
};

struct BalanceReport {
  FitReport fit;                  ///< of all rounds
  size_t parted = 0;              ///< groups of polygons partitioned anew
  size_t removed = 0, added = 0;  ///< vertices
  size_t split = 0;               ///< quads, at last
  double seconds = 0;
};

/// Changes the connectivity where that lowers the error of the fitted result: polygons are partitioned anew,
/// vertices removed where they buy least and added where the error is largest.
/// Reads: as fit_vertices(), target_vertices, target_faces. Writes: `result`, all of it, with the properties
/// that build_polygons() gives it. \pre as fit_vertices() \throw as fit_vertices()
BalanceReport balance_vertices(const SurfaceRef& surface, OpenMesh::PolyMesh& result,
                               const BalanceOptions& options = {}, const FitOptions& fit = {},
                               const Progress& progress = {});

}  // namespace anisomesh
