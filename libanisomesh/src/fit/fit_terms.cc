#include "fit/fit_terms.hh"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "field/linear_field.hh"
#include "surface/rounding.hh"

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

// Corners (0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0).
constexpr std::array<std::array<int, 2>, 6> corner_pair{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
constexpr double least_damping = 1e-12;  // where no sample is
// Of the weight of normals, what goes by the tilt of triangles; the rest goes to all sides alike.
// [docs/fit.md]
constexpr double tilt_share = 0.4, most_cotangent = 6;
constexpr double most_of_small = 10;  // triangles count for more than those of mean area
// A chord of a line that turns runs as the surface does at its middle: the curvature beside it counts. By
// this factor a side has half the weight of its triangle.
constexpr double beside_middle = 45;
constexpr double shortest = 0.05;  // side that is turned, of the size of a polygon

size_t block_of(size_t k, size_t l) { return k == l ? k : 3 + (l == (k + 1) % 3 ? k : l); }

}  // namespace

TriangleForm::TriangleForm() : normals(0.0) {
  block.fill(Vec6d(0.0));
  right.fill(Vec3d(0, 0, 0));
  tensor.fill(Vec6d(0.0));
}

// weight * (distance - direction | sum of barycentric * step)^2
void TriangleForm::add(const FitPair& pair, const FitInput& input) {
  weight += pair.weight;
  const Vec6d square = pair.weight * outer(pair.direction);
  for (size_t k = 0; k < 6; ++k)
    block[k] += pair.barycentric[corner_pair[k][0]] * pair.barycentric[corner_pair[k][1]] * square;
  for (int k = 0; k < 3; ++k)
    right[at(k)] += pair.weight * pair.distance * pair.barycentric[k] * pair.direction;
  const Vec3d& normal = input.normal[at(pair.face)];
  normals += pair.weight * outer(normal);
  normal_sum += pair.weight * normal;
  if (input.tensor.empty()) return;
  for (int k = 0; k < 3; ++k) {
    const double near = pair.barycentric[k] * pair.barycentric[(k + 1) % 3];
    const double w = beside_middle * pair.weight * near * near;
    side_weight[at(k)] += w;
    tensor[at(k)] += w * input.tensor[at(pair.face)];
  }
}

// The squared heights of the sides against the normals.
void TriangleForm::add_heights(const std::array<double, 3>& factor, const std::array<Vec3d, 3>& place) {
  for (size_t k = 0; k < 3; ++k) {
    const size_t l = (k + 1) % 3;
    const Vec6d square = factor[k] * normals;
    const Vec3d pull = apply(square, place[l] - place[k]);
    right[k] += pull;
    right[l] -= pull;
    block[k] += square;
    block[l] += square;
    block[3 + k] -= square;
  }
}

namespace {

// What the squared height of each side counts for. By the cotangents of the angles they lie opposite to, the
// sum is the squared tilt of the triangle times its area: a short side's height is much of a tilt. All
// triangles tilted alike would then count by area times area, the size of their distances.
std::array<double, 3> height_weights(const std::array<Vec3d, 3>& place, double area, double mean_area,
                                     double weight) {
  std::array<double, 3> weights{};
  if (!(area > 0)) return weights;
  const double size = std::min(most_of_small, std::sqrt(mean_area / area));
  for (size_t k = 0; k < 3; ++k) {
    const Vec3d &opposite = place[(k + 2) % 3], a = place[k] - opposite, b = place[(k + 1) % 3] - opposite;
    const double cotangent = std::clamp((a | b) / (2 * area), -most_cotangent, most_cotangent);
    weights[k] = weight * size * std::max(0.0, 1 - tilt_share + tilt_share * std::sqrt(3.0) * cotangent);
  }
  return weights;
}

}  // namespace

