// A triangulation of a small region of the plane that points are inserted into and edges are flipped in.
#pragma once

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <array>
#include <vector>

namespace anisomesh::detail {

/// Its corners are indices into an array of points that the caller keeps and may append to.
class SmallTriangulation {
 public:
  /// Counter-clockwise triangles; edges of one triangle only are the border and stay, as do walls, which are
  /// pairs of corners.
  SmallTriangulation(const std::vector<OpenMesh::Vec2d>& points, std::vector<std::array<int, 3>> triangles,
                     const std::vector<std::array<int, 2>>& walls = {});

  const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }
  /// The triangle that holds a point, or the one it is least far outside of.
  int locate(const OpenMesh::Vec2d& p) const;
  /// Inserts point `corner` and restores the Delaunay property. \return false, with nothing changed, if the
  /// point is not inside
  bool insert(int corner);
  /// The triangle across the edge opposite corner `k` of triangle `t`, or -1.
  int neighbor(int t, size_t k) const { return neighbors_[static_cast<size_t>(t)][k]; }
  /// The corner across that edge.
  int across(int t, size_t k) const;
  /// Whether the edge opposite corner `k` of triangle `t` can be replaced by the other diagonal.
  bool can_flip(int t, size_t k) const;
  void flip(int t, size_t k);

 private:
  double turn(int a, int b, int c) const;
  size_t index_of_neighbor(int t, int neighbor) const;
  void replace_neighbor(int t, int old_one, int new_one);
  void legalize(int corner);

  const OpenMesh::Vec2d& point(int corner) const { return (*points_)[static_cast<size_t>(corner)]; }

  const std::vector<OpenMesh::Vec2d>* points_;  // no reference: copies are assigned
  std::vector<std::array<int, 3>> triangles_, neighbors_;
  mutable int last_ = 0;
};

}  // namespace anisomesh::detail
