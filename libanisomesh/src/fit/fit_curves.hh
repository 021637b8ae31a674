// Features and borders of the result, fitted along those of the input.
#pragma once

#include <vector>

#include "fit/fit_matching.hh"
#include "fit/fit_system.hh"

namespace anisomesh::detail {

class FitCurves {
 public:
  /// A place on a feature or border of the input.
  struct Sample {
    Vec3d place{0, 0, 0};
    int edge = -1;      ///< of the input
    double length = 0;  ///< of the piece of the curve that it stands for; 0: it is only watched
    int side = -1;      ///< of the result, nearest to it; -1: none is near
    double parameter = 0, distance = 0;  ///< along the side and from it
    bool follows = false;                ///< the one before it, along the same edge
    double farthest = 0;                 ///< distance from there to here
  };
  /// \param matching tells which polygons lie beside an edge of the input
  FitCurves(const SurfaceRef& surface, const FitMesh& mesh, const FitMatching& matching,
            const std::vector<Vec3d>& points);

  /// Finds the sides nearest to the input's curves, where the vertices are now.
  void match(const std::vector<Vec3d>& points);
  const std::vector<Sample>& samples() const { return samples_; }
  /// Squared distances of the input's curves to the matched sides. \param width of the strip along a curve
  /// whose area a piece of it weighs as much as
  void add_terms(const std::vector<Vec3d>& points, double width, double total_area, FitSystem& system) const;

 private:
  friend class FitStrays;
  void look(const Vec3d& place, int side, const std::vector<Vec3d>& points, Sample& best) const;
  /// \param halvings of the way at most
  double farthest_between(Sample from, Sample to, const std::vector<Vec3d>& points, int halvings = 8) const;
  Sample nearest(const Sample& sample, const std::vector<Vec3d>& points) const;
  const std::vector<int>& sides_at(int vertex) const { return sides_at_[static_cast<size_t>(vertex)]; }

  const FitMesh& mesh_;
  double tolerance_;
  std::vector<std::vector<int>> sides_at_;  // those on curves, of each vertex
  std::vector<Sample> samples_;
};

}  // namespace anisomesh::detail
