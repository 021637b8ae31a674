// Keeps polygons sound while their vertices move.
#pragma once

#include <functional>
#include <vector>

#include "fit/fit_terms.hh"

namespace anisomesh::detail {

/// Cosine of the normals of two neighbours below which one is folded onto the other.
constexpr double least_fold = -0.9;

class FitGuard {
 public:
  /// \param forms know which part of the input each polygon stands for
  FitGuard(const FitMesh& mesh, const FitTriangles& triangles, const std::vector<TriangleForm>& forms);

  /// points + share * step, where the share of each vertex is the largest of 1, 1/2, 1/4 ... 0 for which no
  /// polygon becomes folded, concave or a sliver. \param strays marks further vertices that have gone too far
  /// \param held counts vertices with a share below 1
  std::vector<Vec3d> move(const std::vector<Vec3d>& points, const std::vector<Vec3d>& step,
                          const std::function<void(const std::vector<Vec3d>&, std::vector<char>&)>& strays,
                          size_t& held) const;

 private:
  struct Shape {
    Vec3d normal{0, 0, 0};  // unit
    double fullness = 0;    // twice the area over the squared diameter
    double least_turn = 0;  // of its corners, radians; negative where it is concave, else 0
    double bend = 1;        // least cosine of two of its triangles
  };
  Shape shape_of(int polygon, const std::vector<Vec3d>& points) const;
  bool is_sound(int polygon, const Shape& shape, const Shape& before) const;
  void judge(const std::vector<Vec3d>& points, const std::vector<Shape>& before,
             const std::vector<char>& changed, std::vector<Shape>& shape, std::vector<char>& bad) const;

  const FitMesh& mesh_;
  std::vector<Vec3d> normals_;  // of the input, for each polygon; zero where none is known
};

}  // namespace anisomesh::detail
