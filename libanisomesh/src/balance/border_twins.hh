// Vertices of a result that are in one place on borders which lie on one another, as on the two sides of a
// slit: they go the same way.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>
#include <vector>

#include "anisomesh/surface.hh"

namespace anisomesh::detail {

/// Groups of vertices on the border at the very same point, each of two at least.
std::vector<std::vector<int>> border_twins(const OpenMesh::PolyMesh& mesh);

}  // namespace anisomesh::detail
