#include "numerics/bvh.hh"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace anisomesh::detail {

namespace {

constexpr int items_a_leaf = 4;
constexpr double kRounding = 1e-9, kRoundingOfSize = 1e-12;

std::vector<Box> boxes_of(const std::vector<Vec3d>& points, const std::vector<Triangle>& triangles) {
  std::vector<Box> boxes(triangles.size());
  for (size_t t = 0; t < triangles.size(); ++t)
    for (const int corner : triangles[t]) boxes[t].add(points[static_cast<size_t>(corner)]);
  return boxes;
}

/// Parameter in [0, 1] of the point of segment (a, b) nearest to p.
double closest_parameter(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d along = b - a;
  const double length2 = dot(along, along);
  return length2 > 0 ? std::clamp(dot(p - a, along) / length2, 0.0, 1.0) : 0;
}

/// The same for a triangle without area: the best of its three sides.
Vec3d closest_barycentric_on_sides(const Vec3d& p, const std::array<Vec3d, 3>& corner) {
  Vec3d best(1, 0, 0);
  double best_distance = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < 3; ++i) {
    const size_t j = (i + 1) % 3;
    const double t = closest_parameter(p, corner[i], corner[j]);
    const double distance = (corner[i] + t * (corner[j] - corner[i]) - p).sqrnorm();
    if (!(distance < best_distance)) continue;
    best_distance = distance;
    best = Vec3d(0, 0, 0);
    best[i] = 1 - t;
    best[j] += t;
  }
  return best;
}

}  // namespace

BoxTree::BoxTree(const std::vector<Box>& boxes) : items_(boxes.size()) {
  std::iota(items_.begin(), items_.end(), 0);
  std::vector<Vec3d> centres;
  centres.reserve(boxes.size());
  for (const Box& box : boxes) centres.push_back(0.5 * (box.low + box.high));
  nodes_.reserve(boxes.size());
  if (!boxes.empty()) build(boxes, centres, 0, static_cast<int>(boxes.size()));
}

Box BoxTree::build(const std::vector<Box>& boxes, const std::vector<Vec3d>& centres, int begin, int end) {
  const size_t self = nodes_.size();
  nodes_.emplace_back();
  const auto item = [&](int i) { return static_cast<size_t>(items_[static_cast<size_t>(i)]); };
  if (end - begin <= items_a_leaf) {
    std::sort(items_.begin() + begin, items_.begin() + end);
    Node& leaf = nodes_[self];
    leaf.first = begin;
    leaf.count = end - begin;
    for (int i = begin; i < end; ++i) leaf.box.add(boxes[item(i)]);
    return leaf.box;
  }
  Box spread;
  for (int i = begin; i < end; ++i) spread.add(centres[item(i)]);
  const Vec3d extent = spread.high - spread.low;
  const int axis = extent[0] >= extent[1] && extent[0] >= extent[2] ? 0 : extent[1] >= extent[2] ? 1 : 2;
  const int middle = begin + (end - begin) / 2;
  // The index breaks ties, and leaves are sorted: the tree does not depend on whose nth_element this is.
  std::nth_element(items_.begin() + begin, items_.begin() + middle, items_.begin() + end, [&](int a, int b) {
    const double at_a = centres[static_cast<size_t>(a)][axis], at_b = centres[static_cast<size_t>(b)][axis];
    return at_a < at_b || (at_a == at_b && a < b);
  });
  Box box = build(boxes, centres, begin, middle);
  nodes_[self].first = static_cast<int>(nodes_.size());
  box.add(build(boxes, centres, middle, end));
  return nodes_[self].box = box;
}

Vec3d closest_barycentric(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const Vec3d bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const Vec3d cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  const double sum = va + vb + vc;
  // `sum` is four times the squared area: where rounding leaves nothing of it the regions below mean nothing.
  if (!(sum > 1e-14 * ab.sqrnorm() * ac.sqrnorm())) return closest_barycentric_on_sides(p, {a, b, c});
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double t = d1 / (d1 - d3);
    return {1 - t, t, 0};
  }
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double t = d2 / (d2 - d6);
    return {1 - t, 0, t};
  }
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - t, t};
  }
  return {va / sum, vb / sum, vc / sum};
}

TriangleTree::TriangleTree(std::vector<Vec3d> points, std::vector<Triangle> triangles)
    : points_(std::move(points)), triangles_(std::move(triangles)), boxes_(boxes_of(points_, triangles_)) {
  Box box;
  for (const Vec3d& p : points_) box.add(p);
  if (!points_.empty()) rounding_ = kRoundingOfSize * (box.high - box.low).norm();
}

void TriangleTree::try_triangle(int triangle, const Vec3d& p, double& least, double& limit,
                                ClosestPoint& best) const {
  const Triangle& corner = triangles_[static_cast<size_t>(triangle)];
  const Vec3d &a = points_[static_cast<size_t>(corner[0])], &b = points_[static_cast<size_t>(corner[1])],
              &c = points_[static_cast<size_t>(corner[2])];
  const Vec3d barycentric = closest_barycentric(p, a, b, c);
  // From the first corner, so that a point that is a corner is met exactly.
  const Vec3d point = a + barycentric[1] * (b - a) + barycentric[2] * (c - a);
  const double distance = (point - p).sqrnorm();
  if (!(distance < limit)) return;
  const double as_near = std::sqrt(distance) * (1 + kRounding) + rounding_, squared = as_near * as_near;
  if (distance < least) least = distance, limit = std::min(limit, squared);
  if (triangle > best.triangle && best.triangle >= 0 && squared >= best.squared_distance) return;
  best = {triangle, barycentric, point, distance};
}

}  // namespace anisomesh::detail
