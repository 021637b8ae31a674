// Curvature measures of single faces, which estimate_curvature() sums over balls.
#pragma once

#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>

#include "anisomesh/curvature.hh"
#include "curvature/corner_normals.hh"
#include "numerics/tensor3d.hh"
#include "surface/surface_arrays.hh"

namespace anisomesh::detail {

/// What a piece of surface adds to the estimate: a tensor times area, and area.
struct Measure {
  Vec6d tensor{0, 0, 0, 0, 0, 0};
  double area = 0;
  Measure& operator+=(const Measure& other) {
    tensor += other.tensor;
    area += other.area;
    return *this;
  }
};

/// The measures of all faces for one estimator.
class CurvatureMeasures {
 public:
  CurvatureMeasures(const SurfaceArrays& surface, const CornerNormals& normals, CurvatureEstimator estimator);

  const Measure& whole(int face) const { return whole_[static_cast<size_t>(face)]; }
  /// Of the part of the face within the ball of the given radius around the centre.
  Measure clipped(int face, const Vec3d& centre, double radius) const;
  size_t degenerate_faces() const { return degenerate_faces_; }

  /// The curvature tensor (uu, uv, vv) in a tangent frame that a sum of measures stands for.
  Vec3d curvature(const Measure& sum, const TangentFrame& frame) const;

 private:
  void measure_normal_cycle(int face, const CornerNormals& normals);
  void measure_corrected(int face, const CornerNormals& normals);

  const SurfaceArrays& surface_;
  CurvatureEstimator estimator_;
  std::vector<Measure> whole_;
  std::vector<double> areas_;  ///< 0 where the face is degenerate
  std::vector<std::array<double, 3>>
      angles_;  ///< normal cycle: this face's half of the signed dihedral angle at each edge
  size_t degenerate_faces_ = 0;
};

}  // namespace anisomesh::detail
