#include "numerics/patch.hh"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace anisomesh::detail {

namespace {

/// Area from edge lengths, sorted so that no digits are lost. [Kahan, Miscalculating Area and Angles of a
/// Needle-like Triangle]
double area_of(double a, double b, double c) {
  if (a < b) std::swap(a, b);
  if (a < c) std::swap(a, c);
  if (b < c) std::swap(b, c);
  const double product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  return 0.25 * std::sqrt(std::max(product, 0.0));
}

/// Lengthens the edges until the triangle has some area. opposite[i] is the edge facing corner i.
void mollify(std::array<double, 3>& opposite, double thickness) {
  const double longest = std::max({opposite[0], opposite[1], opposite[2]});
  // A thin triangle of height h over its longest edge l has a slack of about 2 h^2 / l in its inequality.
  const double wanted = thickness * thickness * longest;
  double slack = wanted;
  for (int i = 0; i < 3; ++i)
    slack = std::min(slack, opposite[(i + 1) % 3] + opposite[(i + 2) % 3] - opposite[i]);
  if (slack < wanted)
    for (double& length : opposite) length += wanted - slack;
}

TriangleShape shape_of(std::array<double, 3> opposite) {
  TriangleShape shape;
  shape.area = area_of(opposite[0], opposite[1], opposite[2]);
  for (size_t i = 0; i < 3; ++i) {
    const double a = opposite[i], b = opposite[(i + 1) % 3], c = opposite[(i + 2) % 3];
    const double cosine = b * b + c * c - a * a;  // times 2 b c; the sine times 2 b c is 4 area
    shape.angle[i] = std::atan2(4 * shape.area, cosine);
    shape.cotangent[i] = cosine / (4 * shape.area);
  }
  return shape;
}

}  // namespace

std::vector<TriangleShape> triangle_shapes(const Patch& patch, double thickness) {
  std::vector<TriangleShape> shapes(patch.triangles.size());
  double shortest_allowed = 0;  // triangles of coincident points are given some size, too
  for (const auto& t : patch.triangles)
    shortest_allowed =
        std::max(shortest_allowed,
                 (patch.points[static_cast<size_t>(t[1])] - patch.points[static_cast<size_t>(t[0])]).norm());
  shortest_allowed *= 1e-9;
  tbb::parallel_for(size_t{0}, shapes.size(), [&](size_t f) {
    const auto& t = patch.triangles[f];
    std::array<double, 3> opposite{};
    for (size_t i = 0; i < 3; ++i) {
      const auto& from = patch.points[static_cast<size_t>(t[(i + 1) % 3])];
      const auto& to = patch.points[static_cast<size_t>(t[(i + 2) % 3])];
      opposite[i] = std::max((to - from).norm(), shortest_allowed);
    }
    mollify(opposite, thickness);
    shapes[f] = shape_of(opposite);
  });
  return shapes;
}

}  // namespace anisomesh::detail
