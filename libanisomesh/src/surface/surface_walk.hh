// Going straight ahead on a surface, from triangle to triangle.
#pragma once

#include <algorithm>

#include "surface/unfolded_faces.hh"

namespace anisomesh::detail {

/// The part of a way that lies in one face, in its frame.
struct PathPiece {
  int face = -1;
  Vec2d from{0, 0}, to{0, 0};
  int exit = -1;  ///< the corner opposite the edge that the way leaves by; -1: it ends in the face
};

/// Non-negative coordinates with sum 1.
inline Vec3d clean_barycentric(Vec3d b) {
  b.maximize(Vec3d(0, 0, 0));
  return b / (b[0] + b[1] + b[2]);
}

/// Goes along a vector, unfolding at each edge; ends on the first border or feature edge, in the face before
/// it, or in the face where `visit` returns false.
/// \param visit called for each face with the face, the corner opposite the edge that the way leaves by (-1:
/// it ends in the face), the barycentric coordinates of both ends, and what fraction of the vector is left at
/// each
template <class Visit>
Reach walk_straight_while(const UnfoldedFaces& faces, const SurfacePoint& from, const Vec2d& vector,
                          Visit&& visit) {
  // A spacing crosses some hundred triangles; where rounding lets the way circle a vertex it gives up.
  constexpr int kMostCrossings = 20000;
  Reach reach;
  int face = from.face.idx(), entered = -1;
  Vec3d at = from.barycentric;
  Vec2d rest = vector;
  double left = 1;  // of the vector
  for (int crossings = 0; crossings < kMostCrossings; ++crossings) {
    const Vec3d step = faces.barycentric_step(face, rest), end = at + step;
    int exit = -1;
    double t = 1;
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<size_t>(i);
      if (i == entered || end[k] >= 0 || step[k] >= 0) continue;
      const double t_i = at[k] / -step[k];
      if (t_i <= t) exit = i, t = t_i;
    }
    const Vec3d before = at;
    at = clean_barycentric(exit < 0 ? end : at + t * step);
    if (exit >= 0) {
      at[static_cast<size_t>(exit)] = 0;
      at = clean_barycentric(at);
    }
    if (!visit(face, exit, before, at, left, exit < 0 ? 0 : left * (1 - t))) break;
    if (exit < 0) {
      left = 0;
      break;
    }
    left *= 1 - t;
    const int next = faces.across(face, exit);
    if (next < 0) {
      reach.blocked = true;
      reach.border = next == kBorder;
      break;
    }
    const Vec2d turn = faces.turn_at(face, exit, at);
    rest = turned_by((1 - t) * rest, turn);
    reach.rotation = turned_by(reach.rotation, turn);
    at = faces.carried_on_edge(face, exit, at);
    entered = faces.twin(face, exit);
    face = next;
  }
  reach.point = {OpenMesh::FaceHandle(face), at};
  reach.fraction = 1 - left;
  return reach;
}

/// The same to the end. \param on_piece called with a PathPiece for each face
template <class OnPiece>
Reach walk_straight(const UnfoldedFaces& faces, const SurfacePoint& from, const Vec2d& vector,
                    OnPiece&& on_piece) {
  return walk_straight_while(
      faces, from, vector,
      [&](int face, int exit, const Vec3d& begin, const Vec3d& end, double /*left*/, double /*left_after*/) {
        const OpenMesh::FaceHandle handle(face);
        on_piece(PathPiece{face, faces.place({handle, begin}), faces.place({handle, end}), exit});
        return true;
      });
}

}  // namespace anisomesh::detail
