#include "fit_system.hh"

#include <tbb/parallel_for.h>

#include <array>

#include "numerics/sparse_solver.hh"

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

// A symmetric 3 x 3 matrix as (xx, xy, xz, yy, yz, zz).
using Block = std::array<double, 6>;

void add_square(Block& block, double weight, const Vec3d& n) {
  block[0] += weight * n[0] * n[0];
  block[1] += weight * n[0] * n[1];
  block[2] += weight * n[0] * n[2];
  block[3] += weight * n[1] * n[1];
  block[4] += weight * n[1] * n[2];
  block[5] += weight * n[2] * n[2];
}

// Corners (0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0).
constexpr std::array<std::array<int, 2>, 6> corner_pair{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};

/// What one triangle adds: a quadratic form of the steps of its three corners.
struct TriangleForm {
  std::array<Block, 6> block{};
  std::array<Vec3d, 3> right{Vec3d(0, 0, 0), Vec3d(0, 0, 0), Vec3d(0, 0, 0)};
  double weight = 0;

  // weight * (distance - direction | sum of barycentric * step)^2
  void add(const FitPair& pair) {
    weight += pair.weight;
    Block square{};
    add_square(square, pair.weight, pair.direction);
    for (size_t k = 0; k < 6; ++k) {
      const double both = pair.barycentric[corner_pair[k][0]] * pair.barycentric[corner_pair[k][1]];
      for (size_t i = 0; i < 6; ++i) block[k][i] += both * square[i];
    }
    for (int k = 0; k < 3; ++k)
      right[at(k)] += pair.weight * pair.distance * pair.barycentric[k] * pair.direction;
  }

  // The squared heights of the sides against the normals whose squares are in `normals`.
  void add_sides(const Block& normals, const std::array<Vec3d, 3>& place) {
    for (size_t k = 0; k < 3; ++k) {
      const size_t l = (k + 1) % 3;
      const Vec3d side = place[l] - place[k];
      const Vec3d pull(normals[0] * side[0] + normals[1] * side[1] + normals[2] * side[2],
                       normals[1] * side[0] + normals[3] * side[1] + normals[4] * side[2],
                       normals[2] * side[0] + normals[4] * side[1] + normals[5] * side[2]);
      right[k] += pull;
      right[l] -= pull;
      for (size_t i = 0; i < 6; ++i) {
        block[k][i] += normals[i];
        block[l][i] += normals[i];
        block[3 + k][i] -= normals[i];
      }
    }
  }
};

class System {
 public:
  System(const std::vector<char>& free) : unknown_(free.size(), -1) {
    for (size_t v = 0; v < free.size(); ++v)
      if (free[v]) unknown_[v] = n_++;
    right_.assign(at(3 * n_), 0);
    damping_.assign(at(n_), 0);
  }

  void reserve(size_t blocks, SymmetricEntries& entries) const { entries.reserve(9 * blocks); }
  int size() const { return 3 * n_; }

  void add(SymmetricEntries& entries, int v, int w, const Block& b) const {
    const int i = unknown_[at(v)], j = unknown_[at(w)];
    if (i < 0 || j < 0) return;
    const double full[3][3] = {{b[0], b[1], b[2]}, {b[1], b[3], b[4]}, {b[2], b[4], b[5]}};
    for (int r = 0; r < 3; ++r)
      for (int c = v == w ? r : 0; c < 3; ++c) entries.add(3 * i + r, 3 * j + c, full[r][c]);
  }
  void add_right(int v, const Vec3d& value) {
    const int i = unknown_[at(v)];
    if (i < 0) return;
    for (int r = 0; r < 3; ++r) right_[at(3 * i + r)] += value[r];
  }
  void add_damping(int v, double weight) {
    if (unknown_[at(v)] >= 0) damping_[at(unknown_[at(v)])] += weight;
  }
  std::vector<Vec3d> solve(SymmetricEntries& entries) const {
    for (int i = 0; i < n_; ++i)
      for (int r = 0; r < 3; ++r) entries.add(3 * i + r, 3 * i + r, damping_[at(i)]);
    const std::vector<double> x = CholeskySolver(entries).solve(right_);
    std::vector<Vec3d> step(unknown_.size(), Vec3d(0, 0, 0));
    for (size_t v = 0; v < step.size(); ++v)
      if (unknown_[v] >= 0)
        for (int r = 0; r < 3; ++r) step[v][r] = x[at(3 * unknown_[v] + r)];
    return step;
  }

