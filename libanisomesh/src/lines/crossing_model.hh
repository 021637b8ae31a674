// How many polygons a density stands for, before a line is drawn.
#pragma once

#include <vector>

#include "anisomesh/density.hh"
#include "anisomesh/surface.hh"

namespace anisomesh::detail {

/// The number of crossings that the density asks for: one for each rectangle of the two spacings. Reads: uv
/// and tensor2d, or on the surface surface_tensor and normal.
class CrossingModel {
 public:
  CrossingModel(const SurfaceRef& surface, const DensityOptions& options);

  /// \param epsilon model units
  double count(double epsilon) const;
  /// The largest with which lines still tell the shape, in model units; infinite where it is flat.
  double coarsest_epsilon() const;

 private:
  struct Patch {
    double area = 0, k_min = 0, k_max = 0;
    double curvature() const;
  };
  void take_plane_tensors(const OpenMesh::TriConnectivity& mesh);
  void take_surface_tensors(const OpenMesh::TriConnectivity& mesh);

  DensityOptions options_;
  double diagonal_, extent_;
  double mean_curvature_ = 0;
  std::vector<Patch> patches_;
};

}  // namespace anisomesh::detail
