#include "anisomesh/surface.hh"

#include <cmath>
#include <string>

#include "anisomesh/errors.hh"

namespace anisomesh {

namespace {

void refuse_deleted_elements(const OpenMesh::TriConnectivity& mesh) {
  const auto refuse = [](const char* element, int index) {
    throw InvalidInput(std::string("the mesh has deleted elements (") + element + " " +
                       std::to_string(index) + " is one); call garbage_collection() first");
  };
  if (mesh.has_vertex_status())
    for (const auto v : mesh.all_vertices())
      if (mesh.status(v).deleted()) refuse("vertex", v.idx());
  if (mesh.has_face_status())
    for (const auto f : mesh.all_faces())
      if (mesh.status(f).deleted()) refuse("face", f.idx());
}

}  // namespace

SurfaceRef::SurfaceRef(OpenMesh::TriConnectivity& connectivity, std::vector<Vec3d> points)
    : connectivity_(&connectivity), points_(std::move(points)) {
  refuse_deleted_elements(connectivity);
  if (connectivity.n_faces() == 0) throw InvalidInput("the mesh has no faces");
  Vec3d low = points_.front(), high = points_.front();
  for (size_t i = 0; i < points_.size(); ++i) {
    const Vec3d& p = points_[i];
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      throw InvalidInput("vertex " + std::to_string(i) + " has a coordinate that is not finite");
    low.minimize(p);
    high.maximize(p);
  }
  diagonal_ = (high - low).norm();
}

Vec3d position(const SurfaceRef& surface, const SurfacePoint& point) {
  const auto corners = surface.corners(point.face);
  return point.barycentric[0] * surface.point(corners.vertex[0]) +
         point.barycentric[1] * surface.point(corners.vertex[1]) +
         point.barycentric[2] * surface.point(corners.vertex[2]);
}

}  // namespace anisomesh
