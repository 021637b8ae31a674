#include "surface/unfit_mesh.hh"

#include <cmath>

#include "anisomesh/errors.hh"

namespace anisomesh::detail {

void refuse_deleted_elements(const OpenMesh::PolyConnectivity& mesh, const std::string& name) {
  const auto refuse = [&](const char* element, int index) {
    throw InvalidInput(name + " has deleted elements (" + element + " " + std::to_string(index) +
                       " is one); call garbage_collection() first");
  };
  if (mesh.has_vertex_status())
    for (const auto v : mesh.all_vertices())
      if (mesh.status(v).deleted()) refuse("vertex", v.idx());
  if (mesh.has_face_status())
    for (const auto f : mesh.all_faces())
      if (mesh.status(f).deleted()) refuse("face", f.idx());
}

const SurfaceRef& unchanged(const SurfaceRef& surface) {
  const auto& mesh = surface.connectivity();
  refuse_deleted_elements(mesh, "the mesh");
  if (mesh.n_vertices() != surface.points().size())
    throw InvalidInput("the mesh had " + std::to_string(surface.points().size()) +
                       " vertices when the SurfaceRef was made and has " + std::to_string(mesh.n_vertices()) +
                       " now; make a new one");
  return surface;
}

void refuse_unfit_result(const OpenMesh::PolyMesh& result) {
  refuse_deleted_elements(result, "the result");
  if (result.n_faces() == 0) throw InvalidInput("the result has no faces");
  for (const auto v : result.vertices())
    for (const double x : result.point(v))
      if (!std::isfinite(x))
        throw InvalidInput("vertex " + std::to_string(v.idx()) +
                           " of the result has a coordinate that is not finite");
}

}  // namespace anisomesh::detail
