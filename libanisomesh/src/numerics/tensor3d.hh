// Symmetric 3x3 tensors, kept as (xx, xy, xz, yy, yz, zz), and their part in a tangent plane.
#pragma once

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <cmath>

namespace anisomesh::detail {

using OpenMesh::Vec3d;
using OpenMesh::Vec6d;

/// a a^T.
inline Vec6d outer(const Vec3d& a) {
  return {a[0] * a[0], a[0] * a[1], a[0] * a[2], a[1] * a[1], a[1] * a[2], a[2] * a[2]};
}

/// The symmetric part of a b^T.
inline Vec6d symmetric_outer(const Vec3d& a, const Vec3d& b) {
  return {a[0] * b[0], 0.5 * (a[0] * b[1] + a[1] * b[0]), 0.5 * (a[0] * b[2] + a[2] * b[0]),
          a[1] * b[1], 0.5 * (a[1] * b[2] + a[2] * b[1]), a[2] * b[2]};
}

/// T a.
inline Vec3d apply(const Vec6d& t, const Vec3d& a) {
  return {t[0] * a[0] + t[1] * a[1] + t[2] * a[2], t[1] * a[0] + t[3] * a[1] + t[4] * a[2],
          t[2] * a[0] + t[4] * a[1] + t[5] * a[2]};
}

/// Two unit vectors that make a right-handed frame with a unit normal. Depends on the normal alone, without a
/// branch that noise could flip. [Duff et al. 2017, "Building an orthonormal basis, revisited"]
struct TangentFrame {
  Vec3d u, v;
  explicit TangentFrame(const Vec3d& n) {
    const double sign = std::copysign(1.0, n[2]), a = -1 / (sign + n[2]), b = n[0] * n[1] * a;
    u = Vec3d(1 + sign * n[0] * n[0] * a, sign * b, -sign * n[0]);
    v = Vec3d(b, sign + n[1] * n[1] * a, -n[1]);
  }
};

/// (uu, uv, vv) of a tensor in a frame.
inline Vec3d in_frame(const Vec6d& tensor, const TangentFrame& frame) {
  const Vec3d tu = apply(tensor, frame.u), tv = apply(tensor, frame.v);
  return {frame.u | tu, frame.u | tv, frame.v | tv};
}

/// The tensor of space that a tensor of the tangent plane is; the normal is in its kernel.
inline Vec6d in_space(const Vec3d& tensor, const TangentFrame& frame) {
  return tensor[0] * outer(frame.u) + 2 * tensor[1] * symmetric_outer(frame.u, frame.v) +
         tensor[2] * outer(frame.v);
}

/// The frame turned with the shortest rotation that takes the unit vector `from` to the unit vector `to`.
inline TangentFrame turned(const TangentFrame& frame, const Vec3d& from, const Vec3d& to) {
  TangentFrame result = frame;
  const double denominator = 1 + (from | to);
  if (denominator < 1e-12) return result;  // opposite: any half turn will do, this one keeps the plane
  const auto turn = [&](const Vec3d& a) { return a - (from + to) * ((a | to) / denominator); };
  result.u = turn(frame.u);
  result.v = turn(frame.v);
  return result;
}

}  // namespace anisomesh::detail