 private:
  int n_ = 0;
  std::vector<int> unknown_;
  std::vector<double> right_, damping_;
};

std::vector<TriangleForm> forms_of(const FitTriangles& triangles, const std::vector<FitPair>& pairs,
                                   const std::vector<Vec3d>& points, double normal_weight) {
  std::vector<int> first(triangles.corner.size() + 1, 0), order(pairs.size());
  for (const FitPair& pair : pairs)
    if (pair.triangle >= 0) ++first[at(pair.triangle) + 1];
  for (size_t t = 0; t + 1 < first.size(); ++t) first[t + 1] += first[t];
  std::vector<int> next(first.begin(), first.end() - 1);
  for (size_t i = 0; i < pairs.size(); ++i)
    if (pairs[i].triangle >= 0) order[at(next[at(pairs[i].triangle)]++)] = static_cast<int>(i);
  std::vector<TriangleForm> forms(triangles.corner.size());
  tbb::parallel_for(size_t{0}, forms.size(), [&](size_t t) {
    Block normals{};
    for (int i = first[t]; i < first[t + 1]; ++i) {
      const FitPair& pair = pairs[at(order[at(i)])];
      forms[t].add(pair);
      add_square(normals, normal_weight * pair.weight, pair.normal);
    }
    const Triangle& c = triangles.corner[t];
    forms[t].add_sides(normals, {points[at(c[0])], points[at(c[1])], points[at(c[2])]});
  });
  return forms;
}

// The twist of a quad: how far its corners lie over and under their plane.
void add_planarity(const FitMesh& mesh, const FitTriangles& triangles, const std::vector<Vec3d>& points,
                   double planarity_weight, double total_area, SymmetricEntries& entries, System& system) {
  for (int p = 0; p < mesh.n_polygons(); ++p) {
    if (mesh.degree(p) != 4) continue;
    const int* v = mesh.begin(p);
    const Vec3d normal = cross(points[at(v[2])] - points[at(v[0])], points[at(v[3])] - points[at(v[1])]);
    const double length = normal.norm();
    if (!(length > 0)) continue;
    const Vec3d n = normal / length;
    const double twist = n | (points[at(v[0])] - points[at(v[1])] + points[at(v[2])] - points[at(v[3])]);
    const double weight = planarity_weight * 0.5 * length / total_area;
    for (int i = 0; i < 4; ++i) {
      const double sign = i % 2 == 0 ? 1 : -1;
      system.add_right(v[i], -weight * sign * twist * n);
      for (int j = 0; j <= i; ++j) {
        Block block{};
        add_square(block, weight * ((i - j) % 2 == 0 ? 1 : -1), n);
        system.add(entries, v[i], v[j], block);
      }
    }
  }
  (void)triangles;
}

}  // namespace

std::vector<Vec3d> solve_fit(const FitMesh& mesh, const FitTriangles& triangles,
                             const std::vector<FitPair>& pairs, const std::vector<Vec3d>& points,
                             const std::vector<char>& free, const FitOptions& options) {
  System system(free);
  if (system.size() == 0) return std::vector<Vec3d>(points.size(), Vec3d(0, 0, 0));
  const auto forms = forms_of(triangles, pairs, points, options.normal_weight);
  SymmetricEntries entries(at(system.size()));
  system.reserve(6 * forms.size(), entries);
  double total_area = 0;
  for (size_t t = 0; t < forms.size(); ++t) {
    const Triangle& c = triangles.corner[t];
    for (size_t k = 0; k < 6; ++k)
      system.add(entries, c[at(corner_pair[k][0])], c[at(corner_pair[k][1])], forms[t].block[k]);
    for (size_t k = 0; k < 3; ++k) {
      system.add_right(c[k], forms[t].right[k]);
      system.add_damping(c[k], options.damping * (forms[t].weight / 3 + 1e-12));
    }
    total_area += triangles.area[t];
  }
  add_planarity(mesh, triangles, points, options.planarity_weight, total_area, entries, system);
  return system.solve(entries);
}

}  // namespace anisomesh::detail
