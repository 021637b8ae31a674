// Which place of the result each place of the input stands beside, and the other way round.
#pragma once

#include <vector>

#include "anisomesh/lines.hh"
#include "anisomesh/surface.hh"
#include "fit_mesh.hh"
#include "near_locator.hh"
#include "numerics/tensor3d.hh"

namespace anisomesh::detail {

/// What is known of each face of the input.
struct FitInput {
  explicit FitInput(const SurfaceRef& surface);
  std::vector<Vec3d> normal;  ///< unit; zero without area
  std::vector<double> area;
  NearLocator locator;
  std::vector<Vec6d> tensor;          ///< of curvature, mean of the corners'; empty where none was estimated
  Follow follow = Follow::curvature;  ///< what its lines follow
};

/// Squared distance of one sample to the other mesh, as the fit sees it: it changes by
/// weight * (direction | step of the place in the triangle).
struct FitPair {
  int triangle = -1;           ///< of the result
  Vec3d barycentric{0, 0, 0};  ///< in it
  Vec3d direction{0, 0, 0};    ///< unit, from the result to the input
  int face = -1;               ///< of the input
  double distance = 0;         ///< along `direction`, >= 0
  double weight = 0;           ///< share of the area of the mesh it was sampled on
};

/// Samples of the input keep the polygon they were matched with, and find the next one from there: a place
/// on one side of a thin sheet never passes to the other, and features are not crossed.
class FitMatching {
 public:
  FitMatching(const SurfaceRef& surface, const FitInput& input, const FitMesh& mesh,
              const std::vector<OpenMesh::FaceHandle>& sources, const FitTriangles& triangles,
              const std::vector<Vec3d>& points);

  /// Pairs of both ways, those of the input first; each way's weights add up to 1.
  const std::vector<FitPair>& match(const FitTriangles& triangles, const std::vector<Vec3d>& points);

  struct Sample {
    Vec3d place{0, 0, 0};
    int face = -1;
    double weight = 0;
    int polygon = -1;  ///< that it was matched with last
  };
  /// Of the input; their pairs come first.
  const std::vector<Sample>& samples() const { return samples_; }
  /// The polygon that the middle of a face of the input is matched with; -1: none.
  int polygon_of(int face) const;

 private:
  void place_samples();
  int best_at(const int* begin, const int* end, OpenMesh::FaceHandle face, const FitTriangles& triangles,
              const std::vector<Vec3d>& points) const;
  Vec3d centre_of(OpenMesh::FaceHandle face) const;
  void flood(const std::vector<OpenMesh::FaceHandle>& sources, const FitTriangles& triangles,
             const std::vector<Vec3d>& points);
  void start_in_large_faces(const std::vector<OpenMesh::FaceHandle>& sources, const FitTriangles& triangles,
                            const std::vector<Vec3d>& points);
  bool nearest(const Vec3d& place, const Vec3d& normal, const FitTriangles& triangles,
               const std::vector<Vec3d>& points, int& polygon, FitPair& pair) const;
  struct Foot {
    SurfacePoint point;
    Vec3d away{0, 0, 0};  ///< to it
    double key = 0;       ///< distance, more where it faces elsewhere
  };
  OpenMesh::FaceHandle start_from_corners(const Triangle& corner, const Vec3d& normal,
                                          const Vec3d& place) const;
  Foot foot_of(const Vec3d& place, const Vec3d& normal, const Triangle& corner,
               const std::vector<int>& matched, double near) const;
  void match_result(const FitTriangles& triangles, const std::vector<Vec3d>& points);

  const SurfaceRef& surface_;
  const FitInput& input_;
  const FitMesh& mesh_;
  std::vector<OpenMesh::FaceHandle> sources_;
  std::vector<Sample> samples_;
  std::vector<int> first_sample_;  // of each face
  std::vector<FitPair> pairs_;
  size_t n_triangles_ = 0;
};

}  // namespace anisomesh::detail
