// Takes folds out again that the fit or the balance has made.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>
#include <vector>

#include "anisomesh/surface.hh"

namespace anisomesh::detail {

/// Puts the corners of faces that are folded, as compare() judges it, back on the surface, where they were
/// built from, as long as that leaves fewer. What still has more folds than the first of the candidates gives
/// way to the one before it. \param candidates each made from the one before
/// \return which of them was taken
size_t choose_unfolded(const SurfaceRef& surface, std::vector<OpenMesh::PolyMesh>& candidates);

}  // namespace anisomesh::detail