void sum_forms(const FitTriangles& triangles, const FitInput& input, const FitPairs& pairs,
               const std::vector<Vec3d>& points, const FitOptions& options,
               std::vector<TriangleForm>& forms) {
  const Vec6d identity(1, 0, 0, 1, 0, 1);
  forms.resize(triangles.corner.size());
  double mean_area = 0;
  for (const double area : triangles.area) mean_area += area / static_cast<double>(triangles.area.size());
  tbb::parallel_for(size_t{0}, forms.size(), [&](size_t t) {
    TriangleForm& form = forms[t] = TriangleForm();
    pairs.for_each(t, [&](const FitPair& pair) { form.add(pair, input); });
    const Triangle& c = triangles.corner[t];
    const std::array<Vec3d, 3> place{points[at(c[0])], points[at(c[1])], points[at(c[2])]};
    form.add_heights(height_weights(place, triangles.area[t], mean_area, options.normal_weight), place);
    for (size_t k = 0; k < 3; ++k)
      form.block[k] += options.damping * (form.weight / 3 + least_damping) * identity;
  });
}

namespace {

/// weight * (direction | difference, or twist, of the steps - wanted)^2
struct Pull {
  Vec3d direction{0, 0, 0};
  double wanted = 0, weight = 0;
};

/// Curvature beside a side of a polygon, and which way is up.
struct SideView {
  Vec6d tensor{0, 0, 0, 0, 0, 0};
  double weight = 0;
  Vec3d normal{0, 0, 0};  ///< sum by area
  double area = 0;
};

SideView view_of(const FitMesh& mesh, const FitTriangles& triangles, const std::vector<TriangleForm>& forms,
                 size_t side) {
  SideView view;
  for (const int p : mesh.beside[side]) {
    if (p < 0) continue;
    for (size_t t = at(triangles.first[at(p)]); t < at(triangles.first[at(p) + 1]); ++t)
      for (size_t k = 0; k < 3; ++k) {
        if (triangles.side[t][k] != static_cast<int>(side)) continue;
        view.tensor += forms[t].tensor[k];
        view.weight += forms[t].side_weight[k];
        view.normal += triangles.area[t] * triangles.normal[t];
        view.area += triangles.area[t];
      }
  }
  return view;
}

// The nearer principal direction's companion: the part of the side along it is what turns it away. The sine
// of the angle counts, not that part's length, or a short side across a long one would be turned for nothing.
Pull turn_of(const FitMesh::Side& side, const SideView& view, double align_weight, Follow follow,
             double least_squared, const std::vector<Vec3d>& points) {
  const double up = view.normal.norm();
  if (!(up > kRounding * view.area)) return {};  // one triangle lies on the other
  const Vec3d normal = view.normal / up;
  const TangentFrame frame(normal);
  const Orientation lines = orientation(followed(in_frame(view.tensor, frame), follow));
  const double sure = lines.certainty();
  if (!(sure > 0)) return {};
  const Vec3d first = std::cos(lines.angle) * frame.u + std::sin(lines.angle) * frame.v,
              second = cross(normal, first);
  const Vec3d along = points[at(side.to)] - points[at(side.from)];
  const double a = along | first, b = along | second, length = std::hypot(a, b);
  if (!(length > 0)) return {};
  // A diagonal of the network is turned to neither.
  const double diagonal = (a * a - b * b) / (length * length);
  const Vec3d& away = std::abs(a) > std::abs(b) ? second : first;
  const double squared = std::max(length * length, least_squared);
  return {away, -(along | away), align_weight * view.weight * sure * diagonal * diagonal / squared};
}

std::vector<Pull> turns_of(const FitMesh& mesh, const FitTriangles& triangles,
                           const std::vector<TriangleForm>& forms, double align_weight, Follow follow,
                           double least_squared, const std::vector<Vec3d>& points) {
  std::vector<Pull> turns(mesh.sides.size());
  if (!(align_weight > 0)) return turns;
  tbb::parallel_for(size_t{0}, turns.size(), [&](size_t s) {
    turns[s] = turn_of(mesh.sides[s], view_of(mesh, triangles, forms, s), align_weight, follow, least_squared,
                       points);
  });
  return turns;
}

// How far quads leave their plane: the first and third corner count one way, the others the other way.
std::vector<Pull> twists_of(const FitMesh& mesh, const std::vector<Vec3d>& points, double weight) {
  std::vector<Pull> twists(at(mesh.n_polygons()));
  tbb::parallel_for(0, mesh.n_polygons(), [&](int p) {
    if (mesh.degree(p) != 4) return;
    const int* c = mesh.begin(p);
    const Vec3d normal = cross(points[at(c[2])] - points[at(c[0])], points[at(c[3])] - points[at(c[1])]);
    const double length = normal.norm();
    if (!(length > 0)) return;
    const Vec3d n = normal / length;
    const double twist = n | (points[at(c[0])] - points[at(c[1])] + points[at(c[2])] - points[at(c[3])]);
    twists[at(p)] = {n, -twist, 0.5 * weight * length};
  });
  return twists;
}

void add_triangle(const Triangle& corner, const TriangleForm& form, int v, FitSystem::Row& row) {
  for (size_t k = 0; k < 3; ++k) {
    if (corner[k] != v) continue;
    row.add_right(form.right[k]);
    for (size_t l = 0; l < 3; ++l) row.add(corner[l], form.block[block_of(k, l)]);
  }
}

void add_twist(const FitMesh& mesh, int polygon, const Pull& twist, int v, FitSystem::Row& row) {
  const int* corner = mesh.begin(polygon);
  const Vec6d square = twist.weight * outer(twist.direction);
  for (int k = 0; k < 4; ++k) {
    if (corner[k] != v) continue;
    const double sign = k % 2 == 0 ? 1 : -1;
    row.add_right(sign * twist.weight * twist.wanted * twist.direction);
    for (int l = 0; l < 4; ++l) row.add(corner[l], ((k + l) % 2 == 0 ? 1.0 : -1.0) * square);
  }
}

void add_turn(const FitMesh::Side& side, const Pull& turn, int v, FitSystem::Row& row) {
  const Vec6d square = turn.weight * outer(turn.direction);
  row.add_right((v == side.to ? turn.weight : -turn.weight) * turn.wanted * turn.direction);
  row.add(v, square);
  row.add(v == side.to ? side.from : side.to, -1.0 * square);
}

}  // namespace

