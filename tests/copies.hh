// Copies of a surface that are the same surface elsewhere, larger, smaller, turned or numbered otherwise.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <vector>

#include "anisomesh/features.hh"
#include "anisomesh/surface.hh"

namespace copies {

using anisomesh::Vec3d;

struct Change {
  const char* name;
  double scale;
  std::function<Vec3d(const Vec3d&)> apply;
  bool renumbers;
};

/// A million times the size, or up to four times as much.
inline double far_off(double size) { return std::exp2(21 + std::ceil(std::log2(size))); }

/// The mesh with coordinates of fewer digits, so that moving it far off rounds nothing.
inline OpenMesh::TriMesh representable(OpenMesh::TriMesh mesh, double size) {
  const double step = far_off(size) * std::exp2(-51);
  for (const auto v : mesh.vertices()) {
    auto p = mesh.point(v);
    for (size_t k = 0; k < 3; ++k) p[k] = step * std::round(p[k] / step);
    mesh.set_point(v, p);
  }
  return mesh;
}

/// \param size the diagonal
inline std::vector<Change> changes(double size) {
  const auto same = [](const Vec3d& p) { return p; };
  const double far = far_off(size);
  const auto turned = [](double x, double y, double z, double angle) {  // Rodrigues' formula
    return [=, axis = Vec3d(x, y, z).normalized()](const Vec3d& p) {
      return std::cos(angle) * p + std::sin(angle) * (axis % p) + (1 - std::cos(angle)) * (axis | p) * axis;
    };
  };
  return {{"scaled by 1e-6", 1e-6, [](const Vec3d& p) { return 1e-6 * p; }, false},
          {"scaled by 1e6", 1e6, [](const Vec3d& p) { return 1e6 * p; }, false},
          {"moved by 1e6 of its size", 1, [=](const Vec3d& p) { return p + Vec3d(far, -far, far); }, false},
          {"turned", 1, turned(1, 2, 3, 1), false},
          {"turned farther", 1, turned(-2, 1, 0.3, 2.2), false},
          {"axes swapped", 1, [](const Vec3d& p) { return Vec3d(p[1], p[2], p[0]); }, false},
          {"renumbered", 1, same, true}};
}

inline OpenMesh::TriMesh changed(const OpenMesh::TriMesh& mesh, const Change& change) {
  std::mt19937 generator(7);
  const auto below = [&](size_t n) { return generator() % n; };
  const auto shuffle = [&](auto& list) {  // std::shuffle differs from one standard library to the next
    for (size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[below(i)]);
  };
  std::vector<int> order(mesh.n_vertices());
  std::iota(order.begin(), order.end(), 0);
  if (change.renumbers) shuffle(order);
  OpenMesh::TriMesh result;
  result.request_vertex_status();
  result.request_edge_status();
  result.request_face_status();
  std::vector<OpenMesh::VertexHandle> vertex(order.size());
  for (const int v : order)
    vertex[static_cast<size_t>(v)] = result.add_vertex(change.apply(mesh.point(OpenMesh::VertexHandle(v))));
  std::vector<std::vector<OpenMesh::VertexHandle>> faces;
  for (const auto f : mesh.faces()) {
    faces.emplace_back();
    for (const auto v : f.vertices()) faces.back().push_back(vertex[static_cast<size_t>(v.idx())]);
    if (change.renumbers)
      std::rotate(faces.back().begin(), faces.back().begin() + static_cast<long>(below(3)),
                  faces.back().end());
  }
  if (change.renumbers) shuffle(faces);
  for (const auto& corners : faces) result.add_face(corners);
  return result;
}

/// The corners of a polygon, the lowest first.
template <class Mesh>
std::vector<int> corners(const Mesh& mesh, OpenMesh::FaceHandle face) {
  std::vector<int> result;
  for (const auto v : mesh.fv_range(face)) result.push_back(v.idx());
  std::rotate(result.begin(), std::min_element(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace copies
