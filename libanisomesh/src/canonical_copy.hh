// Stages that see a surface numbered by its shape, whatever its numbers are.
#pragma once

#include <type_traits>
#include <utility>
#include <vector>

#include "anisomesh/surface.hh"
#include "canonical_order.hh"

namespace anisomesh::detail {

/// A surface in canonical_order(), with the library's properties.
class CanonicalCopy {
 public:
  explicit CanonicalCopy(const SurfaceRef& given);
  CanonicalCopy(const CanonicalCopy&) = delete;
  CanonicalCopy& operator=(const CanonicalCopy&) = delete;

  const SurfaceRef& surface() const { return copy_; }
  /// The library's properties, as they are on the copy now, on the surface that was given.
  void write_back() const;

  /// The source of each vertex of a result, for the copy and as given.
  void take_sources(OpenMesh::PolyConnectivity& result) const { move_sources(result, to_copy_); }
  void give_sources(OpenMesh::PolyConnectivity& result) const { move_sources(result, to_given_); }

  int given(OpenMesh::VertexHandle vertex) const { return order_.vertices[at(vertex)].idx(); }
  int given(OpenMesh::EdgeHandle edge) const { return order_.edges[at(edge)].idx() / 2; }
  int given(OpenMesh::FaceHandle face) const { return to_given_[at(face)].face; }

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
  static void move_sources(OpenMesh::PolyConnectivity& result, const std::vector<FaceThere>& there);

  const SurfaceRef& given_;
  CanonicalOrder order_;
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

/// Calls a stage with the surface in canonical order; what it writes, and what it has written when it throws,
/// is on the surface itself afterwards.
template <class Stage>
auto in_canonical_order(const SurfaceRef& surface, Stage&& stage) {
  const CanonicalCopy copy(surface);
  try {
    auto done = stage(copy.surface());
    copy.write_back();
    if constexpr (std::is_base_of_v<OpenMesh::PolyConnectivity, decltype(done)>) copy.give_sources(done);
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
  copy.give_sources(result);
  return result;
}

/// As above, for a stage that changes a result.
template <class Result, class Stage>
auto change_in_canonical_order(const SurfaceRef& surface, Result& result, Stage&& stage) {
  const CanonicalCopy copy(surface);
  Result work = result;
  copy.take_sources(work);
  auto done = stage(copy.surface(), work);
  copy.give_sources(work);
  result = std::move(work);
  return done;
}

}  // namespace anisomesh::detail
