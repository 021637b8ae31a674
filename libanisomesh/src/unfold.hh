// Takes folds out again that the fit or the balance has made.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>
#include <vector>

#include "anisomesh/surface.hh"

namespace anisomesh::detail {

/// Moves the corners of faces that are folded, as compare() judges it, half way to where they were built
/// from on the surface, and again, as long as that leaves no more. Those that stay are parted anew with
/// polygons beside them, or without one of their corners.
/// \param candidates each made from the one in front of it, and the first from `before`
/// \return the index of the last one that has no more folds than `before` then; -1 if there is none
int choose_unfolded(const SurfaceRef& surface, const OpenMesh::PolyMesh& before,
                    std::vector<OpenMesh::PolyMesh>& candidates);

}  // namespace anisomesh::detail
