// A result that is being changed: polygons are taken out and others put in their place.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "anisomesh/surface.hh"
#include "fit/fit_mesh.hh"

namespace anisomesh::detail {

class PatchMesh {
 public:
  explicit PatchMesh(const OpenMesh::PolyMesh& mesh);

  struct Vertex {
    Vec3d point{0, 0, 0};
    int origin = 0;
    SurfacePoint source;
    bool on_curve = false;  ///< on a feature or the border
    std::vector<int> polygons;
  };
  /// Polygons in one piece, and the vertices around them.
  struct Patch {
    std::vector<int> polygons;
    std::vector<int> ring;  ///< counter-clockwise; empty where it is no disc or touches itself
    /// Where a vertex goes from a curve: the two beside it there, that come to be joined.
    std::array<int, 2> bridge{-1, -1};
    size_t on_first_side = 0;  ///< so many of the polygons, if they lie on two sides of a curve
  };
  /// Polygons around a vertex inside a curve, and the rings that are left without it; or those on both sides
  /// of a side of a curve, and their rings with a vertex that is to come, -1.
  struct CurveStar {
    std::vector<Patch> sides;  ///< two of a feature, one of the border; none where nothing may be changed
    Patch whole;               ///< polygons of both, one side after the other
  };

  const std::vector<Vertex>& vertices() const { return vertices_; }
  const std::vector<std::vector<int>>& polygons() const { return polygons_; }
  const Vec3d& point(int v) const { return vertices_[static_cast<size_t>(v)].point; }

  /// The polygon across the side from v to w, unless a feature or the border lies there; -1.
  int across(int v, int w) const;
  /// The polygons across the sides of one, each once.
  std::vector<int> around(int polygon) const;
  /// Polygons around an inner vertex; without a ring where it is on a curve.
  Patch star(int vertex) const;
  /// Without sides for corners, ends, and where curves meet or change their kind.
  CurveStar curve_star(int vertex) const;
  /// Polygons that touch along sides.
  Patch join(const std::vector<int>& polygons) const;
  /// Whether v and w are joined by an edge of a polygon that is not in the patch.
  bool joined_outside(const Patch& patch, int v, int w) const;
  /// For each pair of corners i < j of the ring, at i * n + j, whether they are joined outside, so that no
  /// piece may join them.
  std::vector<char> forbidden_chords(const Patch& patch) const;
  /// Whether pieces can take the place of the patch: no edge a second time, none past a vertex that is beside
  /// both its ends, no inner vertex with two edges only, whose polygons would share both. A vertex to be
  /// added is -1.
  bool may_replace(const Patch& patch, const std::vector<std::vector<int>>& pieces) const;

  int add_vertex(const Vec3d& point, const SurfacePoint& source);
  /// Between two that are joined by a side of a curve.
  int add_vertex_on_curve(const Vec3d& point, const SurfacePoint& source, const std::array<int, 2>& ends);
  /// The polygons on both sides of a side, of the border the only one.
  CurveStar curve_side(int v, int w) const;
  void move(int v, const Vec3d& to) { vertices_[static_cast<size_t>(v)].point = to; }
  /// \param on_first_side so many of the pieces, if the patch lies on two sides of a curve
  void replace(const Patch& patch, const std::vector<std::vector<int>>& pieces, size_t on_first_side = 0);

  /// The result with all its properties; vertices without a polygon are left out.
  OpenMesh::PolyMesh mesh() const;
  /// For each polygon that there was at first, the numbers in mesh() of it or of those in its place.
  std::vector<PolygonRange> heirs() const;

 private:
  static std::uint64_t key(int v, int w) {
    const auto a = static_cast<std::uint64_t>(std::min(v, w)), b = static_cast<std::uint64_t>(std::max(v, w));
    return a << 32 | b;
  }
  /// \param but vertices that do not count
  bool passes_a_vertex(int v, int w, const std::vector<int>& but) const;
  std::vector<int> beside_on_curve(int v) const;
  Patch beside_curve(int v, int from, int to) const;
  std::vector<int> inner_vertices(const Patch& patch) const;
  /// Edges at v that belong to no polygon of the patch.
  int edges_outside(const Patch& patch, int v) const;
  Patch with_ring(std::vector<int> polygons) const;
  bool is_on_curve(int v, int w) const;

  std::vector<Vertex> vertices_;
  std::vector<std::vector<int>> polygons_;  // empty: taken out
  std::vector<PolygonRange> heirs_;         // of each polygon that there was at first
  std::unordered_map<std::uint64_t, int> kind_;
  std::unordered_map<std::uint64_t, char> curve_;
};

}  // namespace anisomesh::detail
