#include "surface/unfolded_faces.hh"

#include <algorithm>
#include <cmath>

#include "numerics/tensor3d.hh"

namespace anisomesh::detail {

namespace {

constexpr double kSlack = 1e-5;  // of the mean edge: by so much two edges are longer than the third

// Lengths of the edges opposite each corner.
std::vector<std::array<double, 3>> edge_lengths(const SurfaceRef& surface) {
  std::vector<std::array<double, 3>> lengths(surface.connectivity().n_faces());
  for (const auto f : surface.connectivity().all_faces()) {
    const auto c = surface.corners(f);
    for (size_t i = 0; i < 3; ++i)
      lengths[static_cast<size_t>(f.idx())][i] =
          (surface.point(c.vertex[(i + 1) % 3]) - surface.point(c.vertex[(i + 2) % 3])).norm();
  }
  return lengths;
}

std::vector<std::array<double, 3>> mollified(std::vector<std::array<double, 3>> lengths) {
  double sum = 0;
  for (const auto& l : lengths) sum += l[0] + l[1] + l[2];
  const double slack = kSlack * sum / static_cast<double>(3 * lengths.size());
  double missing = 0;
  for (const auto& l : lengths)
    for (size_t i = 0; i < 3; ++i)
      missing = std::max(missing, slack + l[i] - l[(i + 1) % 3] - l[(i + 2) % 3]);
  if (missing == 0) return lengths;
  for (auto& l : lengths)
    for (double& length : l) length += missing;
  return lengths;
}

}  // namespace

UnfoldedFaces::UnfoldedFaces(const SurfaceRef& surface, const std::vector<DomainFace>& faces)
    : UnfoldedFaces(surface, faces, mollified(edge_lengths(surface)), {}) {}

UnfoldedFaces::UnfoldedFaces(const SurfaceRef& surface, const std::vector<DomainFace>& faces,
                             const std::vector<std::array<double, 3>>& lengths,
                             std::vector<std::array<Vec2d, 3>> corner_turns)
    : layouts_(faces.size()), corner_turns_(std::move(corner_turns)), faces_(&faces) {
  for (size_t f = 0; f < faces.size(); ++f) {
    const double a = lengths[f][0], b = lengths[f][1], c = lengths[f][2];
    // Twice the area by Heron's formula in the order that loses no digits. [Kahan 2014]
    double s[3] = {a, b, c};
    std::sort(s, s + 3, std::greater<>());
    const double product =
        (s[0] + (s[1] + s[2])) * (s[2] - (s[0] - s[1])) * (s[2] + (s[0] - s[1])) * (s[0] + (s[1] - s[2]));
    layouts_[f].x1 = c;
    layouts_[f].x2 = 0.5 * (c + (b - a) * (b + a) / c);
    layouts_[f].y2 = 0.5 * std::sqrt(std::max(product, 0.0)) / c;
  }
  for (size_t f = 0; f < faces.size(); ++f)
    for (int i = 0; i < 3; ++i) {
      const int g = faces[f].across[i];
      if (g < 0) continue;
      const auto& back = faces[static_cast<size_t>(g)].across;
      const int face = static_cast<int>(f);
      // Two faces may share two edges: the one that has the same ends is meant.
      int j = 0;
      const auto c = surface.corners(OpenMesh::FaceHandle(face)),
                 d = surface.corners(OpenMesh::FaceHandle(g));
      while (j < 2 && (back[j] != face || c.vertex[(i + 1) % 3] != d.vertex[(j + 2) % 3] ||
                       c.vertex[(i + 2) % 3] != d.vertex[(j + 1) % 3]))
        ++j;
      layouts_[f].twin[static_cast<size_t>(i)] = static_cast<signed char>(j);
      const Vec2d here = (corner(face, (i + 2) % 3) - corner(face, (i + 1) % 3)).normalized();
      const Vec2d there = (corner(g, (j + 1) % 3) - corner(g, (j + 2) % 3)).normalized();
      layouts_[f].turn[static_cast<size_t>(i)] = {here | there, cross2(here, there)};
    }
}

Vec2d UnfoldedFaces::turn_at(int face, int i, const Vec3d& barycentric) const {
  if (corner_turns_.empty()) return turn(face, i);
  const auto& here = corner_turns_[static_cast<size_t>(face)];
  const auto& there = corner_turns_[static_cast<size_t>(across(face, i))];
  const auto a = static_cast<size_t>((i + 1) % 3), b = static_cast<size_t>((i + 2) % 3);
  const auto j = static_cast<size_t>(twin(face, i));
  const Vec2d mean = barycentric[a] * turned_back(there[(j + 2) % 3], here[a]) +
                     barycentric[b] * turned_back(there[(j + 1) % 3], here[b]);
  // A way that is bent more might come back over the edge at once.
  constexpr double kMostBend = 0.5;  // radians
  const Vec2d bend = turned_back(mean, turn(face, i));
  const double angle = std::clamp(std::atan2(bend[1], bend[0]), -kMostBend, kMostBend);
  return turned_by(turn(face, i), {std::cos(angle), std::sin(angle)});
}

double UnfoldedFaces::edge_distance2(int face, int i, const Vec2d& place, double& parameter) const {
  const Vec2d a = corner(face, (i + 1) % 3), ab = corner(face, (i + 2) % 3) - a;
  parameter = std::clamp(((place - a) | ab) / ab.sqrnorm(), 0.0, 1.0);
  return (a + parameter * ab - place).sqrnorm();
}

FaceFrame face_frame(const SurfaceRef& surface, OpenMesh::FaceHandle face, const Vec3d& hint) {
  const auto c = surface.corners(face);
  const Vec3d e1 = surface.point(c.vertex[1]) - surface.point(c.vertex[0]);
  const Vec3d e2 = surface.point(c.vertex[2]) - surface.point(c.vertex[0]);
  const auto unit = [](const Vec3d& v) {
    const double length = v.norm();
    return length > 0 ? Vec3d(v / length) : v;
  };
  FaceFrame frame;
  frame.x = unit(e1);
  const Vec3d across = e1 % e2;
  frame.normal = unit(across);
  // Below this the cross product is rounding.
  const bool flat = !(across.norm() > 1e-12 * e1.norm() * std::max(e1.norm(), e2.norm()));
  if (flat) {
    frame.normal = unit(hint - (hint | frame.x) * frame.x);
    if (!(frame.normal.sqrnorm() > 0.5)) frame.normal = TangentFrame(frame.x.norm() > 0 ? frame.x : hint).u;
    if (!(frame.x.sqrnorm() > 0.5)) frame.x = TangentFrame(frame.normal).u;
  }
  frame.y = frame.normal % frame.x;
  return frame;
}

}  // namespace anisomesh::detail
