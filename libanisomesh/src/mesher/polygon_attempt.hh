// Polygons that need not come out sound: what the search for a count asks for.
#pragma once

#include <functional>

#include "anisomesh/mesher.hh"

namespace anisomesh::detail {

/// Whether a mesh with so many vertices and faces is wanted.
using IsWanted = std::function<bool(const MeshReport&)>;

struct PolygonAttempt {
  OpenMesh::PolyMesh mesh;  ///< empty unless sound
  bool sound = false;
};

/// As build_polygons(), but does not begin again where polygons are folded or degenerate and a mesh of their
/// number is not wanted. The report has their number in any case.
PolygonAttempt attempt_polygons(const SurfaceRef& surface, const MeshOptions& options,
                                const IsWanted& is_wanted, MeshReport* report, const Progress& progress);

/// How nearly chains are followed where lines are traced with this epsilon; both in the same unit.
double chain_tolerance_of(const MeshOptions& options, double epsilon);

}  // namespace anisomesh::detail
