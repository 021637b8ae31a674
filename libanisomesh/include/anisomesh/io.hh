// Reading surfaces, writing results: full precision where the format allows it, never half a file.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>
#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <string>
#include <utility>
#include <vector>

#include "anisomesh/errors.hh"

namespace anisomesh {

struct ReadOptions {
  /// Border edges whose ends are no farther from each other than this fraction of the extent are made one,
  /// where two lie there and no more; in [0, 0.1]. Files have them where textures or patches meet, and around
  /// every face where they know no shared vertices. 0: the surface stays open there.
  double weld_fraction = 0;
  void validate() const;  ///< \throw InvalidOption
};

struct ReadReport {
  size_t merged_vertices = 0;        ///< STL corners at the same place made one vertex
  size_t joined_vertices = 0;        ///< ends of sides without length, made one vertex with another
  size_t triangulated_polygons = 0;  ///< faces of more than three corners
  size_t degenerate_faces = 0;       ///< faces with a corner twice, then or now, dropped
  size_t flat_faces = 0;             ///< of pieces that have no area anywhere, dropped
  size_t duplicate_faces = 0;        ///< faces with the same corners as an earlier one, dropped
  size_t reoriented_faces = 0;       ///< turned over to agree with most of their component
  size_t duplicated_vertices = 0;    ///< made because a vertex or edge is not manifold, or one-sided
  size_t isolated_vertices = 0;      ///< of no face, dropped
  size_t welded_vertices = 0;        ///< made one with another, as ReadOptions::weld_fraction asked
  size_t coincident_edges = 0;       ///< pairs of border edges in one place but for rounding, left open
  /// Vertex of the mesh for each vertex of the file, -1 where it was dropped; empty where they are the same.
  std::vector<int> vertex_of;
};

/// Reads OBJ, OFF, PLY, STL or OM (with all its properties) as a triangle mesh with vertex, edge and face
/// status. Vertices and faces keep the order of the file. Triangles in OM are what a stage has left: they are
/// not welded. \throw InvalidInput naming the file, the element and the way out \throw InvalidOption
OpenMesh::TriMesh read_surface(const std::string& path, ReadReport* report = nullptr,
                               const ReadOptions& options = {});

/// Reads a polygonal mesh (OBJ, OFF, PLY, STL, OM) as it is: nothing is triangulated or turned over, isolated
/// vertices stay; only what an OpenMesh cannot hold is dropped or split, and reported. \throw InvalidInput
OpenMesh::PolyMesh read_polygons(const std::string& path, ReadReport* report = nullptr);

/// Writes a mesh as OBJ, OFF (shortest decimals that read back as the same doubles), PLY (binary, doubles) or
/// OM (with all persistent properties), by the ending of `path`: first to a temporary file beside it, then
/// renamed, so that an existing file is replaced whole or not at all.
/// \throw InvalidInput if the ending is unknown or the place cannot be written
void write_mesh(const OpenMesh::TriMesh& mesh, const std::string& path);
void write_mesh(const OpenMesh::PolyMesh& mesh, const std::string& path);
/// Writes text the same safe way. \throw InvalidInput
void write_text(const std::string& text, const std::string& path);

/// Looks before the long work whether write_mesh() would find its ending and its place. \throw InvalidInput
void require_writable_mesh(const std::string& path);
/// The same for write_text(). \throw InvalidInput
void require_writable(const std::string& path);

/// Feature edges as vertex index pairs (0-based): from an OBJ's `l` elements (1-based there), or from text
/// lines "i j" (0-based, '#' starts a comment). \throw InvalidInput
std::vector<std::pair<int, int>> read_feature_edges(const std::string& path);

}  // namespace anisomesh
