// Quads that one normal is too few for.
#pragma once

#include "balance/patch_mesh.hh"
#include "fit/fit_state.hh"

namespace anisomesh::detail {

/// Splits quads into the triangles that distances to them are measured on, where that takes out at least
/// `gain` times what a polygon's normal is off on the mean; those first that gain most, as long as the share
/// of quads does not fall below `least_quads`. The surface stays, and with it every distance.
/// \param mesh what `fit` was made of, with its polygons in the same order \return quads split
size_t split_bent_quads(const FitState& fit, const FitInput& input, double gain, double least_quads,
                        PatchMesh& mesh);

}  // namespace anisomesh::detail
