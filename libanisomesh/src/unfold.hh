// Takes folds out again that the fit or the balance has made.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>
#include <vector>

#include "anisomesh/surface.hh"

namespace anisomesh::detail {

/// Moves the corners of faces that are folded, as compare() judges it, half way to where they were built
/// from on the surface, and again, as long as that leaves no more. What still has more folds than the first
/// of the candidates gives way to the one before it. \param candidates each made from the one before \return
/// which of them was taken
size_t choose_unfolded(const SurfaceRef& surface, std::vector<OpenMesh::PolyMesh>& candidates);

}  // namespace anisomesh::detail
