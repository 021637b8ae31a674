#include "anisomesh/flatten.hh"

#include <algorithm>
#include <chrono>
#include <string>

#include "anisomesh/errors.hh"
#include "anisomesh/properties.hh"
#include "numerics/conformal_map.hh"
#include "numerics/planar_map.hh"
#include "numerics/tensor2d.hh"
#include "numerics/triangle_jacobian.hh"
#include "patch_of.hh"

namespace anisomesh {

namespace {

using namespace detail;

/// The first map that is one to one: the free border, then borders ever more like a circle as long as they
/// cross themselves, then the disc.
std::vector<Vec2d> valid_map(const Patch& patch, FlattenReport& report, const Progress& progress) {
  const auto shapes = triangle_shapes(patch);
  for (const double roundness : {0.0, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9}) {
    auto map = boundary_first_map(patch, shapes, roundness);
    report_progress(progress, 0.6);
    report.border_roundness = roundness;
    report.repaired_triangles = invalid_triangles(patch, map).size();
    if (!repair(patch, shapes, map)) break;
    if (border_is_simple(patch, map)) return map;
  }
  report.free_boundary = false;
  report.border_roundness = 1;
  auto map = disc_map(patch, shapes);
  report.repaired_triangles = invalid_triangles(patch, map).size();
  if (repair(patch, shapes, map) && border_is_simple(patch, map)) return map;
  const auto invalid = invalid_triangles(patch, map);
  throw CannotProcess(
      "no one-to-one conformal map of the patch was found: " + std::to_string(invalid.size()) +
      " triangle(s) stay flipped or too small for double precision" +
      (invalid.empty() ? std::string() : ", the first is face " + std::to_string(invalid.front())) +
      "; cut long features off, or the patch into shorter ones");
}

std::vector<TriangleJacobian> jacobians(const Patch& patch, const std::vector<Vec2d>& map) {
  std::vector<TriangleJacobian> result;
  result.reserve(patch.triangles.size());
  for (const auto& t : patch.triangles) {
    const auto a = static_cast<size_t>(t[0]), b = static_cast<size_t>(t[1]), c = static_cast<size_t>(t[2]);
    result.push_back(
        triangle_jacobian(patch.points[a], patch.points[b], patch.points[c], map[a], map[b], map[c]));
  }
  return result;
}

/// Moments of the border, weighed by length: their principal axis becomes the u axis.
struct BorderFrame {
  Vec2d centre{0, 0}, axis{1, 0};
};

BorderFrame border_frame(const Patch& patch, const std::vector<Vec2d>& map) {
  const size_t n = patch.border.size();
  const auto place = [&](size_t i) -> const Vec2d& { return map[static_cast<size_t>(patch.border[i % n])]; };
  BorderFrame frame;
  double total = 0;
  for (size_t i = 0; i < n; ++i) {
    const double length = (place(i + 1) - place(i)).norm();
    frame.centre += 0.5 * length * (place(i) + place(i + 1));
    total += length;
  }
  frame.centre /= total;
  Vec3d second(0, 0, 0);
  for (size_t i = 0; i < n; ++i) {
    const double length = (place(i + 1) - place(i)).norm();
    const Vec2d p = 0.5 * (place(i) + place(i + 1)) - frame.centre;
    second += length * Vec3d(p[0] * p[0], p[0] * p[1], p[1] * p[1]);
  }
  frame.axis = max_direction(second);
  const Vec2d across(-frame.axis[1], frame.axis[0]);
  double skew = 0, skew_across = 0, size = 0;  // third moments tell one end of the axis from the other
  for (size_t i = 0; i < n; ++i) {
    const double length = (place(i + 1) - place(i)).norm();
    const Vec2d p = 0.5 * (place(i) + place(i + 1)) - frame.centre;
    skew += length * std::pow(p | frame.axis, 3);
    skew_across += length * std::pow(p | across, 3);
    size += length * std::pow(p.norm(), 3);
  }
  if (std::abs(skew) < 1e-6 * size) skew = skew_across;
  if (skew < 0) frame.axis = -frame.axis;
  return frame;
}

/// Centres the map on its border, turns its longer axis to u and scales it to the area of the surface.
void normalize(const Patch& patch, std::vector<Vec2d>& map) {
  double plane = 0, surface = 0;
  for (size_t t = 0; t < patch.triangles.size(); ++t) {
    plane += signed_area(patch, map, t);
    const auto& p = patch.points;
    const auto& c = patch.triangles[t];
    surface += 0.5 * ((p[static_cast<size_t>(c[1])] - p[static_cast<size_t>(c[0])]) %
                      (p[static_cast<size_t>(c[2])] - p[static_cast<size_t>(c[0])]))
                         .norm();
  }
  const auto frame = border_frame(patch, map);
  const double scale = std::sqrt(surface / plane);
  for (Vec2d& p : map) {
    const Vec2d q = p - frame.centre;
    p = scale * Vec2d(q | frame.axis, cross2(frame.axis, q));
  }
}

std::vector<double> area_stretches(const Patch& patch, const std::vector<TriangleJacobian>& faces) {
  std::vector<double> plane(patch.points.size(), 0.0), surface(patch.points.size(), 0.0);
  for (size_t t = 0; t < faces.size(); ++t) {
    const double in_plane =
        faces[t].area * (std::norm(faces[t].conformal) - std::norm(faces[t].anticonformal));
    for (const int v : patch.triangles[t]) {
      plane[static_cast<size_t>(v)] += in_plane;
      surface[static_cast<size_t>(v)] += faces[t].area;
    }
  }
  for (size_t v = 0; v < plane.size(); ++v)  // a star without area on the surface: the mean of the whole map
    plane[v] = surface[v] > 0 ? plane[v] / surface[v] : 1;
  return plane;
}

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

void measure(const std::vector<TriangleJacobian>& faces, const std::vector<double>& stretch,
             FlattenReport& report) {
  double sum = 0, area = 0;
  for (const auto& j : faces) {
    if (!(j.area > 0)) continue;
    const double conformal = std::abs(j.conformal), rest = std::abs(j.anticonformal);
    const double ratio = (conformal + rest) / (conformal - rest);
    sum += j.area * ratio;
    area += j.area;
    report.max_conformal_distortion = std::max(report.max_conformal_distortion, ratio);
  }
  report.mean_conformal_distortion = sum / area;
  const auto [low, high] = std::minmax_element(stretch.begin(), stretch.end());
  report.min_area_stretch = *low;
  report.max_area_stretch = *high;
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
