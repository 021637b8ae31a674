#include "anisomesh/umbilics.hh"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "anisomesh/charts.hh"
#include "anisomesh/flatten.hh"
#include "anisomesh/properties.hh"
#include "anisomesh/smoothing.hh"
#include "field/chart_field.hh"
#include "field/surface_umbilics.hh"
#include "field/umbilic_analysis.hh"
#include "numerics/tensor2d.hh"
#include "surface/canonical_copy.hh"

namespace anisomesh {

namespace {

using namespace detail;
constexpr double pi = 3.14159265358979323846;
using CornerDeviators = std::vector<std::array<Vec2d, 3>>;

/// Deviators at the corners of every face; those far below anything a surface of this size shows are rounding
/// and become 0, so that a plane has no umbilics at all.
CornerDeviators corner_deviators(const SurfaceRef& surface,
                                 const std::vector<std::array<Vec3d, 3>>& tensors) {
  double largest = 0;
  for (const auto& face : tensors)
    for (const auto& tensor : face) largest = std::max(largest, frobenius_norm(tensor));
  const double negligible = std::max(1e-10 * largest, 1e-7 / surface.extent());
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
/// left, by adding up angles: not the way the indices are found, so that the two can be compared. In charts
/// seams count as features.
double turning_of_border(const FaceSides& sides, const std::vector<char>& seam,
                         const CornerDeviators& deviators) {
  double radians = 0;
  for (size_t side = 0; side < sides.twin.size(); ++side) {
    if (sides.twin[side] >= 0 && !sides.feature[side] && (seam.empty() || !seam[side])) continue;
    const auto& corner = deviators[side / 3];
    radians += turn(corner[side % 3], corner[(side % 3 + 1) % 3]);
  }
  return radians / (4 * pi);  // the deviator turns twice as fast as the directions
}

/// In a plane, where one frame does for all faces, or in the planes of charts.
SurfaceUmbilics umbilics_in_planes(const CornerDeviators& deviators) {
  SurfaceUmbilics result;
  result.doubled_index.reserve(deviators.size());
  result.position.assign(deviators.size(), Vec3d(0, 0, 0));
  for (const auto& face : deviators) result.doubled_index.push_back(doubled_index(face));
  return result;
}

void place_umbilics(const CornerDeviators& deviators, SurfaceUmbilics& result) {
  for (size_t f = 0; f < deviators.size(); ++f)
    if (result.doubled_index[f] != 0) result.position[f] = degenerate_point(deviators[f]);
}

SurfaceUmbilics umbilics_in_plane(const SurfaceRef& surface) {
  const auto deviators = corner_deviators(surface, corner_tensors(surface));
  auto result = umbilics_in_planes(deviators);
  place_umbilics(deviators, result);
  result.turning = turning_of_border(FaceSides(surface), {}, deviators);
  return result;
}

/// The two sides of a seam see the field in frames that differ by a turn, which goes over from that at one
/// end to that at the other. The second side takes the field to go round as the first does, so that each
/// umbilic is counted once and the indices of a closed surface add up to its Euler characteristic.
SurfaceUmbilics umbilics_in_charts(const SurfaceRef& surface) {
  const auto charts = chart_field(surface, surface_field(surface, read_surface_tensors(surface)));
  const auto deviators = corner_deviators(surface, charts.tensor);
  // Where there is none the field has a direction all the same, one for all charts that meet there.
  auto directions = deviators;
  for (size_t f = 0; f < directions.size(); ++f)
    for (size_t i = 0; i < 3; ++i)
      if (directions[f][i] == Vec2d(0, 0))
        directions[f][i] = deviator(rotated(Vec3d(1, 0, -1), charts.turn[f][i]));
  const auto bends = seam_bends(charts);
  auto result = umbilics_in_planes(directions);
  int corrections = 0;
  const auto turn_along = [&](int side) {
    const auto at = [&](int c) { return directions[static_cast<size_t>(c / 3)][static_cast<size_t>(c % 3)]; };
    return turn(at(side), at(next_side(side)));
  };
  for (int side = 0; side < static_cast<int>(charts.seam.size()); ++side) {
    const int twin = charts.sides.twin[static_cast<size_t>(side)];
    if (!charts.seam[static_cast<size_t>(side)] || charts.sides.feature[static_cast<size_t>(side)] ||
        twin < side)
      continue;
    // By how much more than the edge a frame is turned at its two ends; twice that for deviators.
    const double change = bends[static_cast<size_t>(side)] + bends[static_cast<size_t>(twin)];
    const double seen = 2 * change - turn_along(side) - turn_along(twin);
    const auto turns = static_cast<int>(std::lround(seen / (2 * pi)));
    result.doubled_index[static_cast<size_t>(twin / 3)] += turns;
    corrections += turns;
  }
  place_umbilics(deviators, result);
  result.turning = turning_of_border(charts.sides, charts.seam, directions) + 0.5 * corrections;
  return result;
}

}  // namespace

UmbilicReport find_umbilics(const SurfaceRef& surface) {
  if (!surface.canonical_copy())
    return detail::in_canonical_order(surface,
                                      [&](const SurfaceRef& ordered) { return find_umbilics(ordered); });
  const auto start = std::chrono::steady_clock::now();
  auto& mesh = surface.connectivity();
  const auto found =
      is_flattened(surface) ? umbilics_in_plane(surface)
      : has_charts(surface)
          ? umbilics_in_charts(surface)
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
