#include "surface_domain.hh"

#include <algorithm>

#include "numerics/tensor2d.hh"
#include "surface_field.hh"
#include "surface_index.hh"
#include "surface_walk.hh"

namespace anisomesh::detail {

namespace {

// `across` is set by the time UnfoldedFaces looks at it.
const std::vector<DomainFace>& with_across(const SurfaceRef& surface, std::vector<DomainFace>& faces) {
  set_across(surface, faces);
  return faces;
}

}  // namespace

SurfaceInput read_surface_input(const SurfaceRef& surface) {
  SurfaceInput input;
  SurfaceField field = surface_field(surface, read_surface_tensors(surface));
  input.corner_tensors = corner_tensors_in_faces(surface, field);
  input.umbilics = read_umbilics(surface, input.corner_tensors);
  input.corner_node = std::move(field.cut.corner_node);
  input.node_tensors = std::move(field.tensor);
  return input;
}

SurfaceDomain::SurfaceDomain(const SurfaceRef& surface, SurfaceInput input, const DensityOptions& density)
    : FaceDomain(surface.connectivity().n_faces(), std::move(input.umbilics), density,
                 Density(density, surface.diagonal(), mean_curvature(surface, input.corner_tensors))),
      surface_(surface),
      unfolded_(surface, with_across(surface, faces_)),
      corner_tensors_(std::move(input.corner_tensors)) {
  for (size_t f = 0; f < faces_.size(); ++f)
    for (size_t i = 0; i < 3; ++i) faces_[f].node[i] = input.corner_node[f][i];
  make_spacing(input.node_tensors, [this](size_t f, int i) {
    const int face = static_cast<int>(f);
    return (unfolded_.corner(face, (i + 1) % 3) - unfolded_.corner(face, i)).norm();
  });
  SurfaceFlood flood(unfolded_);
  register_umbilics([&flood](const SurfacePoint& at, double radius) {
    std::vector<NearEntry> entries;
    flood.run(at, radius, [&](const SurfaceFlood::Visit& visit) {
      entries.push_back({visit.face, -1, visit.place});
      return radius;
    });
    return entries;
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
  return at.barycentric[0] * t[0] + at.barycentric[1] * t[1] + at.barycentric[2] * t[2];
}

Vec3d SurfaceDomain::tensor_ahead(const SurfacePoint& from, const Vec2d& vector) const {
  const Reach reach = walk(from, vector);
  return rotated(tensor(reach.point), {reach.rotation[0], -reach.rotation[1]});
}

Reach SurfaceDomain::walk(const SurfacePoint& from, const Vec2d& vector) const {
  return walk_straight(unfolded_, from, vector, [](const PathPiece&) {});
}

LinearField SurfaceDomain::field(OpenMesh::FaceHandle face) const {
  const int f = face.idx();
  return {{unfolded_.corner(f, 0), unfolded_.corner(f, 1), unfolded_.corner(f, 2)},
          corner_tensors_[static_cast<size_t>(f)]};
}

double SurfaceDomain::turning_length(const SurfacePoint& at) const {
  return detail::turning_length(field(at.face), tensor(at));
}

std::vector<Vec2d> SurfaceDomain::separatrices(const UmbilicPoint& umbilic, LineKind kind) const {
  return separatrix_directions(field(umbilic.point.face), umbilic.index, kind);
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
