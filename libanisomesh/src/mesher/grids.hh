// More polygons than the surface asks for: where a flat one has fewer than are wanted, they are divided into
// grids.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>

#include "anisomesh/mesher.hh"

namespace anisomesh::detail {

/// Divides the polygons of a result that has fewer faces (or vertices, where `faces` is 0) than wanted by
/// more than 10 %, until there are about as many: quads into grids as square as they come, each row of quads
/// across their common sides into as many rows all along, so that it stays conforming; other polygons into
/// quads, or from the middle of a side to the corner across; a quad that turns in at a corner is cut there
/// first. What a divided side lies on, a feature or the border, its pieces lie on; new vertices lie on the
/// surface. Nothing is changed where a piece would be folded, or where MeshOptions asks for triangles,
/// polygons of any degree or such as are not convex. \param report its counts are set anew \return whether
/// something was divided
bool divide_into_grids(const SurfaceRef& surface, const MeshOptions& options, size_t faces, size_t vertices,
                       OpenMesh::PolyMesh& result, MeshReport& report);

}  // namespace anisomesh::detail
