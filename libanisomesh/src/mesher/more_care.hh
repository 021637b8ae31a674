// What is done otherwise around polygons that are not sound, when all is meshed again: at first the
// tolerances hold less there, at last the triangles of the input are kept.
#pragma once

#include <vector>

#include "network/network_graph.hh"
#include "surface/surface_locator.hh"

namespace anisomesh::detail {

constexpr size_t patience = 4;  ///< retries, before vertices are given up for sound polygons

/// Halves the share of the tolerances that holds near some polygons. Isotropic samples that no tolerance
/// moves need not stay any longer. \param network that the polygons are of \param start the network that is
/// decimated next
void take_more_care(const std::vector<std::vector<int>>& polygons, const NetworkGraph& network,
                    size_t retries, NetworkGraph& start);

/// Marks the triangles of the surface that some polygons lie on.
/// \param kept by face; empty, or what is marked already \return whether there is one more
bool keep_triangles_at(const std::vector<std::vector<int>>& polygons, const NetworkGraph& network,
                       const SurfaceRef& surface, const SurfaceLocator& locator, std::vector<char>& kept);

}  // namespace anisomesh::detail
