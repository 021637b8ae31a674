// A mesh with what the stages left on it, as arrays for the page.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>
#include <map>
#include <string>

#include "anisomesh/surface.hh"
#include "view/binary.hh"

namespace view {

/// The box that all meshes of a page are drawn in: positions go as floats, relative to its centre and
/// diagonal, so that neither a far away origin nor a tiny unit costs digits.
struct Frame {
  OpenMesh::Vec3d centre{0, 0, 0};
  double scale = 1;  ///< its diagonal, model units
};
Frame frame_of(const anisomesh::SurfaceRef& surface);
Frame frame_of(const OpenMesh::PolyMesh& mesh);

struct Model {
  std::string role;  ///< surface or result
  std::string name;
  std::map<std::string, double> numbers;    ///< epsilon and the like
  std::map<std::string, Section> sections;  ///< only what the mesh carries
};

/// The input with whatever curvature, uv, umbilics, lines and samples it carries. Lines stay surface points
/// (face, barycentric), so that the page draws them in space and in the plane from one array.
/// \throw anisomesh::InvalidInput where lines do not fit the mesh
Model surface_model(const std::string& name, const anisomesh::SurfaceRef& surface, const Frame& frame);
/// The polygons with whatever origins, edge kinds and errors they carry.
Model result_model(const std::string& name, const OpenMesh::PolyMesh& mesh, const Frame& frame);

}  // namespace view
