#include "lines/surface_domain.hh"

#include <algorithm>
#include <cmath>

#include "anisomesh/charts.hh"
#include "field/chart_field.hh"
#include "field/surface_field.hh"
#include "lines/surface_index.hh"
#include "numerics/tensor2d.hh"
#include "surface/surface_walk.hh"

namespace anisomesh::detail {

namespace {

// The triangles of the charts, each scaled to its area: lengths of the edges opposite each corner.
std::vector<std::array<double, 3>> chart_lengths(const std::vector<std::array<Vec2d, 3>>& corners,
                                                 const UnfoldedFaces& unfolded) {
  std::vector<std::array<double, 3>> lengths(corners.size());
  for (size_t f = 0; f < lengths.size(); ++f) {
    const auto& c = corners[f];
    const double area = unfolded.area(static_cast<int>(f));
    const double scale = std::sqrt(area / (0.5 * cross2(c[1] - c[0], c[2] - c[0])));
    for (size_t i = 0; i < 3; ++i) lengths[f][i] = scale * (c[(i + 1) % 3] - c[(i + 2) % 3]).norm();
  }
  return lengths;
}

// `across` is set by the time UnfoldedFaces looks at it.
const std::vector<DomainFace>& with_across(const SurfaceRef& surface, std::vector<DomainFace>& faces) {
  set_across(surface, faces);
  return faces;
}

}  // namespace

SurfaceInput read_surface_input(const SurfaceRef& surface) {
  SurfaceInput input;
  SurfaceField field = surface_field(surface, read_surface_tensors(surface));
  if (has_charts(surface)) {
    ChartField charts = chart_field(surface, field);
    input.corner_tensors = std::move(charts.tensor);
    for (size_t f = 0; f < charts.corner.size(); ++f) {
      const Vec2d axis = charts.axis(f);
      for (Vec3d& tensor : input.corner_tensors[f]) tensor = rotated(tensor, {axis[0], -axis[1]});
      for (Vec2d& turn : charts.turn[f]) turn = turned_back(turn, axis);
    }
    input.chart_corners = std::move(charts.corner);
    input.chart_turns = std::move(charts.turn);
  } else {
    input.corner_tensors = corner_tensors_in_faces(surface, field);
  }
  input.umbilics = read_umbilics(surface, input.corner_tensors);
  input.corner_node = std::move(field.cut.corner_node);
  input.node_tensors = std::move(field.tensor);
  return input;
}

SurfaceDomain::SurfaceDomain(const SurfaceRef& surface, SurfaceInput input, const DensityOptions& density,
                             Follow follow)
    : FaceDomain(surface.connectivity().n_faces(), std::move(input.umbilics), density,
                 Density(density, surface.diagonal(), surface.extent(),
                         mean_curvature(surface, input.corner_tensors)),
                 follow),
      surface_(surface),
      unfolded_(surface, with_across(surface, faces_)),
      corner_tensors_(std::move(input.corner_tensors)) {
  if (!input.chart_corners.empty())
    charts_.emplace(surface, faces_, chart_lengths(input.chart_corners, unfolded_),
                    std::move(input.chart_turns));
  for (size_t f = 0; f < faces_.size(); ++f)
    for (size_t i = 0; i < 3; ++i) faces_[f].node[i] = input.corner_node[f][i];
  make_spacing(input.node_tensors, [this](size_t f, int i) {
    const int face = static_cast<int>(f);
    return (unfolded_.corner(face, (i + 1) % 3) - unfolded_.corner(face, i)).norm();
  });
  SurfaceFlood flood(unfolded_);
  register_umbilics([&](const SurfacePoint& at, double radius, const IsHidden& is_hidden) {
    std::vector<NearFace> found;
    flood.search(
        at, radius,
        [&](const SurfaceFlood::Visit& visit) {
          double farthest = 0;
          for (int i = 0; i < 3; ++i)
            farthest = std::max(farthest, (unfolded_.corner(visit.face, i) - visit.place).norm());
          found.push_back({visit.face, visit.place, farthest});
          return radius;
        },
        [&](int face, double distance) { return is_hidden(face, distance) ? radius : 0.0; });
    return found;
  });
  measure_fences();
}

void SurfaceDomain::measure_fences() {
  constexpr double kReach = 2.5;  // spacings
  const auto spacing_of = [this](int f) {
    const SurfacePoint centre{OpenMesh::FaceHandle(f), {1.0 / 3, 1.0 / 3, 1.0 / 3}};
    return std::max(spacing(LineKind::min, centre), spacing(LineKind::max, centre));
  };
  std::vector<SurfaceDistance::Source> fences;
  for (int f = 0; f < static_cast<int>(faces_.size()); ++f)
    for (int i = 0; i < 3; ++i) {
      if (unfolded_.across(f, i) >= 0) continue;
      const Vec2d a = unfolded_.corner(f, (i + 1) % 3), b = unfolded_.corner(f, (i + 2) % 3);
      fences.push_back({f, 0.5 * (a + b), 0.5 * (b - a).norm(), kReach * spacing_of(f)});
    }
  if (fences.empty()) return;
  fences_ = std::make_unique<SurfaceDistance>(unfolded_);
  fences_->add(fences);
}

Vec3d SurfaceDomain::tensor(const SurfacePoint& at) const {
  const auto& t = corner_tensors_[static_cast<size_t>(at.face.idx())];
  return followed(at.barycentric[0] * t[0] + at.barycentric[1] * t[1] + at.barycentric[2] * t[2], follow());
}

Vec3d SurfaceDomain::tensor_ahead(const SurfacePoint& from, const Vec2d& vector) const {
  const Reach reach = walk(from, vector);
  return rotated(tensor(reach.point), {reach.rotation[0], -reach.rotation[1]});
}

Reach SurfaceDomain::walk(const SurfacePoint& from, const Vec2d& vector) const {
  return walk_straight(ground(), from, vector, [](const PathPiece&) {});
}

Reach SurfaceDomain::walk_while(const SurfacePoint& from, const Vec2d& vector,
                                const std::function<bool(const WayPiece&)>& visit) const {
  return walk_straight_while(
      ground(), from, vector,
      [&](int face, int /*exit*/, const Vec3d& begin, const Vec3d& end, double left, double left_after) {
        return visit({face, {begin[1], begin[2]}, {end[1], end[2]}, 1 - left, 1 - left_after});
      });
}

LinearField SurfaceDomain::field(OpenMesh::FaceHandle face) const {
  const int f = face.idx();
  return {{ground().corner(f, 0), ground().corner(f, 1), ground().corner(f, 2)},
          corner_tensors_[static_cast<size_t>(f)]};
}

double SurfaceDomain::turning_length(const SurfacePoint& at) const {
  return detail::turning_length(field(at.face), tensor(at));
}

std::vector<Vec2d> SurfaceDomain::separatrices(const UmbilicPoint& umbilic, LineKind kind) const {
  return separatrix_directions(field(umbilic.point.face), umbilic, kind, follow(), first_step(umbilic, kind));
}

double SurfaceDomain::distance(const SurfacePoint& at, const Vec2d& place) const {
  return (unfolded_.place(at) - place).norm();
}

void SurfaceDomain::mark_within(const SurfacePoint& at, double /*radius*/, std::vector<char>& marks) const {
  // To tell the faces apart costs more than what it saves: a whole component, at once.
  if (marks[static_cast<size_t>(at.face.idx())]) return;
  std::vector<int> open{at.face.idx()};
  marks[static_cast<size_t>(at.face.idx())] = 1;
  while (!open.empty()) {
    const int f = open.back();
    open.pop_back();
    for (int i = 0; i < 3; ++i) {
      const int next = unfolded_.across(f, i);
      if (next < 0 || marks[static_cast<size_t>(next)]) continue;
      marks[static_cast<size_t>(next)] = 1;
      open.push_back(next);
    }
  }
}

std::unique_ptr<LineIndex> SurfaceDomain::make_index(
    const std::function<double(const SurfacePoint&)>& reach) const {
  return std::make_unique<SurfaceIndex>(surface_, unfolded_, fences_.get(), reach);
}

}  // namespace anisomesh::detail
