#include "lines/face_domain.hh"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>

#include "anisomesh/features.hh"
#include "anisomesh/properties.hh"
#include "surface/intrinsic_order.hh"

namespace anisomesh::detail {

namespace {

// The halfedge opposite corner i, in the order of SurfaceRef::corners().
OpenMesh::HalfedgeHandle opposite_halfedge(const OpenMesh::TriConnectivity& mesh, OpenMesh::FaceHandle face,
                                           int corner) {
  const auto first = mesh.halfedge_handle(face);  // from corner 2 to corner 0
  if (corner == 1) return first;
  return corner == 2 ? mesh.next_halfedge_handle(first) : mesh.prev_halfedge_handle(first);
}

// Edges of the triangulation, both ways, by the node they start from.
struct Links {
  struct Link {
    int node = 0;
    double length = 0;
  };
  std::vector<Link> links;
  std::vector<int> begin;
};

Links make_links(const std::vector<DomainFace>& faces, size_t n_nodes,
                 const std::function<double(size_t, int)>& length_of) {
  Links result;
  result.begin.assign(n_nodes + 1, 0);
  for (const DomainFace& face : faces)
    for (const int n : face.node) result.begin[static_cast<size_t>(n) + 1] += 2;
  std::partial_sum(result.begin.begin(), result.begin.end(), result.begin.begin());
  result.links.resize(6 * faces.size());
  std::vector<int> next(result.begin.begin(), result.begin.end() - 1);
  for (size_t f = 0; f < faces.size(); ++f)
    for (int i = 0; i < 3; ++i) {
      const int a = faces[f].node[i], b = faces[f].node[(i + 1) % 3];
      const double length = length_of(f, i);
      result.links[static_cast<size_t>(next[static_cast<size_t>(a)]++)] = {b, length};
      result.links[static_cast<size_t>(next[static_cast<size_t>(b)]++)] = {a, length};
    }
  return result;
}

// The largest spacing below the wanted one that changes by at most max_slope of a unit over a unit: lines at
// the wanted distance on one side of a gap can then also be at the wanted distance on the other.
void grade(std::vector<std::array<double, 2>>& spacings, size_t kind, const Links& links, double max_slope) {
  using Entry = std::pair<double, int>;
  std::vector<Entry> entries;
  entries.reserve(spacings.size());
  for (size_t i = 0; i < spacings.size(); ++i) entries.emplace_back(spacings[i][kind], static_cast<int>(i));
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue(std::greater<>(), std::move(entries));
  while (!queue.empty()) {
    const auto [spacing, i] = queue.top();
    queue.pop();
    if (spacing > spacings[static_cast<size_t>(i)][kind]) continue;
    for (int e = links.begin[static_cast<size_t>(i)]; e < links.begin[static_cast<size_t>(i) + 1]; ++e) {
      const Links::Link& link = links.links[static_cast<size_t>(e)];
      double& other = spacings[static_cast<size_t>(link.node)][kind];
      if (!(other > spacing + max_slope * link.length)) continue;
      other = spacing + max_slope * link.length;
      queue.emplace(other, link.node);
    }
  }
}

void set_away(const SurfaceRef& surface, std::vector<DomainFace>& faces) {
  std::vector<Vec3d> middle(faces.size());
  std::vector<double> area(faces.size());
  for (const auto f : surface.connectivity().all_faces()) {
    const auto c = surface.corners(f);
    const Vec3d &p = surface.point(c.vertex[0]), &q = surface.point(c.vertex[1]),
                &r = surface.point(c.vertex[2]);
    middle[static_cast<size_t>(f.idx())] = (p + q + r) / 3;
    area[static_cast<size_t>(f.idx())] = 0.5 * ((q - p) % (r - p)).norm();
  }
  const auto away = distances_from_middle(middle, area);
  for (size_t f = 0; f < faces.size(); ++f) faces[f].away = away[f];
}

}  // namespace

void set_across(const SurfaceRef& surface, std::vector<DomainFace>& faces) {
  auto& mesh = surface.connectivity();
  set_away(surface, faces);
  for (const auto f : mesh.all_faces())
    for (int i = 0; i < 3; ++i) {
      const auto h = opposite_halfedge(mesh, f, i);
      DomainFace& face = faces[static_cast<size_t>(f.idx())];
      if (mesh.is_boundary(mesh.edge_handle(h))) {
        face.across[i] = kBorder;
        continue;
      }
      const auto other = mesh.opposite_face_handle(h);
      face.across[i] = other.idx();
      if (!is_feature_or_border(mesh, mesh.edge_handle(h))) continue;
      face.across[i] = kFeature;
      int corner = 0;
      while (opposite_halfedge(mesh, other, corner) != mesh.opposite_halfedge_handle(h)) ++corner;
      face.beyond[i] = 3 * other.idx() + corner;
    }
}

double larger_curvature(const Vec3d& tensor) {
  double k_min = 0, k_max = 0;
  eigenvalues(tensor, k_min, k_max);
  return std::max(std::abs(k_min), std::abs(k_max));
}

double mean_curvature(const SurfaceRef& surface, const std::vector<std::array<Vec3d, 3>>& corner_tensors) {
  double sum = 0, total = 0;
  for (const auto face : surface.connectivity().all_faces()) {
    const auto c = surface.corners(face);
    const Vec3d a = surface.point(c.vertex[0]);
    const double area = 0.5 * ((surface.point(c.vertex[1]) - a) % (surface.point(c.vertex[2]) - a)).norm();
    double k = 0;
    for (const Vec3d& tensor : corner_tensors[static_cast<size_t>(face.idx())])
      k += larger_curvature(tensor) / 3;
    sum += area * k;
    total += area;
  }
  return total > 0 ? sum / total : 0;
}

std::vector<UmbilicPoint> read_umbilics(const SurfaceRef& surface,
                                        const std::vector<std::array<Vec3d, 3>>& corner_tensors) {
  auto& mesh = surface.connectivity();
  const auto umbilic = require_property(mesh, property::umbilic);
  const auto where = require_property(mesh, property::umbilic_position);
  std::vector<UmbilicPoint> umbilics;
  for (const auto f : mesh.all_faces()) {
    if (mesh.property(umbilic, f) == 0) continue;
    const Vec3d b = mesh.property(where, f);
    const auto& t = corner_tensors[static_cast<size_t>(f.idx())];
    umbilics.push_back(
        {{f, b}, mesh.property(umbilic, f), larger_curvature(b[0] * t[0] + b[1] * t[1] + b[2] * t[2])});
  }
  // The most curved first: in an order that does not depend on how faces are numbered.
  std::vector<Measures> measures;
  for (const UmbilicPoint& u : umbilics) {
    const auto c = surface.corners(u.point.face);
    const Vec3d a = surface.point(c.vertex[0]);
    measures.push_back(
        {-u.curvature, ((surface.point(c.vertex[1]) - a) % (surface.point(c.vertex[2]) - a)).norm(), 0});
  }
  std::vector<UmbilicPoint> ordered;
  for (const int u : intrinsic_order(measures)) ordered.push_back(umbilics[static_cast<size_t>(u)]);
  return ordered;
}

double FaceDomain::spacing(LineKind kind, const SurfacePoint& at) const {
  const DomainFace& f = face(at.face);
  const auto k = static_cast<size_t>(kind);
  const auto of = [&](int i) { return spacing_[static_cast<size_t>(f.node[i])][k]; };
  return at.barycentric[0] * of(0) + at.barycentric[1] * of(1) + at.barycentric[2] * of(2);
}

double FaceDomain::isotropic_spacing(const SurfacePoint& at) const {
  return std::min(spacing(LineKind::min, at), spacing(LineKind::max, at));
}

bool FaceDomain::isotropic(const SurfacePoint& at) const {
  constexpr double kFlat = 0.1;        // of the curvature at which the spacing reaches its upper bound
  constexpr double kSpherical = 0.05;  // (k_max - k_min) / 2 over the larger of |k_min|, |k_max|
  const Vec3d t = tensor(at);
  const double larger = larger_curvature(t);
  return larger < kFlat * density_.flat_curvature() || deviator_norm(t) < kSpherical * larger;
}

void FaceDomain::make_spacing(const std::vector<Vec3d>& node_tensors,
                              const std::function<double(size_t, int)>& length) {
  constexpr double kRelativeNoise = 0.01;
  spacing_.resize(node_tensors.size());
  for (size_t n = 0; n < node_tensors.size(); ++n) {
    double k_min = 0, k_max = 0;
    eigenvalues(node_tensors[n], k_min, k_max);
    // Beside a large curvature a small one is not known better than this: without the threshold the noise of
    // the estimate would space the lines along a cylinder.
    const double noise = kRelativeNoise * std::max(std::abs(k_min), std::abs(k_max));
    for (double* k : {&k_min, &k_max}) *k = std::copysign(std::max(std::abs(*k) - noise, 0.0), *k);
    spacing_[n][static_cast<size_t>(LineKind::min)] = density_.min_line_spacing(k_min, k_max);
    spacing_[n][static_cast<size_t>(LineKind::max)] = density_.max_line_spacing(k_min, k_max);
  }
  const Links links = make_links(faces_, spacing_.size(), length);
  for (const LineKind kind : {LineKind::min, LineKind::max})
    grade(spacing_, static_cast<size_t>(kind), links, max_slope_);
}

// Where there is noise there are umbilics everywhere, each within reach of thousands of faces, and next to
// all of them have a nearer one.
void FaceDomain::register_umbilics(
    const std::function<std::vector<NearFace>(const SurfacePoint&, double, const IsHidden&)>& faces_near) {
  constexpr double kSurelyFarther = 2;  // times: ways that unfold differently do not make up for that
  std::vector<double> farthest(faces_.size(), std::numeric_limits<double>::infinity());  // of the nearest
  const auto is_hidden = [&farthest](int face, double distance) {
    return distance > kSurelyFarther * farthest[static_cast<size_t>(face)];
  };
  for (size_t u = 0; u < umbilics_.size(); ++u) {
    const SurfacePoint& at = umbilics_[u].point;
    const double reach = std::max(spacing(LineKind::min, at), spacing(LineKind::max, at)) / 3;
    for (const NearFace& near : faces_near(at, reach, is_hidden)) {
      near_umbilics_.push_back({near.face, static_cast<int>(u), near.place});
      double& known = farthest[static_cast<size_t>(near.face)];
      known = std::min(known, near.farthest);
    }
  }
  std::sort(near_umbilics_.begin(), near_umbilics_.end());
}

SurfacePoint FaceDomain::beyond_feature(const SurfacePoint& at) const {
  const DomainFace& from = face(at.face);
  for (int i = 0; i < 3; ++i) {
    if (at.barycentric[i] != 0 || from.beyond[i] < 0) continue;
    const int j = from.beyond[i] % 3;
    SurfacePoint there{OpenMesh::FaceHandle(from.beyond[i] / 3), {0, 0, 0}};
    there.barycentric[(j + 1) % 3] = at.barycentric[(i + 2) % 3];
    there.barycentric[(j + 2) % 3] = at.barycentric[(i + 1) % 3];
    return there;
  }
  return SurfacePoint();
}

NearUmbilic FaceDomain::umbilic_near(LineKind kind, const SurfacePoint& at) const {
  NearUmbilic best;
  const auto first =
      std::lower_bound(near_umbilics_.begin(), near_umbilics_.end(), NearEntry{at.face.idx(), -1, {0, 0}});
  for (auto it = first; it != near_umbilics_.end() && it->face == at.face.idx(); ++it) {
    const double away = distance(at, it->place);
    if (away < best.distance && away < spacing(kind, at) / 3) best = {it->umbilic, away};
  }
  return best;
}

}  // namespace anisomesh::detail
