// Curvature measures of single faces, which estimate_curvature() sums over balls.
#pragma once

#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>

#include "anisomesh/curvature.hh"
#include "numerics/tensor3d.hh"
#include "surface_arrays.hh"

namespace anisomesh::detail {

/// Normals of the corners of faces. The faces around a vertex fall into sectors between its walls; all
/// corners in a sector share one normal.
struct CornerNormals {
  explicit CornerNormals(const SurfaceArrays& surface);

  std::vector<std::array<int, 3>>
      sector;                         ///< of each face's corners, into normals; sector v is one of vertex v
  std::vector<Vec3d> normals;         ///< unit; (0, 0, 0) where no face with an area is
  std::vector<Vec3d> vertex_normals;  ///< unit, mean over the sectors

  const Vec3d& at(int face, int corner) const {
    return normals[static_cast<size_t>(sector[static_cast<size_t>(face)][static_cast<size_t>(corner)])];
  }
};

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
  void measure_normal_cycle(int face);
  void measure_corrected(int face, const CornerNormals& normals);

  const SurfaceArrays& surface_;
  CurvatureEstimator estimator_;
  std::vector<Measure> whole_;
  std::vector<double> areas_;                  ///< 0 where the face is degenerate
  std::vector<std::array<double, 3>> angles_;  ///< normal cycle: signed dihedral angle at each edge
  size_t degenerate_faces_ = 0;
};

/// The part of whole faces' area vectors: twice the area long, along the normal; zero for a degenerate face.
Vec3d area_vector(const SurfaceArrays& surface, int face);

}  // namespace anisomesh::detail
