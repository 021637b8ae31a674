// The Gaussian filter of tensors at samples that know their neighbours.
#pragma once

#include <vector>

#include "anisomesh/progress.hh"
#include "surface/cut_surface.hh"

namespace anisomesh::detail {

/// The field to be filtered: one sample a node of the cut surface. In the plane all tensors are in one frame,
/// places have z = 0 and there are no normals; on the surface a tensor is in the TangentFrame of its normal.
struct FilterSamples {
  CutSurface cut;
  NodeNeighbours neighbours;
  std::vector<Vec3d> place;
  std::vector<Vec3d> normal;   ///< unit; empty in the plane
  std::vector<double> radius;  ///< of the support, in the unit of the places
  std::vector<double> area;    ///< on the surface
};

/// The tensors (uu, uv, vv) of the samples after so many passes: means over the samples that are reached from
/// neighbour to neighbour within the radius, weighted by area and a Gaussian, and where `anisotropic` by
/// likeness. On the surface what faces away is left out.
/// \throw Cancelled
std::vector<Vec3d> filter_repeatedly(const FilterSamples& samples, std::vector<Vec3d> values, int iterations,
                                     bool anisotropic, const Progress& progress);

}  // namespace anisomesh::detail
