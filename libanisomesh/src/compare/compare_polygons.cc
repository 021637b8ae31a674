// Polygons as arrays, and what can be said of each polygon by itself.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "compare/compare_parts.hh"

namespace anisomesh::detail {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double concave_turn = 5 * pi / 180;
/// A face whose height is below this share of its length has no area to speak of.
constexpr double degenerate_height = 1e-6;
/// Diagonals whose squared lengths differ by less than this share are equally long, and the first one wins:
/// else rounding would choose on every regular grid.
constexpr double tie = 1e-9;

/// Twice the area times the unit normal of the plane of best fit [Newell], taken from the first corner so
/// that it loses nothing far from the origin.
Vec3d area_vector(const std::vector<Vec3d>& corners) {
  Vec3d sum(0, 0, 0);
  for (size_t i = 1; i + 1 < corners.size(); ++i)
    sum += cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  return sum;
}

double diameter_of(const std::vector<Vec3d>& corners) {
  double largest = 0;
  for (size_t i = 0; i < corners.size(); ++i)
    for (size_t j = i + 1; j < corners.size(); ++j)
      largest = std::max(largest, (corners[i] - corners[j]).sqrnorm());
  return std::sqrt(largest);
}

/// Signed area of triangle (a, b, c) seen against the normal.
double signed_area(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& normal) {
  return 0.5 * dot(cross(b - a, c - a), normal);
}

/// Whether the ear at `ring[i]` is convex and holds no other corner of the ring. A straight corner is no ear,
/// and what leaves nothing but a straight corner is none either, on whichever side of it rounding puts them.
bool is_ear(const std::vector<Vec3d>& corners, const std::vector<int>& ring, size_t i, const Vec3d& normal) {
  const size_t n = ring.size(), before = (i + n - 1) % n, after = (i + 1) % n;
  const auto at = [&](size_t k) { return corners[static_cast<size_t>(ring[k])]; };
  const Vec3d a = at(before), b = at(i), c = at(after);
  const double nothing = tie * std::max({(b - a).sqrnorm(), (c - b).sqrnorm(), (a - c).sqrnorm()});
  if (signed_area(a, b, c, normal) <= nothing) return false;
  for (size_t k = 0; k < n; ++k) {
    if (k == before || k == i || k == after) continue;
    const Vec3d p = at(k);
    if (signed_area(a, b, p, normal) >= -nothing && signed_area(b, c, p, normal) >= -nothing &&
        signed_area(c, a, p, normal) >= -nothing)
      return false;
  }
  return true;
}

/// Whether the polygon turns back at a corner by more than the tolerance, in its plane of best fit.
bool is_concave(const std::vector<Vec3d>& corners, const Vec3d& normal) {
  const size_t n = corners.size();
  if (n < 4) return false;
  std::vector<Vec3d> sides;
  for (size_t i = 0; i < n; ++i) {
    Vec3d side = corners[(i + 1) % n] - corners[i];
    side -= normal * dot(side, normal);
    if (side.sqrnorm() > 0) sides.push_back(side);
  }
  double turns = 0;
  for (size_t i = 0; i < sides.size(); ++i) {
    const Vec3d &in = sides[i], &out = sides[(i + 1) % sides.size()];
    const double turn = std::atan2(dot(cross(in, out), normal), dot(in, out));
    if (turn < -concave_turn) return true;
    turns += turn;
  }
  return turns > 3 * pi;  // a star polygon turns left at every corner, but more than once around
}

std::vector<Vec3d> corners_of(const PolygonSoup& result, size_t face) {
  std::vector<Vec3d> corners;
  for (const int v : result.faces[face]) corners.push_back(result.points[static_cast<size_t>(v)]);
  return corners;
}

}  // namespace

