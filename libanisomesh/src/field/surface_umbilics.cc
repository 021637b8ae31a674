#include "field/surface_umbilics.hh"

#include <algorithm>
#include <cmath>
#include <complex>

#include "field/umbilic_analysis.hh"
#include "numerics/tensor2d.hh"
#include "numerics/tensor3d.hh"

namespace anisomesh::detail {

namespace {

constexpr double pi = 3.14159265358979323846;

double wrapped(double angle) { return std::remainder(angle, 2 * pi); }

/// One corner of a face as a part of the full turn around its vertex: the angle in the tangent plane of the
/// edge to the next corner, and how far it is from there to the edge to the one after.
struct Sector {
  double low = 0, span = 0;
  double high() const { return low + span; }
};
using Sectors = std::vector<std::array<Sector, 3>>;

class SectorBuilder {
 public:
  SectorBuilder(const SurfaceRef& surface, const SurfaceField& field, const std::vector<DomainFace>& faces)
      : surface_(surface), field_(field), faces_(faces), sectors_(faces.size()), done_(faces.size()) {}

  Sectors build() {
    for (size_t f = 0; f < faces_.size(); ++f)
      for (size_t i = 0; i < 3; ++i)
        if (!done_[f][i]) build_fan(static_cast<int>(f), static_cast<int>(i));
    return std::move(sectors_);
  }

 private:
  struct Corner {
    int face = -1, i = 0;
  };

  // The next corner around the same vertex: counter-clockwise over the edge opposite corner i + 1, clockwise
  // over that opposite i + 2; face < 0 beyond a fence.
  Corner next(const Corner& at, int over) const {
    const int g = faces_[static_cast<size_t>(at.face)].across[(at.i + over) % 3];
    if (g < 0) return {};
    const auto vertex = corner_vertex(at.face, at.i);
    const auto c = surface_.corners(OpenMesh::FaceHandle(g));
    return {g, c.vertex[0] == vertex ? 0 : c.vertex[1] == vertex ? 1 : 2};
  }
  OpenMesh::VertexHandle corner_vertex(int face, int i) const {
    return surface_.corners(OpenMesh::FaceHandle(face)).vertex[i % 3];
  }
  Vec3d edge(int face, int from, int to) const {
    return surface_.point(corner_vertex(face, to)) - surface_.point(corner_vertex(face, from));
  }

  void build_fan(int face, int i) {
    Corner first{face, i};
    bool closed = false;
    for (Corner c = next(first, 2); c.face >= 0; c = next(c, 2)) {
      if (c.face == face && c.i == i) {
        closed = true;
        break;
      }
      first = c;
    }
    if (closed) first = {face, i};
    fan_.clear();
    double total = 0;
    for (Corner c = first; c.face >= 0; c = next(c, 1)) {
      if (!fan_.empty() && c.face == first.face && c.i == first.i) break;
      fan_.push_back(c);
      const Vec3d a = edge(c.face, c.i, c.i + 1), b = edge(c.face, c.i, c.i + 2);
      Sector& sector = sectors_[static_cast<size_t>(c.face)][static_cast<size_t>(c.i)];
      sector.span = std::atan2((a % b).norm(), a | b);
      done_[static_cast<size_t>(c.face)][static_cast<size_t>(c.i)] = 1;
      total += sector.span;
    }
    place_fan(closed, total);
  }

  // Scales a full fan to a full turn, and turns the fan so that its edges lie as they do in the tangent
  // plane.
  void place_fan(bool closed, double total) {
    const auto n = static_cast<size_t>(
        field_.cut.corner_node[static_cast<size_t>(fan_[0].face)][static_cast<size_t>(fan_[0].i)]);
    const TangentFrame frame(field_.normal[n]);
    std::complex<double> offset = 0;
    double angle = 0;
    for (const Corner& c : fan_) {
      Sector& sector = sectors_[static_cast<size_t>(c.face)][static_cast<size_t>(c.i)];
      if (closed)
        sector.span = total > 0 ? sector.span * (2 * pi / total) : 2 * pi / static_cast<double>(fan_.size());
      const Vec3d e = edge(c.face, c.i, c.i + 1);
      const std::complex<double> in_plane(e | frame.u, e | frame.v);
      const double length = std::abs(in_plane);
      if (length > 0) offset += in_plane / length * std::polar(1.0, -angle);
      sector.low = angle;
      angle += sector.span;
    }
    const double turn = std::abs(offset) > 1e-9 ? std::arg(offset) : 0;
    for (const Corner& c : fan_) sectors_[static_cast<size_t>(c.face)][static_cast<size_t>(c.i)].low += turn;
  }

