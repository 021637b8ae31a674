#include "fit/fit_guard.hh"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

constexpr double pi = 3.14159265358979323846;
constexpr double least_fullness = 2e-2;       // or as much as the polygon had before
constexpr double most_reflex = 2 * pi / 180;  // the result is held to 5 degrees
constexpr double least_cosine = 0.35;         // between a polygon and its part of the input
constexpr double least_bend = 0.5;            // between the triangles of a polygon
constexpr int halvings = 5, max_rounds = 100;

}  // namespace

FitGuard::FitGuard(const FitMesh& mesh, const FitTriangles& triangles, const std::vector<TriangleForm>& forms)
    : mesh_(mesh), normals_(static_cast<size_t>(mesh.n_polygons()), Vec3d(0, 0, 0)) {
  for (size_t p = 0; p < normals_.size(); ++p) {
    for (int t = triangles.first[p]; t < triangles.first[p + 1]; ++t) normals_[p] += forms[at(t)].normal_sum;
    const double length = normals_[p].norm();
    if (length > 0) normals_[p] /= length;
  }
}

FitGuard::Shape FitGuard::shape_of(int polygon, const std::vector<Vec3d>& points) const {
  const int n = mesh_.degree(polygon);
  const int* v = mesh_.begin(polygon);
  const auto place = [&](int i) { return points[at(v[(i + n) % n])]; };
  Shape shape;
  Vec3d area(0, 0, 0);
  double squared = 0;
  for (int i = 0; i < n; ++i) {
    if (i > 0 && i + 1 < n) area += cross(place(i) - place(0), place(i + 1) - place(0));
    for (int j = 0; j < i; ++j) squared = std::max(squared, (place(i) - place(j)).sqrnorm());
  }
  const double length = area.norm();
  if (!(length > 0)) return shape;
  shape.normal = area / length;
  shape.fullness = length / squared;
  for (int i = 0; i < n; ++i) {
    const Vec3d in = place(i) - place(i - 1), out = place(i + 1) - place(i);
    const Vec3d corner = cross(in, out);
    const double norm = corner.norm(), left = corner | shape.normal;
    if (left < 0)  // else it is convex there, and how much does not matter
      shape.least_turn = std::min(shape.least_turn,
                                  std::atan2(left, (in | out) - (in | shape.normal) * (out | shape.normal)));
    if (n > 3 && norm > 0) shape.bend = std::min(shape.bend, left / norm);
  }
  return shape;
}

// Sound, or at least no worse than before.
bool FitGuard::is_sound(int polygon, const Shape& shape, const Shape& before) const {
  const Vec3d& wanted = normals_[at(polygon)];
  return shape.fullness >= std::min(least_fullness, before.fullness) &&
         (mesh_.degree(polygon) == 3 || shape.least_turn >= std::min(-most_reflex, before.least_turn)) &&
         shape.bend >= std::min(least_bend, before.bend) &&
         (shape.normal | wanted) >= std::min(least_cosine, before.normal | wanted);
}

// Polygons that have become unsound. Only those marked are looked at, and their neighbours.
void FitGuard::judge(const std::vector<Vec3d>& points, const std::vector<Shape>& before,
                     const std::vector<char>& changed, std::vector<Shape>& shape,
                     std::vector<char>& bad) const {
  tbb::parallel_for(size_t{0}, shape.size(), [&](size_t p) {
    bad[p] = 0;
    if (!changed[p]) return;
    shape[p] = shape_of(static_cast<int>(p), points);
    bad[p] = !is_sound(static_cast<int>(p), shape[p], before[p]);
  });
  for (const auto& [p, q] : mesh_.beside) {
    if (q < 0 || (!changed[at(p)] && !changed[at(q)])) continue;
    const double cosine = shape[at(p)].normal | shape[at(q)].normal;
    if (cosine < least_fold && cosine < (before[at(p)].normal | before[at(q)].normal))
      bad[at(p)] = bad[at(q)] = 1;
  }
}

std::vector<Vec3d> FitGuard::move(
    const std::vector<Vec3d>& points, const std::vector<Vec3d>& step,
    const std::function<void(const std::vector<Vec3d>&, std::vector<char>&)>& strays, size_t& held) const {
  const size_t n = static_cast<size_t>(mesh_.n_polygons());
  std::vector<Shape> before(n), shape(n);
  tbb::parallel_for(size_t{0}, n, [&](size_t p) { before[p] = shape_of(static_cast<int>(p), points); });
  std::vector<double> share(points.size(), 1);
  std::vector<Vec3d> moved(points.size());
  for (size_t v = 0; v < points.size(); ++v) moved[v] = points[v] + step[v];
  std::vector<char> bad(n, 0), changed(n, 1), less;
  // Once no share of an unsound polygon is left it is what it was before, which is as sound as it need be.
  for (int round = 0; round < max_rounds; ++round) {
    judge(moved, before, changed, shape, bad);
    less.assign(points.size(), 0);
    for (size_t p = 0; p < n; ++p)
      if (bad[p])
        for (const int* v = mesh_.begin(static_cast<int>(p)); v != mesh_.end(static_cast<int>(p)); ++v)
          less[at(*v)] = 1;
    strays(moved, less);
    if (std::find(less.begin(), less.end(), 1) == less.end()) {
      held = 0;
      for (size_t v = 0; v < points.size(); ++v) held += share[v] < 1 && step[v].sqrnorm() > 0;
      return moved;
    }
    changed.assign(n, 0);
    for (size_t v = 0; v < points.size(); ++v) {
      if (!less[v]) continue;
      share[v] = round < halvings ? share[v] / 2 : 0;
      moved[v] = points[v] + share[v] * step[v];
      for (int i = mesh_.first_polygon[v]; i < mesh_.first_polygon[v + 1]; ++i)
        changed[at(mesh_.polygons[at(i)])] = 1;
    }
  }
  return points;
}

}  // namespace anisomesh::detail