void add_surface_terms(const FitMesh& mesh, const FitTriangles& triangles, const FitInput& input,
                       const std::vector<TriangleForm>& forms, const std::vector<Vec3d>& points,
                       const FitOptions& options, double energy, FitSystem& system) {
  double area = 0;
  for (const double a : triangles.area) area += a;
  const std::vector<Pull> twists = twists_of(mesh, points, area > 0 ? options.planarity_weight / area : 0);
  const std::vector<Pull> turns =
      turns_of(mesh, triangles, forms, input.tensor.empty() ? 0 : energy * options.alignment_weight,
               input.follow, shortest * shortest * area / mesh.n_polygons(), points);
  system.fill([&](int v, FitSystem::Row& row) {
    for (int i = mesh.first_polygon[at(v)]; i < mesh.first_polygon[at(v) + 1]; ++i) {
      const int p = mesh.polygons[at(i)];
      for (size_t t = at(triangles.first[at(p)]); t < at(triangles.first[at(p) + 1]); ++t)
        add_triangle(triangles.corner[t], forms[t], v, row);
      if (twists[at(p)].weight > 0) add_twist(mesh, p, twists[at(p)], v, row);
    }
    for (int i = mesh.first_side[at(v)]; i < mesh.first_side[at(v) + 1]; ++i) {
      const size_t s = at(mesh.sides_at[at(i)]);
      if (turns[s].weight > 0) add_turn(mesh.sides[s], turns[s], v, row);
    }
  });
}

}  // namespace anisomesh::detail
