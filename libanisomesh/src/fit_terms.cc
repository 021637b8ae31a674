#include "fit_terms.hh"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "linear_field.hh"

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

// Corners (0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0).
constexpr std::array<std::array<int, 2>, 6> corner_pair{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};

/// What the pairs of one triangle add: a quadratic form of the steps of its three corners.
struct TriangleForm {
  std::array<Vec6d, 6> block;
  std::array<Vec3d, 3> right;
  Vec6d normals;                ///< sum of weight * n n^T
  std::array<Vec6d, 3> tensor;  ///< curvature at side k, from corner k to k + 1
  std::array<double, 3> side_weight{};
  double weight = 0;

  TriangleForm() {
    block.fill(Vec6d(0.0));
    right.fill(Vec3d(0, 0, 0));
    tensor.fill(Vec6d(0.0));
    normals = Vec6d(0.0);
  }

  // weight * (distance - direction | sum of barycentric * step)^2
  void add(const FitPair& pair, const FitInput& input) {
    weight += pair.weight;
    const Vec6d square = pair.weight * outer(pair.direction);
    for (size_t k = 0; k < 6; ++k)
      block[k] += pair.barycentric[corner_pair[k][0]] * pair.barycentric[corner_pair[k][1]] * square;
    for (int k = 0; k < 3; ++k)
      right[at(k)] += pair.weight * pair.distance * pair.barycentric[k] * pair.direction;
    normals += pair.weight * outer(input.normal[at(pair.face)]);
    if (input.tensor.empty()) return;
    for (int k = 0; k < 3; ++k) {
      const double near = pair.barycentric[k] + pair.barycentric[(k + 1) % 3], w = pair.weight * near * near;
      side_weight[at(k)] += w;
      tensor[at(k)] += w * input.tensor[at(pair.face)];
    }
  }

  // The squared heights of the sides against the normals.
  void add_heights(double factor, const std::array<Vec3d, 3>& place) {
    const Vec6d square = factor * normals;
    for (size_t k = 0; k < 3; ++k) {
      const size_t l = (k + 1) % 3;
      const Vec3d pull = apply(square, place[l] - place[k]);
      right[k] += pull;
      right[l] -= pull;
      block[k] += square;
      block[l] += square;
      block[3 + k] -= square;
    }
  }
};

std::vector<TriangleForm> forms_of(const FitTriangles& triangles, const FitInput& input,
                                   const FitPairs& pairs, const std::vector<Vec3d>& points,
                                   double normal_weight) {
  std::vector<TriangleForm> forms(triangles.corner.size());
  tbb::parallel_for(size_t{0}, forms.size(), [&](size_t t) {
    pairs.for_each(t, [&](const FitPair& pair) { forms[t].add(pair, input); });
    const Triangle& c = triangles.corner[t];
    forms[t].add_heights(normal_weight, {points[at(c[0])], points[at(c[1])], points[at(c[2])]});
  });
  return forms;
}

/// Curvature beside a side of a polygon.
struct SideTensor {
  Vec6d tensor{0, 0, 0, 0, 0, 0};
  double weight = 0;
};

// The nearer principal direction's companion: the part of the side along it is what turns it away. The sine
// of the angle counts, not that part's length, or a short side across a long one would be turned for nothing.
void add_turn(const FitMesh::Side& side, const SideTensor& curvature, const Vec3d& normal,
              double align_weight, Follow follow, const std::vector<Vec3d>& points, FitSystem& system) {
  const TangentFrame frame(normal);
  const Orientation lines = orientation(followed(in_frame(curvature.tensor, frame), follow));
  const double sure = lines.certainty();
  if (!(sure > 0)) return;
  const Vec3d first = std::cos(lines.angle) * frame.u + std::sin(lines.angle) * frame.v,
              second = cross(normal, first);
  const Vec3d along = points[at(side.to)] - points[at(side.from)];
  const double a = along | first, b = along | second, length = std::hypot(a, b);
  if (!(length > 0)) return;
  // A diagonal of the network is turned to neither.
  const double diagonal = (a * a - b * b) / (length * length);
  const Vec3d& away = std::abs(a) > std::abs(b) ? second : first;
  const int v[2] = {side.from, side.to};
  const double factor[2] = {-1, 1};
  system.add_row(v, factor, away, -(along | away),
                 align_weight * curvature.weight * sure * diagonal * diagonal / (length * length));
}

void add_turns(const FitMesh& mesh, const FitTriangles& triangles, const std::vector<TriangleForm>& forms,
               double align_weight, Follow follow, const std::vector<Vec3d>& points, FitSystem& system) {
  std::vector<SideTensor> curvature(mesh.sides.size());
  std::vector<Vec3d> normal(mesh.sides.size(), Vec3d(0, 0, 0));
  for (int p = 0; p < mesh.n_polygons(); ++p)
    for (int t = triangles.first[at(p)]; t < triangles.first[at(p) + 1]; ++t)
      for (size_t k = 0; k < 3; ++k) {
        const int s = mesh.side(p, triangles.corner[at(t)][k], triangles.corner[at(t)][(k + 1) % 3]);
        if (s < 0) continue;
        curvature[at(s)].tensor += forms[at(t)].tensor[k];
        curvature[at(s)].weight += forms[at(t)].side_weight[k];
        normal[at(s)] += triangles.area[at(t)] * triangles.normal[at(t)];
      }
  for (size_t s = 0; s < mesh.sides.size(); ++s) {
    const double length = normal[s].norm();
    if (length > 0)
      add_turn(mesh.sides[s], curvature[s], normal[s] / length, align_weight, follow, points, system);
  }
}

}  // namespace

void add_surface_terms(const FitMesh& mesh, const FitTriangles& triangles, const FitInput& input,
                       const FitPairs& pairs, const std::vector<Vec3d>& points, const FitOptions& options,
                       double energy, FitSystem& system) {
  const auto forms = forms_of(triangles, input, pairs, points, options.normal_weight);
  const Vec6d identity(1, 0, 0, 1, 0, 1);
  for (size_t t = 0; t < forms.size(); ++t) {
    const Triangle& c = triangles.corner[t];
    for (size_t k = 0; k < 6; ++k)
      system.add(c[at(corner_pair[k][0])], c[at(corner_pair[k][1])], forms[t].block[k]);
    for (size_t k = 0; k < 3; ++k) {
      system.add_right(c[k], forms[t].right[k]);
      system.add(c[k], c[k], options.damping * (forms[t].weight / 3 + 1e-12) * identity);
    }
  }
  if (!input.tensor.empty() && options.alignment_weight > 0)
    add_turns(mesh, triangles, forms, energy * options.alignment_weight, input.follow, points, system);
}

void add_planarity(const FitMesh& mesh, const std::vector<Vec3d>& points, double weight, double total_area,
                   FitSystem& system) {
  for (int p = 0; p < mesh.n_polygons(); ++p) {
    if (mesh.degree(p) != 4) continue;
    const int* c = mesh.begin(p);
    const Vec3d normal = cross(points[at(c[2])] - points[at(c[0])], points[at(c[3])] - points[at(c[1])]);
    const double length = normal.norm();
    if (!(length > 0)) continue;
    const Vec3d n = normal / length;
    const double twist = n | (points[at(c[0])] - points[at(c[1])] + points[at(c[2])] - points[at(c[3])]);
    const int v[4] = {c[0], c[1], c[2], c[3]};
    const double factor[4] = {1, -1, 1, -1};
    system.add_row(v, factor, n, -twist, weight * 0.5 * length / total_area);
  }
}

}  // namespace anisomesh::detail
