#include <algorithm>
#include <cmath>

#include "io/soup.hh"

namespace anisomesh::detail {

namespace {

using OpenMesh::Vec2d;

double cross(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// The polygon's corners in the plane of its vector area, counter-clockwise.
std::vector<Vec2d> projected(const Soup& soup, size_t f) {
  const size_t n = soup.degree(f);
  const auto point = [&](size_t k) { return soup.points[static_cast<size_t>(soup.face(f)[k % n])]; };
  Vec3d normal(0, 0, 0);
  for (size_t k = 1; k + 1 < n; ++k) normal += (point(k) - point(0)) % (point(k + 1) - point(0));
  if (normal.sqrnorm() > 0) normal.normalize();
  // Any axis far from the normal makes a frame.
  int small = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(normal[i]) < std::abs(normal[small])) small = i;
  Vec3d axis(0, 0, 0);
  axis[small] = 1;
  Vec3d x = axis - (axis | normal) * normal;
  x.normalize();
  const Vec3d y = normal % x;
  std::vector<Vec2d> plane(n);
  for (size_t k = 0; k < n; ++k) plane[k] = Vec2d((point(k) - point(0)) | x, (point(k) - point(0)) | y);
  return plane;
}

/// How well formed the triangle is: area over squared lengths, negative where it is turned over.
double quality(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  const double lengths = (b - a).sqrnorm() + (c - b).sqrnorm() + (a - c).sqrnorm();
  return lengths > 0 ? cross(a, b, c) / lengths : 0;
}

/// The best formed ear of what is left of the polygon; where none is empty (folded input), the best formed.
size_t best_ear(const std::vector<Vec2d>& plane, const std::vector<size_t>& left) {
  const size_t n = left.size();
  size_t best = 0;
  double best_quality = -1e300;
  for (size_t k = 0; k < n; ++k) {
    const Vec2d &a = plane[left[(k + n - 1) % n]], &b = plane[left[k]], &c = plane[left[(k + 1) % n]];
    double q = quality(a, b, c);
    for (size_t i = 0; i < n && q > 0; ++i) {
      if (i == k || i == (k + 1) % n || i == (k + n - 1) % n) continue;
      const Vec2d& p = plane[left[i]];
      if (cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0) q -= 1;
    }
    if (n == 4) {  // the ear leaves one triangle: what counts is the worse of the two
      const Vec2d& d = plane[left[(k + 2) % n]];
      q = std::min(q, quality(a, c, d));
    }
    if (q > best_quality) {
      best_quality = q;
      best = k;
    }
  }
  return best;
}

}  // namespace

void triangulate(Soup& soup, ReadReport& report) {
  size_t polygons = 0;
  for (size_t f = 0; f < soup.n_faces(); ++f) polygons += soup.degree(f) > 3;
  if (polygons == 0) return;
  report.triangulated_polygons += polygons;

  Soup triangles;
  triangles.corners.reserve(3 * soup.corners.size());
  for (size_t f = 0; f < soup.n_faces(); ++f) {
    const int* face = soup.face(f);
    const auto add = [&](size_t a, size_t b, size_t c) {
      triangles.corners.insert(triangles.corners.end(), {face[a], face[b], face[c]});
      triangles.end_face();
    };
    if (soup.degree(f) == 3) {
      add(0, 1, 2);
      continue;
    }
    const auto plane = projected(soup, f);
    std::vector<size_t> left(soup.degree(f));
    for (size_t k = 0; k < left.size(); ++k) left[k] = k;
    while (left.size() > 3) {
      const size_t n = left.size(), k = best_ear(plane, left);
      add(left[(k + n - 1) % n], left[k], left[(k + 1) % n]);
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
    }
    add(left[0], left[1], left[2]);
  }
  soup.corners = std::move(triangles.corners);
  soup.begins = std::move(triangles.begins);
}

}  // namespace anisomesh::detail
