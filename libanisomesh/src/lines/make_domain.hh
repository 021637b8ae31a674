// Which domain a mesh is processed in.
#pragma once

#include <memory>

#include "lines/face_domain.hh"

namespace anisomesh::detail {

/// The plane where flatten() has run, else the surface itself. Reads: what trace_lines() reads.
/// \throw InvalidInput
std::unique_ptr<FaceDomain> make_domain(const SurfaceRef& surface, const DensityOptions& density,
                                        Follow follow = Follow::curvature);

}  // namespace anisomesh::detail
