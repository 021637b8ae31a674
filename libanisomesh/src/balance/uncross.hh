// Takes out what the mesher, the fit or the balance has made to cross other parts of the result.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>

#include "anisomesh/surface.hh"
#include "balance/mending.hh"

namespace anisomesh::detail {

/// Where two faces of the result cross or overlap, and the surface does not do so itself there: moves a
/// corner back to where it was built from, half way or all of it, or parts one of them anew with its
/// neighbours, where that leaves fewer crossings and breaks no face.
void uncross(const SurfaceRef& surface, const FaceJudge& judge, OpenMesh::PolyMesh& result);

}  // namespace anisomesh::detail
