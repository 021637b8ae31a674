// Where the field is smoothed and lines are traced: in the plane of a parameterization, or on the surface.
#pragma once

#include <string>

#include "anisomesh/charts.hh"
#include "anisomesh/flatten.hh"
#include "anisomesh/progress.hh"
#include "anisomesh/surface.hh"

namespace anisomesh {

enum class Domain {
  automatic,  ///< the plane for a disc that flattens well, the surface for everything else
  plane,      ///< the paper's: one disc only
  charts,     ///< any topology, cut into discs that flatten: the paper's way for what is no disc
  surface     ///< any topology, no parameterization
};

struct DomainReport {
  Domain used = Domain::plane;  ///< plane, charts or surface
  std::string reason;           ///< why `automatic` did not take the plane; empty where it did
  FlattenReport flatten;        ///< in the plane
  ChartReport charts;           ///< in charts
  double seconds = 0;
};

/// Prepares a mesh for the domain that the stages after it work in: flatten() for the plane,
/// cut_into_charts() for charts, unflatten() and discard_charts() for the surface. `automatic` takes the
/// plane for one component with one border loop and Euler characteristic 1 whose flattening succeeds, with a
/// mean conformal distortion of at most 2 and no vertex stretched to less than 1e-5 of its area
/// (docs/surface-domain.md). It never takes charts: on the same meshes they are no better than the surface
/// (docs/charts.md).
///
/// Reads: points, tensor, normal; with charts and keep_charts `chart`. Writes: as these.
/// \param charts how the surface is cut, with `charts`
/// \throw as flatten() and cut_into_charts(), with `automatic` only InvalidInput and Cancelled
DomainReport choose_domain(const SurfaceRef& surface, Domain wanted, const ChartOptions& charts,
                           const Progress& progress = {});

/// The same with the default ChartOptions.
DomainReport choose_domain(const SurfaceRef& surface, Domain wanted = Domain::automatic,
                           const Progress& progress = {});

}  // namespace anisomesh
