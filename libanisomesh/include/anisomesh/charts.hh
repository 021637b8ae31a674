// An atlas: any surface cut into discs that flatten.
#pragma once

#include "anisomesh/progress.hh"
#include "anisomesh/surface.hh"

namespace anisomesh {

struct ChartOptions {
  double max_area_stretch =
      6;  ///< areas in the plane grow or shrink by at most this, over the chart's mean; > 1
  double crease_weight = 1;  ///< how much farther it is over a crease than around it; >= 0
  bool keep_charts =
      false;              ///< start from the charts that `chart` has, and cut only those that do not flatten
  void validate() const;  ///< \throw InvalidOption
};

struct ChartReport {
  size_t charts = 0;
  size_t seam_edges = 0;   ///< between charts, or from a chart to itself; features and borders not counted
  double seam_length = 0;  ///< model units
  double max_area_stretch = 1;           ///< either way, over all vertices of all charts
  double mean_conformal_distortion = 1;  ///< area-weighted mean of the ratio of singular values
  size_t repaired_triangles = 0;         ///< flipped by the conformal map, then repaired
  size_t single_triangles = 0;           ///< charts of one triangle
  double seconds = 0;
};

/// Cuts a surface of any topology into charts: discs that are mapped to the plane one to one, each to a plane
/// of its own, with bounded change of area. Borders of charts lie on features first, then along creases of
/// the shape. What is no disc or does not flatten is cut in two, again and again; a single triangle flattens.
///
/// Reads: points, edge feature status. Writes: chart, chart_uv (properties.hh); with these on a mesh without
/// uv the stages after it work in the charts. The same for any number of threads. \throw InvalidOption,
/// Cancelled, InvalidInput (keep_charts without charts)
ChartReport cut_into_charts(const SurfaceRef& surface, const ChartOptions& options = {},
                            const Progress& progress = {});

/// Whether cut_into_charts() has run on the mesh, and flatten() has not.
bool has_charts(const SurfaceRef& surface);

/// Takes chart_uv off the mesh, so that the stages after it work on the surface. The charts' numbers stay.
void discard_charts(const SurfaceRef& surface);

/// Whether two faces that share an edge lie apart in the plane there. False on the border.
/// Reads: chart, chart_uv. \throw InvalidInput
bool is_seam(const SurfaceRef& surface, OpenMesh::EdgeHandle edge);

}  // namespace anisomesh