  const SurfaceRef& surface_;
  const SurfaceField& field_;
  const std::vector<DomainFace>& faces_;
  Sectors sectors_;
  std::vector<std::array<char, 3>> done_;
  std::vector<Corner> fan_;
};

/// Deviators far below anything a surface of this size shows are rounding and count as 0, so that a plane has
/// no umbilics at all.
double negligible_deviator(const SurfaceRef& surface, const SurfaceField& field) {
  double largest = 0;
  for (const auto& tensor : field.tensor) largest = std::max(largest, frobenius_norm(tensor));
  return std::max(1e-10 * largest, 1e-7 / surface.extent());
}

/// What an edge of a face brings in, from corner i to corner i + 1: the turn of the deviator, and twice what
/// the shortest rotation of the normals turns more than the flat way along the edge.
double turning_along(const SurfaceField& field, const std::vector<double>& angle, const Sectors& sectors,
                     size_t face, size_t i) {
  const size_t j = (i + 1) % 3;
  const auto a = static_cast<size_t>(field.cut.corner_node[face][i]),
             b = static_cast<size_t>(field.cut.corner_node[face][j]);
  const Vec2d rotation = transport(field.normal[a], field.normal[b]);
  const double turn = std::atan2(rotation[1], rotation[0]);
  const double flat = sectors[face][j].high() + pi - sectors[face][i].low;
  return wrapped(angle[b] - angle[a] - 2 * turn) + 2 * wrapped(turn - flat);
}

}  // namespace

SurfaceUmbilics umbilics_on_surface(const SurfaceRef& surface, const SurfaceField& field) {
  std::vector<DomainFace> faces(surface.connectivity().n_faces());
  set_across(surface, faces);
  const Sectors sectors = SectorBuilder(surface, field, faces).build();
  const double negligible = negligible_deviator(surface, field);
  std::vector<double> angle(field.tensor.size(), 0.0);
  for (size_t n = 0; n < angle.size(); ++n) {
    const Vec2d d = deviator(field.tensor[n]);
    if (deviator_norm(field.tensor[n]) > negligible) angle[n] = std::atan2(d[1], d[0]);
  }

  const auto corners = corner_tensors_in_faces(surface, field);
  SurfaceUmbilics result;
  result.doubled_index.assign(faces.size(), 0);
  result.position.assign(faces.size(), Vec3d(0, 0, 0));
  std::vector<double> radians(faces.size());  // around each face
  double border = 0, curvature = 0;
  for (size_t f = 0; f < faces.size(); ++f) {
    const auto& s = sectors[f];
    const double excess = s[0].span + s[1].span + s[2].span - pi;
    radians[f] += 2 * excess;
    curvature += 2 * excess;
    for (size_t i = 0; i < 3; ++i) {
      const int g = faces[f].across[(i + 2) % 3];
      if (g >= 0 && static_cast<size_t>(g) < f) continue;  // once an edge: both faces get the same, exactly
      const double turn = turning_along(field, angle, sectors, f, i);
      radians[f] += turn;
      (g < 0 ? border : radians[static_cast<size_t>(g)]) += g < 0 ? turn : -turn;
    }
  }
  for (size_t f = 0; f < faces.size(); ++f) {
    const int index = static_cast<int>(std::lround(radians[f] / (2 * pi)));
    result.doubled_index[f] = index;
    if (index == 0) continue;
    std::array<Vec2d, 3> deviators;
    for (size_t i = 0; i < 3; ++i)
      deviators[i] = deviator_norm(corners[f][i]) > negligible ? deviator(corners[f][i]) : Vec2d(0, 0);
    result.position[f] = degenerate_point(deviators);
  }
  result.turning = (border + curvature) / (4 * pi);
  return result;
}

}  // namespace anisomesh::detail
