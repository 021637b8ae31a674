// The one place that asks whether a mesh is a disc, and hands it on as plain arrays.
#pragma once

#include "anisomesh/surface.hh"
#include "numerics/patch.hh"

namespace anisomesh::detail {

/// The surface as a patch; triangle i is face i, its corners in the order of SurfaceRef::corners().
/// \throw CannotProcess if it is not one disc, with counts and the way out
Patch patch_of(const SurfaceRef& surface);

}  // namespace anisomesh::detail
