// The points of a line that its drawing on the surface needs.
#pragma once

#include <vector>

#include "anisomesh/lines.hh"
#include "network/section_path.hh"

namespace anisomesh::detail {

/// Where a line runs through one triangle in many steps that are as good as straight, those between are left
/// out: each would be a corner of thin triangles, and the surface is flat there.
/// \param left_out gets the triangle of each of those
std::vector<Place> places_of(const SurfaceArrays& mesh, const SurfaceRef& surface, const Line& line,
                             std::vector<int>& left_out);

}  // namespace anisomesh::detail
