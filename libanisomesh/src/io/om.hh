// OpenMesh's own .om files, which carry every persistent property.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>
#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <string>

namespace anisomesh::detail {

/// Keeps OpenMesh from printing to stderr for a while: the library never prints.
class Quiet {
 public:
  Quiet();
  ~Quiet();
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  bool errors_, log_;
};

/// Whether an .om file holds nothing but triangles. \throw InvalidInput if it is no .om file
bool om_is_triangles(const std::string& text, const std::string& path);

OpenMesh::TriMesh read_om_triangles(const std::string& text, const std::string& path);
OpenMesh::PolyMesh read_om_polygons(const std::string& text, const std::string& path);

std::string om_text(const OpenMesh::TriMesh& mesh, const std::string& path);
std::string om_text(const OpenMesh::PolyMesh& mesh, const std::string& path);

}  // namespace anisomesh::detail
