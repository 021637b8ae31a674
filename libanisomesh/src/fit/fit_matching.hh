// Which place of the result each place of the input stands beside, and the other way round.
#pragma once

#include <vector>

#include "anisomesh/lines.hh"
#include "anisomesh/surface.hh"
#include "fit/fit_mesh.hh"
#include "fit/fit_pairs.hh"
#include "numerics/tensor3d.hh"
#include "surface/near_locator.hh"

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

/// Samples of the input keep the polygon they were matched with, and find the next one from there: a place
/// on one side of a thin sheet never passes to the other, and features are not crossed.
class FitMatching {
 public:
  FitMatching(const SurfaceRef& surface, const FitInput& input, const FitMesh& mesh,
              std::vector<OpenMesh::FaceHandle> sources, const FitTriangles& triangles,
              const std::vector<Vec3d>& points);
  /// For a mesh in which polygons have changed: samples go on from what stands in their polygon's place.
  FitMatching(FitMatching&& earlier, const FitMesh& mesh, std::vector<OpenMesh::FaceHandle> sources,
              const std::vector<PolygonRange>& heirs, const FitTriangles& triangles,
              const std::vector<Vec3d>& points);

  /// Pairs of both ways. \param before where vertices were elsewhere, or null
  void match(const FitTriangles& triangles, const std::vector<Vec3d>& points, const FitPairs* before,
             FitPairs& pairs);

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
  std::vector<int> place_samples(const std::vector<int>& polygon, size_t n_triangles);
  int best_at(const int* begin, const int* end, OpenMesh::FaceHandle face, const FitTriangles& triangles,
              const std::vector<Vec3d>& points) const;
  Vec3d centre_of(OpenMesh::FaceHandle face) const;
  std::vector<int> flood(const FitTriangles& triangles, const std::vector<Vec3d>& points) const;
  void start_in_large_faces(const std::vector<int>& first_sample, const FitTriangles& triangles,
                            const std::vector<Vec3d>& points);
  void sort_samples();
  bool nearest(const Vec3d& place, const Vec3d& normal, const FitTriangles& triangles,
               const std::vector<Vec3d>& points, int& polygon, FitPair& pair) const;
  struct Foot {
    SurfacePoint point;
    Vec3d away{0, 0, 0};  ///< to it
    double key = 0;       ///< distance, more where it faces elsewhere
  };
  OpenMesh::FaceHandle start_from_corners(const Triangle& corner, const Vec3d& normal,
                                          const Vec3d& place) const;
  Foot foot_from(const Vec3d& place, const Vec3d& normal, OpenMesh::FaceHandle face) const;
  Foot foot_of(const Vec3d& place, const Vec3d& normal, const Triangle& corner, int before, const int* begin,
               const int* end, double near) const;
  void match_result(const FitTriangles& triangles, const std::vector<Vec3d>& points, const FitPairs* before,
                    FitPairs& pairs) const;

  const SurfaceRef& surface_;
  const FitInput& input_;
  const FitMesh& mesh_;
  std::vector<OpenMesh::FaceHandle> sources_;
  std::vector<Sample> samples_;
  std::vector<int> sample_of_;  // of each face, its first one; -1: none
};

}  // namespace anisomesh::detail
