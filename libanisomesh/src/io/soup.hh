// What a file says before it is a mesh: points and polygons, and how a soup is cleaned into a manifold.
#pragma once

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <string>
#include <utility>
#include <vector>

#include "anisomesh/io.hh"
#include "numerics/disjoint_sets.hh"

namespace anisomesh::detail {

using OpenMesh::Vec3d;

struct Soup {
  std::vector<Vec3d> points;
  std::vector<int> corners;                   ///< of all faces, one after the other
  std::vector<size_t> begins = {0};           ///< where each face's corners begin; one more than faces
  std::vector<std::pair<int, int>> segments;  ///< of an OBJ's `l` elements

  size_t n_faces() const { return begins.size() - 1; }
  size_t degree(size_t face) const { return begins[face + 1] - begins[face]; }
  const int* face(size_t f) const { return corners.data() + begins[f]; }
  int* face(size_t f) { return corners.data() + begins[f]; }
  void end_face() { begins.push_back(corners.size()); }
};

/// One for each format; `text` is the whole file, `path` goes into messages. \throw InvalidInput
Soup read_obj(const std::string& text, const std::string& path);
Soup read_off(const std::string& text, const std::string& path);
Soup read_ply(const std::string& text, const std::string& path);
Soup read_stl(const std::string& text, const std::string& path, ReadReport& report);

/// Drops faces with a corner twice. STL makes these when it merges.
void drop_degenerate_faces(Soup& soup, ReadReport& report);
/// Drops faces with the same set of corners as an earlier face.
void drop_duplicate_faces(Soup& soup, ReadReport& report);
/// Splits every polygon into triangles, in the plane of best fit, by ears.
void triangulate(Soup& soup, ReadReport& report);
/// Joins the two ends of a side where it has no length beside its triangle's longest one.
void join_short_sides(const Soup& soup, DisjointSets& places, ReadReport& report);
/// Joins the ends of border edges that are nearer each other than this fraction of the extent, where two
/// edges and no more lie there. 0: only counts those that lie on one another but for rounding.
void weld(const Soup& soup, double fraction, DisjointSets& places, ReadReport& report);
/// Makes vertices that were joined one. Leaves faces with a corner twice.
void take_places(Soup& soup, DisjointSets& places);
/// Drops pieces, joined along edges of two faces, of triangles that all are without area; not all there is.
void drop_flat_pieces(Soup& soup, ReadReport& report);
/// Keeps the faces marked with 1, in their order; says how many went.
size_t keep_faces(Soup& soup, const std::vector<char>& keep);
/// Turns faces over so that neighbours agree; in each component the majority is right.
void orient(Soup& soup, ReadReport& report);
/// Gives every fan of faces around a vertex a vertex of its own; edges of more than two faces, or of two
/// faces that disagree, become borders.
void split_non_manifold(Soup& soup, ReadReport& report);
/// Drops vertices of no face and fills ReadReport::vertex_of, those that were joined included.
void drop_isolated_vertices(Soup& soup, DisjointSets& places, ReadReport& report);

}  // namespace anisomesh::detail
