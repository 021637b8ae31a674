// Rows of quads, each across their common sides from one to the next: how often each is divided.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>
#include <algorithm>
#include <array>
#include <vector>

#include "numerics/disjoint_sets.hh"

namespace anisomesh::detail {

/// A corner of a polygon that is to be divided from the middles of its sides.
struct PolygonCorner {
  OpenMesh::VertexHandle vertex;
  bool is_middle = false;
};
using PolygonCorners = std::vector<PolygonCorner>;

/// From one middle to another, or to the corner across, whichever parts the polygon most evenly; until no
/// middle is left.
void part_at_middles(const PolygonCorners& corners, std::vector<PolygonCorners>& pieces);

/// Into how many parts the sides of a mesh are divided: opposite ones of quads alike, and so on from quad to
/// quad. A side of a polygon that is no quad is halved at most.
class QuadRows {
 public:
  explicit QuadRows(const OpenMesh::PolyMesh& mesh);

  bool has_others() const { return has_others_; }  ///< polygons than quads
  bool is_quad(OpenMesh::FaceHandle f) const { return mesh_.valence(f) == 4; }
  size_t parts(OpenMesh::EdgeHandle e) { return parts_[row_of(e)]; }
  /// Faces or vertices that the divided mesh has.
  size_t count(bool faces);

  void halve_all() { std::fill(parts_.begin(), parts_.end(), size_t{2}); }
  /// Divides the row whose parts are longest into one more, as long as there are at most so many then.
  void divide(size_t most, bool faces);

 private:
  size_t row_of(OpenMesh::EdgeHandle e) { return sets_.root(static_cast<size_t>(e.idx())); }
  std::array<size_t, 2> grid_of(OpenMesh::FaceHandle f);
  size_t pieces_of(OpenMesh::FaceHandle f);
  size_t inner_vertices(OpenMesh::FaceHandle f);
  size_t around(size_t row, bool faces);

  const OpenMesh::PolyMesh& mesh_;
  DisjointSets sets_;
  std::vector<size_t> parts_;
  std::vector<double> length_;  // mean of the sides
  std::vector<std::vector<OpenMesh::EdgeHandle>> edges_;
  std::vector<std::vector<OpenMesh::FaceHandle>> faces_;
  std::vector<char> limited_;  // beside a polygon that is no quad
  bool has_others_ = false;
};

}  // namespace anisomesh::detail
