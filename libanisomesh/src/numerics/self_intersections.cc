#include "numerics/self_intersections.hh"

#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Segment_3.h>
#include <CGAL/Triangle_3.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>

namespace anisomesh::detail {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Bounds = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;

struct Soup {
  std::vector<Point> points;
  const std::vector<Triangle>& triangles;

  const Point& corner(int triangle, size_t k) const {
    return points[static_cast<size_t>(triangles[static_cast<size_t>(triangle)][k % 3])];
  }
  Kernel::Triangle_3 triangle(int t) const { return {corner(t, 0), corner(t, 1), corner(t, 2)}; }
  bool is_degenerate(int t) const { return CGAL::collinear(corner(t, 0), corner(t, 1), corner(t, 2)); }
  bool have_overlap(int t, int u) const;
};

// By how many corners the two share: none, one, an edge, all.
bool Soup::have_overlap(int t, int u) const {
  std::array<size_t, 3> of_t{}, of_u{};
  size_t shared = 0;
  for (size_t i = 0; i < 3; ++i)
    for (size_t k = 0; k < 3; ++k)
      if (triangles[static_cast<size_t>(t)][i] == triangles[static_cast<size_t>(u)][k]) {
        of_t[shared] = i;
        of_u[shared++] = k;
        if (shared == 3) return true;
      }
  if (shared == 0) return CGAL::do_intersect(triangle(t), triangle(u));
  if (shared == 1) {
    const Kernel::Segment_3 across_t(corner(t, of_t[0] + 1), corner(t, of_t[0] + 2));
    const Kernel::Segment_3 across_u(corner(u, of_u[0] + 1), corner(u, of_u[0] + 2));
    return CGAL::do_intersect(triangle(t), across_u) || CGAL::do_intersect(triangle(u), across_t);
  }
  const Point &a = corner(t, of_t[0]), &b = corner(t, of_t[1]);
  const Point &left = corner(t, 3 - of_t[0] - of_t[1]), &right = corner(u, 3 - of_u[0] - of_u[1]);
  return CGAL::coplanar(a, b, left, right) && CGAL::coplanar_orientation(a, b, left, right) == CGAL::POSITIVE;
}

}  // namespace

std::vector<std::pair<int, int>> self_intersections(const std::vector<Vec3d>& points,
                                                    const std::vector<Triangle>& triangles, size_t most) {
  Soup soup{{}, triangles};
  for (const Vec3d& p : points) soup.points.emplace_back(p[0], p[1], p[2]);
  std::vector<Bounds> boxes;
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t)
    if (!soup.is_degenerate(t)) boxes.emplace_back(soup.triangle(t).bbox(), t);
  std::vector<std::pair<int, int>> found;
  struct Enough {};  // no callback of CGAL's can end its search
  try {
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Bounds& a, const Bounds& b) {
      if (!soup.have_overlap(a.info(), b.info())) return;
      found.push_back(std::minmax(a.info(), b.info()));
      if (found.size() >= most) throw Enough();
    });
  } catch (const Enough&) {
  }
  std::sort(found.begin(), found.end());
  return found;
}

bool do_cross(const std::array<Vec3d, 3>& first, const std::array<Vec3d, 3>& second) {
  std::vector<Triangle> triangles{{0, 1, 2}, {3, 4, 5}};
  Soup soup{{}, triangles};
  for (const auto* corners : {&first, &second})
    for (const Vec3d& p : *corners) soup.points.emplace_back(p[0], p[1], p[2]);
  for (size_t i = 0; i < 3; ++i)
    for (size_t k = 0; k < 3; ++k)
      if (first[k] == second[i]) triangles[1][i] = static_cast<int>(k);
  return !soup.is_degenerate(0) && !soup.is_degenerate(1) && soup.have_overlap(0, 1);
}

}  // namespace anisomesh::detail
