#include "mesher/line_directions.hh"

#include "anisomesh/properties.hh"
#include "field/linear_field.hh"
#include "numerics/tensor2d.hh"
#include "numerics/tensor3d.hh"

namespace anisomesh::detail {

namespace {
// Curvature times the extent: what is flat but for rounding has no directions.
constexpr double least_bend = 1e-6;
}  // namespace

LineDirections::LineDirections(const SurfaceRef& surface) : surface_(surface) {
  const auto& mesh = surface.connectivity();
  const bool smoothed = has_property(mesh, property::surface_tensor);
  if (!smoothed && !has_property(mesh, property::tensor)) return;
  const auto tensor = require_property(mesh, smoothed ? property::surface_tensor : property::tensor);
  tensors_.reserve(mesh.n_vertices());
  for (const auto v : mesh.vertices()) tensors_.push_back(mesh.property(tensor, v));
  if (has_property(mesh, property::follow))
    follow_ = static_cast<Follow>(mesh.property(require_property(mesh, property::follow)));
}

double LineDirections::misalignment(const SurfacePoint& point, const Vec3d& along) const {
  if (tensors_.empty()) return 0;
  const auto corners = surface_.corners(point.face);
  const Vec3d &p = surface_.point(corners.vertex[0]), &q = surface_.point(corners.vertex[1]),
              &r = surface_.point(corners.vertex[2]);
  const Vec3d normal = cross(q - p, r - p);
  const double area = normal.norm();
  if (!(area > 0)) return 0;
  Vec6d sum(0.0);
  for (size_t k = 0; k < 3; ++k)
    sum += point.barycentric[k] * tensors_[static_cast<size_t>(corners.vertex[k].idx())];
  const TangentFrame frame(normal / area);
  const Vec3d t = followed(in_frame(sum, frame), follow_);
  const double sure = orientation(t).certainty(), norm = deviator_norm(t);
  if (!(sure > 0) || !(norm * surface_.extent() > least_bend)) return 0;
  // The deviator and the edge, both by twice their angle.
  const double a = along | frame.u, b = along | frame.v, squared = a * a + b * b;
  if (!(squared > 0)) return 0;
  const Vec2d d = deviator(t);
  const double sine = (d[0] * 2 * a * b - d[1] * (a * a - b * b)) / (norm * squared);
  return sure * sine * sine;
}

}  // namespace anisomesh::detail
