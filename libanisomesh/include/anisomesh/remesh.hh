// All stages in one call.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>

#include "anisomesh/curvature.hh"
#include "anisomesh/features.hh"
#include "anisomesh/flatten.hh"
#include "anisomesh/lines.hh"
#include "anisomesh/mesher.hh"
#include "anisomesh/smoothing.hh"
#include "anisomesh/umbilics.hh"

namespace anisomesh {

struct RemeshOptions {
  FeatureOptions features;
  CurvatureOptions curvature;
  SmoothingOptions smoothing;
  TraceOptions trace;  ///< trace.density.epsilon_fraction is ignored where a target is given
  MeshOptions mesh;
  size_t target_faces = 0;     ///< find epsilon so that the result has about so many faces; 0: epsilon rules
  size_t target_vertices = 0;  ///< the same for vertices; not both
  void validate() const;       ///< \throw InvalidOption
};

struct RemeshReport {
  FeatureReport features;
  CurvatureReport curvature;
  FlattenReport flatten;
  SmoothingReport smoothing;
  UmbilicReport umbilics;
  TraceReport trace;
  IsotropicReport isotropic;
  MeshReport mesh;
  double epsilon_fraction = 0;  ///< that was used in the end
  int attempts = 1;             ///< times lines were traced to meet the target
  bool target_met = true;       ///< within 10 %
  double seconds = 0;
};

/// Remeshes a disc-like patch: tag_features, estimate_curvature, flatten, smooth_tensors, find_umbilics,
/// trace_lines, place_isotropic_samples, build_polygons. [ACDLD03] Leaves the properties of all stages on the
/// input mesh.
OpenMesh::PolyMesh remesh(const SurfaceRef& surface, const RemeshOptions& options = {},
                          RemeshReport* report = nullptr, const Progress& progress = {});

}  // namespace anisomesh
