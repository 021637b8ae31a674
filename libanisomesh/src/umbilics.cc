#include "anisomesh/umbilics.hh"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "anisomesh/flatten.hh"
#include "anisomesh/properties.hh"
#include "anisomesh/smoothing.hh"
#include "cut_surface.hh"
#include "numerics/tensor2d.hh"
#include "surface_umbilics.hh"
#include "umbilic_analysis.hh"

namespace anisomesh {

namespace {

using namespace detail;
constexpr double pi = 3.14159265358979323846;
using CornerDeviators = std::vector<std::array<Vec2d, 3>>;

/// Deviators at the corners of every face; those far below anything a surface of this size shows are rounding
/// and become 0, so that a plane has no umbilics at all.
CornerDeviators corner_deviators(const SurfaceRef& surface) {
  const auto tensors = corner_tensors(surface);
  double largest = 0;
  for (const auto& face : tensors)
    for (const auto& tensor : face) largest = std::max(largest, frobenius_norm(tensor));
  const double negligible = std::max(1e-10 * largest, 1e-7 / surface.diagonal());
  CornerDeviators result(tensors.size());
  for (size_t f = 0; f < tensors.size(); ++f)
    for (size_t i = 0; i < 3; ++i)
      result[f][i] = deviator_norm(tensors[f][i]) > negligible ? deviator(tensors[f][i]) : Vec2d(0, 0);
  return result;
}

/// The angle from a to b, radians. Where that is half a turn to the last bit, or one of the two is 0, the
/// side is the one the indices are counted by: the zero moved by an infinitesimal amount to (+, +).
double turn(const Vec2d& a, const Vec2d& b) {
  const double cross = cross2(a, b), dot = a | b;
  if (cross != 0 || dot > 0) return std::atan2(cross, dot);
  const auto angle = [](const Vec2d& d) {  // in (0, 2 pi]; counted from the positive axis
    if (d[1] == 0) return d[0] > 0 ? 2 * pi : pi;
    return d[1] > 0 ? std::atan2(d[1], d[0]) : 2 * pi + std::atan2(d[1], d[0]);
  };
  return angle(b) - angle(a) + 2 * pi * doubled_index_of_edge(a, b);
}

/// Turns of the principal directions along the border and both sides of the features, the surface on the
/// left, by adding up angles: not the way the indices are found, so that the two can be compared.
double turning_of_border(const SurfaceRef& surface, const CornerDeviators& deviators) {
  const auto& mesh = surface.connectivity();
  double radians = 0;
  for (const auto f : mesh.all_faces()) {
    auto h = mesh.halfedge_handle(f);  // from corner 2 to corner 0
    for (size_t i = 0; i < 3; ++i, h = mesh.next_halfedge_handle(h)) {
      if (!mesh.is_boundary(mesh.opposite_halfedge_handle(h)) && !is_feature(mesh, mesh.edge_handle(h)))
        continue;
      const auto& corner = deviators[static_cast<size_t>(f.idx())];
      const Vec2d &a = corner[(i + 2) % 3], &b = corner[i];
      radians += turn(a, b);
    }
  }
  return radians / (4 * pi);  // the deviator turns twice as fast as the directions
}

/// In the plane, where one frame does for all.
SurfaceUmbilics umbilics_in_plane(const SurfaceRef& surface) {
  const auto deviators = corner_deviators(surface);
  SurfaceUmbilics result;
  result.doubled_index.assign(deviators.size(), 0);
  result.position.assign(deviators.size(), Vec3d(0, 0, 0));
  for (size_t f = 0; f < deviators.size(); ++f) {
    result.doubled_index[f] = doubled_index(deviators[f]);
    if (result.doubled_index[f] != 0) result.position[f] = degenerate_point(deviators[f]);
  }
  result.turning = turning_of_border(surface, deviators);
  return result;
}

}  // namespace

UmbilicReport find_umbilics(const SurfaceRef& surface) {
  const auto start = std::chrono::steady_clock::now();
  auto& mesh = surface.connectivity();
  const auto found =
      is_flattened(surface)
          ? umbilics_in_plane(surface)
          : umbilics_on_surface(surface, surface_field(surface, read_surface_tensors(surface)));
  UmbilicReport report;
  for (const int halves : found.doubled_index)
    (halves > 0 ? report.wedges : report.trisectors) += static_cast<size_t>(std::abs(halves));
  report.index_sum = 0.5 * (static_cast<double>(report.wedges) - static_cast<double>(report.trisectors));
  report.border_turning = found.turning;

  const auto umbilic = provide_property(mesh, property::umbilic);
  const auto umbilic_position = provide_property(mesh, property::umbilic_position);
  for (const auto f : mesh.all_faces()) {
    mesh.property(umbilic, f) = found.doubled_index[static_cast<size_t>(f.idx())];
    mesh.property(umbilic_position, f) = found.position[static_cast<size_t>(f.idx())];
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace anisomesh
