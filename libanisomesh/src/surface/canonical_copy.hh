// Stages that see a surface numbered by its shape, whatever its numbers are.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>
#include <type_traits>
#include <utility>
#include <vector>

#include "anisomesh/surface.hh"
#include "surface/canonical_order.hh"

namespace anisomesh::detail {

/// A surface in canonical_order(), with the library's properties; one that is far away compared with its size
/// lies near the origin, which loses nothing: differences of its coordinates are exact.
class CanonicalCopy {
 public:
  explicit CanonicalCopy(const SurfaceRef& given);
  CanonicalCopy(const CanonicalCopy&) = delete;
  CanonicalCopy& operator=(const CanonicalCopy&) = delete;

  const SurfaceRef& surface() const { return copy_; }
  /// The library's properties, as they are on the copy now, on the surface that was given.
  void write_back() const;

  /// Where a result lies and where each of its vertices comes from, for the copy and as given.
  void take(OpenMesh::PolyMesh& result) const { move(result, to_copy_, given_, copy_, -origin_); }
  void give(OpenMesh::PolyMesh& result) const { move(result, to_given_, copy_, given_, origin_); }

  int given(OpenMesh::VertexHandle vertex) const { return order_.vertices[at(vertex)].idx(); }
  int given(OpenMesh::EdgeHandle edge) const { return order_.edges[at(edge)].idx() / 2; }
  int given(OpenMesh::FaceHandle face) const { return to_given_[at(face)].face; }
  const Vec3d& origin() const { return origin_; }  ///< where that of the copy is

 private:
  /// Where points of a face are in the other mesh: the corner that is k-th here is k + shift-th there.
  struct FaceThere {
    int face = 0, shift = 0;
  };

  template <class Handle>
  static size_t at(Handle handle) {
    return static_cast<size_t>(handle.idx());
  }
  void make_connectivity();
  void map_faces();
  void copy_properties(OpenMesh::TriConnectivity& from, OpenMesh::TriConnectivity& to, bool back) const;
  void choose_origin();
  static void move(OpenMesh::PolyMesh& result, const std::vector<FaceThere>& there, const SurfaceRef& from,
                   const SurfaceRef& to, const Vec3d& by);

  const SurfaceRef& given_;
  CanonicalOrder order_;
  Vec3d origin_{0, 0, 0};
  std::vector<FaceThere> to_given_, to_copy_;
  OpenMesh::TriConnectivity connectivity_;
  SurfaceRef copy_;
};

/// What the element is called in messages: its number in the mesh that the caller gave.
template <class Handle>
int given_number(const SurfaceRef& surface, Handle handle) {
  const CanonicalCopy* copy = surface.canonical_copy();
  return copy ? copy->given(handle) : handle.idx();
}

/// A place as the caller knows it, for messages.
inline Vec3d given_place(const SurfaceRef& surface, const Vec3d& place) {
  const CanonicalCopy* copy = surface.canonical_copy();
  return copy ? Vec3d(place + copy->origin()) : place;
}

/// Calls a stage with the surface in canonical order; what it writes, and what it has written when it throws,
/// is on the surface itself afterwards.
template <class Stage>
auto in_canonical_order(const SurfaceRef& surface, Stage&& stage) {
  const CanonicalCopy copy(surface);
  try {
    auto done = stage(copy.surface());
    copy.write_back();
    if constexpr (std::is_same_v<OpenMesh::PolyMesh, decltype(done)>) copy.give(done);
    return done;
  } catch (...) {
    copy.write_back();
    throw;
  }
}

/// As above, for a stage that writes nothing on the surface but makes a result.
template <class Stage>
auto make_in_canonical_order(const SurfaceRef& surface, Stage&& stage) {
  const CanonicalCopy copy(surface);
  auto result = stage(copy.surface());
  copy.give(result);
  return result;
}

/// As above, for a stage that changes a result.
template <class Result, class Stage>
auto change_in_canonical_order(const SurfaceRef& surface, Result& result, Stage&& stage) {
  const CanonicalCopy copy(surface);
  Result work = result;
  copy.take(work);
  auto done = stage(copy.surface(), work);
  copy.give(work);
  result = std::move(work);
  return done;
}

}  // namespace anisomesh::detail
