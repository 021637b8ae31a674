// CGAL's triangulation is heavy to compile: nothing else is in this source.
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>

#include "shapes/planar_sampling.hh"

namespace anisomesh::detail {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using Face = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex, Face>,
                                               CGAL::No_constraint_intersection_tag>;

/// The infinite face's side of the border chain holds slivers where border points are not exactly on the
/// hull: a triangle is outside if its three corners are border points and it is not counter-clockwise in the
/// chain.
bool outside(const std::array<int, 3>& triangle, const std::vector<int>& rank) {
  int r[3];
  for (int i = 0; i < 3; ++i) {
    r[i] = rank[static_cast<size_t>(triangle[static_cast<size_t>(i)])];
    if (r[i] < 0) return false;
  }
  const int descents = (r[0] > r[1]) + (r[1] > r[2]) + (r[2] > r[0]);
  return descents != 1;
}

}  // namespace

void triangulate_delaunay(PlanarSampling& sampling, const std::vector<int>& border) {
  Triangulation triangulation;
  std::vector<std::pair<Kernel::Point_2, int>> points;
  for (size_t i = 0; i < sampling.points.size(); ++i)
    points.emplace_back(Kernel::Point_2(sampling.points[i][0], sampling.points[i][1]), static_cast<int>(i));
  triangulation.insert(points.begin(), points.end());
  std::vector<Triangulation::Vertex_handle> vertex(sampling.points.size());
  for (auto v = triangulation.finite_vertices_begin(); v != triangulation.finite_vertices_end(); ++v)
    vertex[static_cast<size_t>(v->info())] = v;
  const auto constrain = [&](int a, int b) {
    triangulation.insert_constraint(vertex[static_cast<size_t>(a)], vertex[static_cast<size_t>(b)]);
  };
  for (const auto& [a, b] : sampling.creases) constrain(a, b);
  std::vector<int> rank(sampling.points.size(), -1);
  for (size_t i = 0; i < border.size(); ++i) {
    rank[static_cast<size_t>(border[i])] = static_cast<int>(i);
    constrain(border[i], border[(i + 1) % border.size()]);
  }
  sampling.triangles.clear();
  for (auto f = triangulation.finite_faces_begin(); f != triangulation.finite_faces_end(); ++f) {
    const std::array<int, 3> triangle{f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()};
    if (!outside(triangle, rank)) sampling.triangles.push_back(triangle);
  }
  // The order of CGAL's faces is that of its memory: sort, for the same bytes everywhere.
  for (auto& t : sampling.triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(sampling.triangles.begin(), sampling.triangles.end());
}

}  // namespace anisomesh::detail
