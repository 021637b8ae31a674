// The tensor field in the planes of the charts.
#pragma once

#include <complex>

#include "field/surface_field.hh"
#include "flatten/chart_patch.hh"

namespace anisomesh::detail {

/// Where the corners of each face lie in the plane of its chart, and what they have there.
struct ChartField {
  FaceSides sides;
  std::vector<char> seam;                    ///< of each side of FaceSides
  std::vector<std::array<Vec2d, 3>> corner;  ///< (u, v), counter-clockwise
  /// (uu, uv, vv), 1/length on the surface; one for each chart that meets at a vertex, and for each side of
  /// the features through it.
  std::vector<std::array<Vec3d, 3>> tensor;
  /// (cos, sin) of the turn that has brought it there, from the TangentFrame of the corner's node.
  std::vector<std::array<Vec2d, 3>> turn;
  /// (cos, sin) of the edge from corner 0 to corner 1.
  Vec2d axis(size_t face) const;
  std::complex<double> along(int side) const;  ///< from its corner to the next one
};

/// The field of the surface laid out in its charts: at each corner the tensor of its vertex, turned by the
/// mean of the turns of all faces around the vertex, those beyond seams unfolded along them. So a seam is no
/// border to the field. Reads: chart, chart_uv.
ChartField chart_field(const SurfaceRef& surface, const SurfaceField& field);

/// Of each side on a seam: by how much more than the seam itself the frames turn from its chart to the one
/// beyond, at the corner that the side starts from; radians, 0 elsewhere. Around a vertex inside the surface
/// they add up to a full turn less the angles that its corners have in the charts, whatever these are.
std::vector<double> seam_bends(const ChartField& charts);

}  // namespace anisomesh::detail
