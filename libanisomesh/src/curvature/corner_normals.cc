#include "curvature/corner_normals.hh"

#include <algorithm>
#include <cmath>

#include "numerics/tensor3d.hh"

namespace anisomesh::detail {

namespace {

/// A face whose height is below this fraction of its longest edge has no normal worth the name.
constexpr double degenerate_height = 1e-10;

/// Passes of correct_walls(): a wall vertex leans on its neighbours along the wall, which are corrected too.
constexpr int wall_passes = 8;

/// Weight of staying where the faces alone put a normal, against one equation a neighbour.
constexpr double wall_damping = 0.001;

}  // namespace

Vec3d area_vector(const SurfaceArrays& surface, int face) {
  const Vec3d a = surface.corner_point(face, 1) - surface.corner_point(face, 0);
  const Vec3d b = surface.corner_point(face, 2) - surface.corner_point(face, 0);
  const Vec3d vector = a % b;
  const double longest = std::max({a.sqrnorm(), b.sqrnorm(), (a - b).sqrnorm()});
  return vector.norm() > degenerate_height * longest ? vector : Vec3d(0, 0, 0);
}

CornerNormals::CornerNormals(const SurfaceArrays& surface, int passes)
    : surface_(surface), sector_(static_cast<size_t>(surface.n_faces())) {
  find_sectors();
  average_faces();
  if (passes > 0)
    smooth(passes);
  else
    correct_walls();
  average_sectors();
}

void CornerNormals::smooth(int passes) {
  std::vector<double> areas;
  for (int face = 0; face < surface_.n_faces(); ++face) areas.push_back(area_vector(surface_, face).norm());
  std::vector<Vec3d> next(normals_.size());
  for (int pass = 0; pass < passes; ++pass) {
    std::fill(next.begin(), next.end(), Vec3d(0, 0, 0));
    for (size_t face = 0; face < areas.size(); ++face) {
      Vec3d sum(0, 0, 0);
      for (const int s : sector_[face]) sum += normals_[static_cast<size_t>(s)];
      for (const int s : sector_[face]) next[static_cast<size_t>(s)] += areas[face] * sum;
    }
    for (size_t s = 0; s < next.size(); ++s)
      if (next[s].sqrnorm() > 0) normals_[s] = next[s].normalized();
  }
}

void CornerNormals::find_sectors() {
  faces_.reserve(surface_.star.size());
  std::vector<char> done;
  for (int v = 0; v < surface_.n_vertices(); ++v) {
    const int* star = surface_.star_of(v);
    const int size = surface_.star_size(v);
    done.assign(static_cast<size_t>(size), 0);
    for (int first = 0; first < size; ++first) {
      if (done[static_cast<size_t>(first)]) continue;
      const int id = static_cast<int>(vertex_.size());
      vertex_.push_back(v);
      first_face_.push_back(faces_.size());
      done[static_cast<size_t>(first)] = 1;
      faces_.push_back(star[first]);
      for (size_t next = first_face_.back(); next < faces_.size(); ++next) {
        const int face = faces_[next], corner = surface_.corner_of(face, v);
        sector_[static_cast<size_t>(face)][static_cast<size_t>(corner)] = id;
        for (const int side : {corner, (corner + 2) % 3}) {
          const int other = surface_.neighbours[static_cast<size_t>(face)][static_cast<size_t>(side)];
          const auto where = std::find(star, star + size, other) - star;
          if (where == size || done[static_cast<size_t>(where)]) continue;
          done[static_cast<size_t>(where)] = 1;
          faces_.push_back(other);
        }
      }
    }
  }
  first_face_.push_back(faces_.size());
}

/// Weights 2A / (|a|^2 |b|^2), a and b the edges at the corner: exact on a sphere, whatever the triangles.
/// [Max 1999, "Weights for computing vertex normals from facet normals"]
void CornerNormals::average_faces() {
  normals_.assign(vertex_.size(), Vec3d(0, 0, 0));
  for (int face = 0; face < surface_.n_faces(); ++face) {
    const Vec3d vector = area_vector(surface_, face);
    double squares[3];
    for (int i = 0; i < 3; ++i)
      squares[i] = (surface_.corner_point(face, (i + 1) % 3) - surface_.corner_point(face, i)).sqrnorm();
    for (size_t i = 0; i < 3; ++i) {
      const double lengths = squares[i] * squares[(i + 2) % 3];
      if (lengths > 0)
        normals_[static_cast<size_t>(sector_[static_cast<size_t>(face)][i])] += vector / lengths;
    }
  }
  for (auto& normal : normals_) normal.normalize_cond();
}

/// Faces on one side only give the normal of a place half an edge inside. Over a chord d of a quadratic
/// surface, however, the normals u and u' at its ends obey (u + u') . d = 0: least squares over the edges of
/// the sector turn the normal to where it belongs.
Vec3d CornerNormals::corrected(size_t sector) const {
  const Vec3d& normal = normals_[sector];
  const TangentFrame frame(normal);
  const int v = vertex_[sector];
  double xx = 0, xy = 0, yy = 0, bx = 0, by = 0, weights = 0;
  for (size_t k = 0; k < n_faces_of(sector); ++k) {
    const int face = faces_of(sector)[k], corner = surface_.corner_of(face, v);
    for (const int other : {(corner + 1) % 3, (corner + 2) % 3}) {
      const Vec3d d = surface_.corner_point(face, other) - surface_.points[static_cast<size_t>(v)];
      const double length = d.norm();
      const Vec3d& end = at(face, other);
      if (!(length > 0) || !((end | normal) > 0)) continue;
      const double x = (frame.u | d) / length, y = (frame.v | d) / length, b = -((normal + end) | d) / length;
      xx += x * x;
      xy += x * y;
      yy += y * y;
      bx += x * b;
      by += y * b;
      weights += 1;
    }
  }
  if (weights == 0) return normal;
  xx += wall_damping * weights;
  yy += wall_damping * weights;
  const double determinant = xx * yy - xy * xy;
  const Vec3d tilt =
      ((yy * bx - xy * by) / determinant) * frame.u + ((xx * by - xy * bx) / determinant) * frame.v;
  return (normal + tilt).normalized();
}

void CornerNormals::correct_walls() {
  std::vector<size_t> walls;
  for (size_t s = 0; s < vertex_.size(); ++s)
    if (surface_.at_wall[static_cast<size_t>(vertex_[s])] && normals_[s].sqrnorm() > 0.5) walls.push_back(s);
  std::vector<Vec3d> next(walls.size());
  for (int pass = 0; pass < wall_passes; ++pass) {
    for (size_t i = 0; i < walls.size(); ++i) next[i] = corrected(walls[i]);
    for (size_t i = 0; i < walls.size(); ++i) normals_[walls[i]] = next[i];
  }
}

void CornerNormals::average_sectors() {
  vertex_normals_.assign(static_cast<size_t>(surface_.n_vertices()), Vec3d(0, 0, 0));
  for (size_t s = 0; s < vertex_.size(); ++s) vertex_normals_[static_cast<size_t>(vertex_[s])] += normals_[s];
  for (auto& normal : vertex_normals_)
    if (!(normal.normalize_cond().sqrnorm() > 0.5)) normal = Vec3d(0, 0, 1);
}

}  // namespace anisomesh::detail
