// The (u, v) plane as a drawing: the triangulation's border, lines, features, umbilics, samples, polygons.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>
#include <string>
#include <vector>

#include "anisomesh/surface.hh"

namespace view {

/// SVG text. \param result its vertices lie where build_polygons() says they come from; may be nullptr
/// \param layers what to draw, by name; empty: all that is there \param width of the drawing, pixels
/// \throw anisomesh::InvalidInput where the surface has no uv or the result no places on it
std::string plane_svg(const anisomesh::SurfaceRef& surface, const OpenMesh::PolyMesh* result,
                      const std::vector<std::string>& layers, double width = 1000);

}  // namespace view
