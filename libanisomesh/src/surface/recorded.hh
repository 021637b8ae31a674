// What an earlier stage has left on a mesh.
#pragma once

#include "anisomesh/properties.hh"

namespace anisomesh::detail {

template <class T>
T recorded(const OpenMesh::TriConnectivity& mesh, const property::OnMesh<T>& declaration, T otherwise) {
  return has_property(mesh, declaration) ? mesh.property(require_property(mesh, declaration)) : otherwise;
}

}  // namespace anisomesh::detail
