// The triangles of a surface, each laid out in a plane of its own, and how these planes join across edges.
#pragma once

#include <array>
#include <vector>

#include "lines/face_domain.hh"

namespace anisomesh::detail {

inline Vec2d turned_by(const Vec2d& v, const Vec2d& r) {
  return {r[0] * v[0] - r[1] * v[1], r[1] * v[0] + r[0] * v[1]};
}
inline Vec2d turned_back(const Vec2d& v, const Vec2d& r) {
  return {r[0] * v[0] + r[1] * v[1], r[0] * v[1] - r[1] * v[0]};
}

/// A right-handed frame in space.
struct FaceFrame {
  Vec3d x, y, normal;
};

/// The geometry of the surface within itself: edge lengths and the triangles they make. Corner 0 of a face is
/// the origin of its frame, corner 1 on its x axis, corner 2 above it. No triangle is degenerate: where the
/// input has one, all edges are lengthened by a 1e-5th of their mean length, which gives every triangle an
/// inside and moves nothing that could be seen. [Sharp and Crane 2020, "intrinsic mollification"]
class UnfoldedFaces {
 public:
  /// \param faces whose `across` are set; kept, and read later
  UnfoldedFaces(const SurfaceRef& surface, const std::vector<DomainFace>& faces);
  /// Other triangles instead of those of the surface, which need not fit together.
  /// \param lengths of the edges opposite each corner, of triangles with an inside
  /// \param corner_turns (cos, sin) of what takes a frame at each corner's vertex to that of the face: where
  /// the two ends of an edge differ in what they make of the turn across it, it goes over from one to the
  /// other
  UnfoldedFaces(const SurfaceRef& surface, const std::vector<DomainFace>& faces,
                const std::vector<std::array<double, 3>>& lengths,
                std::vector<std::array<Vec2d, 3>> corner_turns);

  size_t size() const { return layouts_.size(); }
  Vec2d corner(int face, int i) const {
    const Layout& l = layouts_[static_cast<size_t>(face)];
    return i == 0 ? Vec2d(0, 0) : i == 1 ? Vec2d(l.x1, 0) : Vec2d(l.x2, l.y2);
  }
  Vec2d place(const SurfacePoint& at) const {
    const Layout& l = layouts_[static_cast<size_t>(at.face.idx())];
    return {at.barycentric[1] * l.x1 + at.barycentric[2] * l.x2, at.barycentric[2] * l.y2};
  }
  /// What a vector adds to barycentric coordinates; the sum is 0.
  Vec3d barycentric_step(int face, const Vec2d& vector) const {
    const Layout& l = layouts_[static_cast<size_t>(face)];
    const double b2 = vector[1] / l.y2, b1 = (vector[0] - b2 * l.x2) / l.x1;
    return {-b1 - b2, b1, b2};
  }
  double area(int face) const {
    const Layout& l = layouts_[static_cast<size_t>(face)];
    return 0.5 * l.x1 * l.y2;
  }
  /// The face across the edge opposite corner i, or kFeature or kBorder.
  int across(int face, int i) const { return (*faces_)[static_cast<size_t>(face)].across[i]; }
  /// Which corner of that face is opposite the edge.
  int twin(int face, int i) const { return layouts_[static_cast<size_t>(face)].twin[static_cast<size_t>(i)]; }
  /// (cos, sin) that takes vectors of a face's frame to that of the face across the edge opposite corner i.
  const Vec2d& turn(int face, int i) const {
    return layouts_[static_cast<size_t>(face)].turn[static_cast<size_t>(i)];
  }
  /// The same at a point of that edge.
  Vec2d turn_at(int face, int i, const Vec3d& barycentric) const;
  /// A place in the frame of a face as the face across the edge opposite corner i sees it.
  Vec2d carried(int face, int i, const Vec2d& place) const {
    return corner(across(face, i), (twin(face, i) + 1) % 3) +
           turned_by(place - corner(face, (i + 2) % 3), turn(face, i));
  }
  /// The same point in barycentric coordinates of the face across; exactly 0 opposite the edge.
  Vec3d carried_on_edge(int face, int i, const Vec3d& barycentric) const {
    const int j = twin(face, i);
    Vec3d result(0, 0, 0);
    result[static_cast<size_t>((j + 1) % 3)] = barycentric[static_cast<size_t>((i + 2) % 3)];
    result[static_cast<size_t>((j + 2) % 3)] = barycentric[static_cast<size_t>((i + 1) % 3)];
    return result;
  }
  /// Squared distance from a place to the edge opposite corner i, and the parameter of its nearest point,
  /// from corner i + 1 on.
  double edge_distance2(int face, int i, const Vec2d& place, double& parameter) const;

 private:
  struct Layout {
    double x1 = 0, x2 = 0, y2 = 0;
    std::array<Vec2d, 3> turn{};
    std::array<signed char, 3> twin{-1, -1, -1};
  };
  std::vector<Layout> layouts_;
  std::vector<std::array<Vec2d, 3>> corner_turns_;  // may be empty
  const std::vector<DomainFace>* faces_;
};

/// The frame of a face in space, as UnfoldedFaces lays it out. Of a face without area the normal is as near
/// to `hint` as its edges allow.
FaceFrame face_frame(const SurfaceRef& surface, OpenMesh::FaceHandle face, const Vec3d& hint);

}  // namespace anisomesh::detail