std::vector<Triangle> triangulate_polygon(const std::vector<Vec3d>& corners, const Vec3d& normal,
                                          FaceDiagonal diagonal) {
  std::vector<int> ring(corners.size());
  for (size_t i = 0; i < ring.size(); ++i) ring[i] = static_cast<int>(i);
  std::vector<Triangle> triangles;
  const double sign = diagonal == FaceDiagonal::shorter ? 1 : -1;
  for (size_t n = ring.size(); n > 3; n = ring.size()) {
    size_t best = n, fallback = 0;
    double best_length = std::numeric_limits<double>::infinity(), fallback_length = best_length;
    for (size_t i = 0; i < n; ++i) {
      const Vec3d &a = corners[static_cast<size_t>(ring[(i + n - 1) % n])],
                  &c = corners[static_cast<size_t>(ring[(i + 1) % n])];
      const double length = sign * (a - c).sqrnorm();
      if (length < fallback_length - tie * std::abs(length)) fallback = i, fallback_length = length;
      if (length < best_length - tie * std::abs(length) && is_ear(corners, ring, i, normal))
        best = i, best_length = length;
    }
    // A polygon that crosses itself may have no ear; it still needs some triangles.
    const size_t cut = best < n ? best : fallback;
    triangles.push_back({ring[(cut + n - 1) % n], ring[cut], ring[(cut + 1) % n]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(cut));
  }
  if (ring.size() == 3) triangles.push_back({ring[0], ring[1], ring[2]});
  return triangles;
}

PolygonSoup::PolygonSoup(const OpenMesh::PolyMesh& mesh, FaceDiagonal diagonal) {
  for (const auto vertex : mesh.vertices()) points.push_back(mesh.point(vertex));
  for (const auto face : mesh.faces()) {
    auto& corners = faces.emplace_back();
    for (const auto vertex : mesh.fv_range(face)) corners.push_back(vertex.idx());
  }
  measure(diagonal);
}

PolygonSoup::PolygonSoup(std::vector<Vec3d> at, std::vector<std::vector<int>> of, FaceDiagonal diagonal)
    : points(std::move(at)), faces(std::move(of)) {
  measure(diagonal);
}

void PolygonSoup::measure(FaceDiagonal diagonal) {
  for (size_t f = 0; f < faces.size(); ++f) {
    const auto corners = corners_of(*this, f);
    const Vec3d area = area_vector(corners);
    const double length = area.norm();
    normals.push_back(length > 0 ? area / length : Vec3d(0, 0, 0));
    areas.push_back(0.5 * length);
    diameters.push_back(diameter_of(corners));
    first_triangle.push_back(static_cast<int>(triangles.size()));
    for (const Triangle& local : triangulate_polygon(corners, normals.back(), diagonal)) {
      const auto index = [&](int i) { return faces[f][static_cast<size_t>(i)]; };
      triangles.push_back({index(local[0]), index(local[1]), index(local[2])});
      face_of.push_back(static_cast<int>(f));
    }
  }
  first_triangle.push_back(static_cast<int>(triangles.size()));
}

std::vector<char> degenerate_faces(const PolygonSoup& result) {
  std::vector<char> degenerate(result.faces.size());
  for (size_t f = 0; f < degenerate.size(); ++f)
    degenerate[f] = !(2 * result.areas[f] > degenerate_height * result.diameters[f] * result.diameters[f]);
  return degenerate;
}

std::vector<char> concave_faces(const PolygonSoup& result) {
  std::vector<char> concave = degenerate_faces(result);
  for (size_t f = 0; f < concave.size(); ++f)
    concave[f] = !concave[f] && is_concave(corners_of(result, f), result.normals[f]);
  return concave;
}

void measure_faces(const PolygonSoup& result, Comparison& comparison) {
  const auto count = [](const std::vector<char>& faces) {
    return static_cast<size_t>(std::count(faces.begin(), faces.end(), 1));
  };
  const auto degenerate = degenerate_faces(result);
  comparison.degenerate_faces = count(degenerate);
  comparison.concave_faces = count(concave_faces(result));
  double planarity = 0;
  for (size_t f = 0; f < result.faces.size(); ++f) {
    ++comparison.faces_by_degree[static_cast<int>(result.faces[f].size())];
    if (degenerate[f]) continue;
    const auto corners = corners_of(result, f);
    Vec3d centre(0, 0, 0);
    for (const Vec3d& corner : corners) centre += corner / static_cast<double>(corners.size());
    double off = 0;
    for (const Vec3d& corner : corners)
      off = std::max(off, std::abs(dot(corner - centre, result.normals[f])));
    planarity += off / result.diameters[f];
    comparison.max_planarity = std::max(comparison.max_planarity, off / result.diameters[f]);
  }
  comparison.faces = result.faces.size();
  const size_t proper = comparison.faces - comparison.degenerate_faces;
  comparison.mean_planarity = proper > 0 ? planarity / static_cast<double>(proper) : 0;
  const auto quads = comparison.faces_by_degree.find(4);
  if (quads != comparison.faces_by_degree.end())
    comparison.quad_fraction = static_cast<double>(quads->second) / static_cast<double>(comparison.faces);
}

}  // namespace anisomesh::detail
