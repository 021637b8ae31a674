// Meshes that nothing can be computed on.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>
#include <string>

#include "anisomesh/surface.hh"

namespace anisomesh::detail {

/// \param name of the mesh in the message \throw InvalidInput where elements are deleted
void refuse_deleted_elements(const OpenMesh::PolyConnectivity& mesh, const std::string& name);

/// The surface itself. \throw InvalidInput where its mesh has got or lost elements since the view was made
const SurfaceRef& unchanged(const SurfaceRef& surface);

/// \throw InvalidInput where a result has no faces, deleted elements, or a point that is not finite
void refuse_unfit_result(const OpenMesh::PolyMesh& result);

}  // namespace anisomesh::detail
