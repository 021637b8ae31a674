// Takes folds and the like out again that the fit or the balance has made.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>
#include <vector>

#include "anisomesh/surface.hh"
#include "compare/compare_parts.hh"

namespace anisomesh::detail {

/// Mends faces that are folded, concave or without area, as compare() judges it: moves their corners half way
/// to where they were built from on the surface, and again, as long as that leaves no more; then parts them
/// anew.
/// \param reference of `surface` \param candidates each made from the one in front of it; where the first has
/// concave faces, these are none \return the index of the last one that has no such faces then, or else the
/// fewest
int choose_unfolded(const SurfaceRef& surface, const ReferenceSurface& reference,
                    std::vector<OpenMesh::PolyMesh>& candidates);

}  // namespace anisomesh::detail
