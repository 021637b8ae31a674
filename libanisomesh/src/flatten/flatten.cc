#include "anisomesh/flatten.hh"

#include <chrono>
#include <string>

#include "anisomesh/errors.hh"
#include "anisomesh/properties.hh"
#include "flatten/patch_map.hh"
#include "flatten/patch_of.hh"
#include "numerics/tensor2d.hh"
#include "surface/canonical_copy.hh"

namespace anisomesh {

namespace {

using namespace detail;

/// A right-handed tangent frame.
struct TangentFrame {
  Vec3d x, y;
};

TangentFrame tangent_frame(const Vec3d& normal) {
  const Vec3d helper = std::abs(normal[0]) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
  const Vec3d x = (helper - normal * (helper | normal)).normalized();
  return {x, normal % x};
}

/// The rotation from the tangent frame of each vertex to the (u, v) frame: the mean over the faces around it
/// of "unfold the tangent plane onto the face, then turn as the face's map turns". The paper takes one 1-ring
/// edge instead; the mean measures better, see docs/flatten.md.
std::vector<std::complex<double>> rotations_to_plane(const Patch& patch,
                                                     const std::vector<TriangleJacobian>& faces,
                                                     const std::vector<TangentFrame>& frames) {
  std::vector<std::complex<double>> rotation(frames.size(), 0.0);
  for (size_t t = 0; t < faces.size(); ++t) {
    const auto& j = faces[t];
    const double length = std::abs(j.conformal);
    if (!(length > 0)) continue;
    const std::complex<double> turn = j.area * j.conformal / length;
    for (const int v : patch.triangles[t]) {
      const auto& frame = frames[static_cast<size_t>(v)];
      // The rotation nearest to the projection of the tangent plane onto the face's plane.
      const std::complex<double> unfold((frame.x | j.x) + (frame.y | j.y), (frame.x | j.y) - (frame.y | j.x));
      rotation[static_cast<size_t>(v)] += unfold * turn;
    }
  }
  for (auto& r : rotation) r = std::abs(r) > 0 ? r / std::abs(r) : 1.0;
  return rotation;
}

std::vector<Vec3d> tensors_in_plane(const SurfaceRef& surface, const Patch& patch,
                                    const std::vector<TriangleJacobian>& faces) {
  auto& mesh = surface.connectivity();
  const auto normal = require_property(mesh, property::normal);
  const auto tensor = require_property(mesh, property::tensor);
  std::vector<TangentFrame> frames(mesh.n_vertices());
  for (const auto v : mesh.all_vertices())
    frames[static_cast<size_t>(v.idx())] = tangent_frame(mesh.property(normal, v));
  const auto rotation = rotations_to_plane(patch, faces, frames);
  std::vector<Vec3d> result(frames.size());
  for (const auto v : mesh.all_vertices()) {
    const auto i = static_cast<size_t>(v.idx());
    const auto& t = mesh.property(tensor, v);
    const auto times = [&t](const Vec3d& w) {
      return Vec3d(t[0] * w[0] + t[1] * w[1] + t[2] * w[2], t[1] * w[0] + t[3] * w[1] + t[4] * w[2],
                   t[2] * w[0] + t[4] * w[1] + t[5] * w[2]);
    };
    const Vec3d tx = times(frames[i].x), ty = times(frames[i].y);
    result[i] = rotated(Vec3d(frames[i].x | tx, frames[i].x | ty, frames[i].y | ty),
                        {rotation[i].real(), rotation[i].imag()});
  }
  return result;
}

/// OpenMesh's own texture coordinates, where the mesh has them, in either precision.
template <class TexCoord>
void write_texture_coordinates(OpenMesh::TriConnectivity& mesh, const std::vector<Vec2d>& map) {
  OpenMesh::VPropHandleT<TexCoord> handle;
  if (!mesh.get_property_handle(handle, "v:texcoords2D")) return;
  using Scalar = typename TexCoord::value_type;
  for (const auto v : mesh.all_vertices()) {
    const Vec2d& p = map[static_cast<size_t>(v.idx())];
    mesh.property(handle, v) = TexCoord(static_cast<Scalar>(p[0]), static_cast<Scalar>(p[1]));
  }
}

}  // namespace

FlattenReport flatten(const SurfaceRef& surface, const Progress& progress) {
  if (!surface.canonical_copy())
    return detail::in_canonical_order(surface,
                                      [&](const SurfaceRef& ordered) { return flatten(ordered, progress); });
  const auto start = std::chrono::steady_clock::now();
  auto& mesh = surface.connectivity();
  require_property(mesh, property::normal);  // before the work, not after it
  require_property(mesh, property::tensor);
  report_progress(progress, 0);

  FlattenReport report;
  const Patch patch = patch_of(surface);
  auto map = valid_map(patch, report, progress);
  normalize(patch, map);
  const auto faces = jacobians(patch, map);
  const auto stretch = area_stretches(patch, faces);
  const auto tensors = tensors_in_plane(surface, patch, faces);
  measure(faces, stretch, report);
  report_progress(progress, 1);

  const auto uv = provide_property(mesh, property::uv);
  const auto area_stretch = provide_property(mesh, property::area_stretch);
  const auto tensor2d = provide_property(mesh, property::tensor2d);
  for (const auto v : mesh.all_vertices()) {
    const auto i = static_cast<size_t>(v.idx());
    mesh.property(uv, v) = map[i];
    mesh.property(area_stretch, v) = stretch[i];
    mesh.property(tensor2d, v) = tensors[i];
  }
  write_texture_coordinates<OpenMesh::Vec2f>(mesh, map);
  write_texture_coordinates<Vec2d>(mesh, map);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

bool is_flattened(const SurfaceRef& surface) { return has_property(surface.connectivity(), property::uv); }

void unflatten(const SurfaceRef& surface) {
  auto& mesh = surface.connectivity();
  const auto remove = [&mesh](auto declaration) {
    if (has_property(mesh, declaration)) {
      auto handle = require_property(mesh, declaration);
      mesh.remove_property(handle);
    }
  };
  remove(property::uv);
  remove(property::area_stretch);
  remove(property::tensor2d);
}

}  // namespace anisomesh
