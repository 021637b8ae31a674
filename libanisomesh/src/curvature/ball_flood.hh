// Walks the part of a surface inside a ball that is connected to where the walk starts.
#pragma once

#include <vector>

#include "numerics/ball_clip.hh"
#include "surface/surface_arrays.hh"

namespace anisomesh::detail {

/// Visits faces breadth first, over every edge that the ball meets and that is no wall. Keeps its memory from
/// walk to walk: one for each thread.
class BallFlood {
 public:
  explicit BallFlood(const SurfaceArrays& surface)
      : surface_(&surface), visited_(static_cast<size_t>(surface.n_faces()), 0) {}

  /// Forgets which faces were visited: walks until the next reset() share no face.
  void reset() { ++stamp_; }
  bool visited(int face) const { return visited_[static_cast<size_t>(face)] == stamp_; }

  /// Calls on_face(face, whole) for every face that meets the ball; whole: if it lies within it.
  template <class OnFace>
  void walk(int first_face, const Vec3d& centre, double radius, OnFace&& on_face) {
    queue_.clear();
    visit(first_face);
    for (size_t next = 0; next < queue_.size(); ++next) {
      const int face = queue_[next];
      const auto& neighbours = surface_->neighbours[static_cast<size_t>(face)];
      Vec3d p[3];
      bool inside[3];
      for (int i = 0; i < 3; ++i) {
        p[i] = surface_->corner_point(face, i) - centre;
        inside[i] = p[i].sqrnorm() <= radius * radius;
      }
      on_face(face, inside[0] && inside[1] && inside[2]);
      for (size_t i = 0; i < 3; ++i) {
        if (neighbours[i] < 0 || visited(neighbours[i])) continue;
        const size_t j = (i + 1) % 3;
        if (inside[i] || inside[j] || meets_ball(p[i], p[j], radius)) visit(neighbours[i]);
      }
    }
  }

  /// The faces of the last walk.
  const std::vector<int>& faces() const { return queue_; }

 private:
  void visit(int face) {
    visited_[static_cast<size_t>(face)] = stamp_;
    queue_.push_back(face);
  }

  const SurfaceArrays* surface_;
  std::vector<unsigned> visited_;
  unsigned stamp_ = 0;
  std::vector<int> queue_;
};

}  // namespace anisomesh::detail
