// All stages in one call, and the search for the epsilon that gives a wanted number of faces.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>
#include <vector>

#include "anisomesh/balance.hh"
#include "anisomesh/curvature.hh"
#include "anisomesh/domain.hh"
#include "anisomesh/features.hh"
#include "anisomesh/fit.hh"
#include "anisomesh/lines.hh"
#include "anisomesh/max_error.hh"
#include "anisomesh/mesher.hh"
#include "anisomesh/smoothing.hh"
#include "anisomesh/umbilics.hh"

namespace anisomesh {

struct TargetOptions {
  size_t target_faces = 0;     ///< about so many faces, at most 1e7; 0: no target
  size_t target_vertices = 0;  ///< about so many vertices; 0: no target; not both
  double tolerance = 0.03;  ///< the search ends when the count is within this fraction of the target; (0, 1)
  int max_attempts = 8;  ///< lines are traced at most so often; from the third on 10 % is near enough; >= 1
  /// Where so few lines would not tell the shape, as with less than seven chords around a full turn, lines
  /// are traced for more, up to eight times as many, and balance_vertices() takes the rest out. Only with
  /// MeshOptions::for_fit; false: there too for the target itself
  bool coarsen = true;
  void validate() const;  ///< \throw InvalidOption
};

struct RemeshOptions : TargetOptions {
  FeatureOptions features;
  CurvatureOptions curvature;
  Domain domain = Domain::automatic;
  ChartOptions charts;  ///< only where `domain` is Domain::charts
  SmoothingOptions smoothing;
  TraceOptions trace;  ///< trace.density.epsilon_fraction is ignored where a target is given
  MeshOptions mesh;
  FitOptions fit;
  MaxErrorOptions max_error;  ///< a bound instead of a target: fits, whatever fit.enabled says
  BalanceOptions balance;     ///< max_degree is that of `mesh`; only where fit.enabled
  void validate() const;      ///< \throw InvalidOption
};

/// One go at a target.
struct Attempt {
  double epsilon_fraction = 0;
  size_t count = 0;  ///< faces, of which a balance to come is known to make fewer, or vertices
};

/// What the last three stages did.
struct TraceAndMeshReport {
  TraceReport trace;
  IsotropicReport isotropic;
  MeshReport mesh;
  double epsilon_fraction = 0;  ///< that was used in the end
  int attempts = 1;             ///< times lines were traced to meet the target
  std::vector<Attempt> tried;   ///< these; empty without a target
  bool target_met = true;       ///< within 10 %, or no target
  double attempts_seconds = 0;  ///< all of them
};

struct RemeshReport : TraceAndMeshReport {
  FeatureReport features;
  CurvatureReport curvature;
  DomainReport domain;
  SmoothingReport smoothing;
  UmbilicReport umbilics;
  FitReport fit;             ///< all 0 unless FitOptions::enabled
  MaxErrorReport max_error;  ///< all 0 without a bound
  BalanceReport balance;     ///< the same
  double seconds = 0;
};

/// Traces lines, places isotropic samples and builds polygons; where a target is given, with the epsilon that
/// meets it: count is about proportional to 1/epsilon, and a few attempts find the rest.
/// With MeshOptions::for_fit from 10 % below to 7 % above the target is near enough: balance_vertices() finds
/// how many there are to be in properties target_vertices and target_faces. Reads: what trace_lines() reads.
/// Writes: what trace_lines() and place_isotropic_samples() write. \throw as these and build_polygons()
OpenMesh::PolyMesh trace_and_mesh(const SurfaceRef& surface, const TraceOptions& trace = {},
                                  const MeshOptions& mesh = {}, const TargetOptions& target = {},
                                  TraceAndMeshReport* report = nullptr, const Progress& progress = {});

/// Remeshes a surface, refine()d before where it is a part of long triangles: tag_features,
/// estimate_curvature, choose_domain, smooth_tensors, find_umbilics, trace_lines, place_isotropic_samples,
/// build_polygons, balance_vertices or fit_vertices. [ACDLD03] Reads: points, edge feature status. Writes: on
/// the input mesh the properties of all stages; after a throw or a cancel those of the stages that were done
/// by then. \pre in the plane, one component with one border loop \throw InvalidOption, InvalidInput,
/// CannotProcess, SolverFailure, Cancelled
OpenMesh::PolyMesh remesh(const SurfaceRef& surface, const RemeshOptions& options = {},
                          RemeshReport* report = nullptr, const Progress& progress = {});

}  // namespace anisomesh
