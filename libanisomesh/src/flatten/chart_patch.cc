#include "flatten/chart_patch.hh"

#include <algorithm>
#include <limits>
#include <queue>

#include "numerics/disjoint_sets.hh"
#include "surface/cut_surface.hh"

namespace anisomesh::detail {

FaceSides::FaceSides(const SurfaceRef& surface) {
  const auto& mesh = surface.connectivity();
  std::vector<int> side_of(mesh.n_halfedges(), -1);
  vertex.resize(3 * mesh.n_faces());
  for (const auto f : mesh.all_faces()) {
    auto h = mesh.halfedge_handle(f);  // from corner 2 to corner 0
    for (const int i : {2, 0, 1}) {
      const int side = 3 * f.idx() + i;
      side_of[static_cast<size_t>(h.idx())] = side;
      vertex[static_cast<size_t>(side)] = mesh.from_vertex_handle(h).idx();
      h = mesh.next_halfedge_handle(h);
    }
  }
  twin.assign(vertex.size(), -1);
  feature.assign(vertex.size(), 0);
  for (const auto e : mesh.all_edges()) {
    const int side[2] = {side_of[static_cast<size_t>(e.h0().idx())],
                         side_of[static_cast<size_t>(e.h1().idx())]};
    for (const int k : {0, 1})
      if (side[k] >= 0) {
        twin[static_cast<size_t>(side[k])] = side[1 - k];
        feature[static_cast<size_t>(side[k])] = is_feature(mesh, e) ? 1 : 0;
      }
  }
}

int place_among(const std::vector<int>& faces, int face) {
  const auto found = std::lower_bound(faces.begin(), faces.end(), face);
  return found != faces.end() && *found == face ? static_cast<int>(found - faces.begin()) : -1;
}

ChartPatch::ChartPatch(const SurfaceRef& surface, const FaceSides& sides, const Region& region) {
  // The side across in the numbers of the region, or -1.
  const size_t size = region.faces.size();
  std::vector<int> across(3 * size, -1);
  DisjointSets corners(3 * size);
  size_t border_sides = 0;
  for (size_t k = 0; k < size; ++k)
    for (int i = 0; i < 3; ++i) {
      const int side = 3 * region.faces[k] + i, twin = sides.twin[static_cast<size_t>(side)];
      const int local = 3 * static_cast<int>(k) + i;
      const int other = twin < 0 ? -1 : place_among(region.faces, twin / 3);
      if (other < 0 || std::binary_search(region.slits.begin(), region.slits.end(), side)) {
        ++border_sides;
        continue;
      }
      const int there = 3 * other + twin % 3;
      across[static_cast<size_t>(local)] = there;
      corners.join(static_cast<size_t>(local), static_cast<size_t>(next_side(there)));
      corners.join(static_cast<size_t>(next_side(local)), static_cast<size_t>(there));
    }
  std::vector<int> node(3 * size, -1);
  patch.triangles.resize(size);
  for (size_t c = 0; c < 3 * size; ++c) {
    int& number = node[corners.root(c)];
    if (number < 0) {
      number = static_cast<int>(patch.points.size());
      const int vertex = sides.vertex[static_cast<size_t>(3 * region.faces[c / 3]) + c % 3];
      patch.points.push_back(surface.point(OpenMesh::VertexHandle(vertex)));
    }
    patch.triangles[c / 3][c % 3] = number;
  }
  euler = static_cast<long>(patch.points.size()) - static_cast<long>((3 * size + border_sides) / 2) +
          static_cast<long>(size);
  std::vector<char> seen(3 * size, 0);
  for (int start = 0; start < static_cast<int>(3 * size); ++start) {
    if (across[static_cast<size_t>(start)] >= 0 || seen[static_cast<size_t>(start)]) continue;
    loops.emplace_back();
    int side = start;
    do {
      seen[static_cast<size_t>(side)] = 1;
      loops.back().push_back(3 * region.faces[static_cast<size_t>(side / 3)] + side % 3);
      if (loops.size() == 1)
        patch.border.push_back(patch.triangles[static_cast<size_t>(side / 3)][static_cast<size_t>(side % 3)]);
      side = next_side(side);
      while (across[static_cast<size_t>(side)] >= 0) side = next_side(across[static_cast<size_t>(side)]);
    } while (side != start);
  }
}

std::vector<int> shortest_slit(const FaceSides& sides, const Region& region, const ChartPatch& chart) {
  // Dijkstra's algorithm over the points of the patch, from all of the first loop to any of the second.
  const auto& triangles = chart.patch.triangles;
  const auto& points = chart.patch.points;
  struct Way {
    double length = std::numeric_limits<double>::infinity();
    int side = -1;  // of the region, the way comes along it; its direction does not matter
    int from = -1;
  };
  std::vector<std::vector<int>> leaving(points.size());  // sides of the region at each point
  for (size_t t = 0; t < triangles.size(); ++t)
    for (size_t i = 0; i < 3; ++i) {
      leaving[static_cast<size_t>(triangles[t][i])].push_back(static_cast<int>(3 * t + i));
      leaving[static_cast<size_t>(triangles[t][(i + 1) % 3])].push_back(static_cast<int>(3 * t + i));
    }
  const auto point_of = [&](int side) {
    const int k = place_among(region.faces, side / 3);
    return triangles[static_cast<size_t>(k)][static_cast<size_t>(side % 3)];
  };
  std::vector<Way> way(points.size());
  std::vector<char> goal(points.size(), 0);
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> queue;
  for (const int side : chart.loops[1]) goal[static_cast<size_t>(point_of(side))] = 1;
  for (const int side : chart.loops[0]) {
    way[static_cast<size_t>(point_of(side))].length = 0;
    queue.emplace(0.0, point_of(side));
  }
  while (!queue.empty()) {
    const auto [length, p] = queue.top();
    queue.pop();
    if (length > way[static_cast<size_t>(p)].length) continue;
    if (goal[static_cast<size_t>(p)]) {
      std::vector<int> slit;
      for (int q = p; way[static_cast<size_t>(q)].side >= 0; q = way[static_cast<size_t>(q)].from) {
        const int local = way[static_cast<size_t>(q)].side;
        const int side = 3 * region.faces[static_cast<size_t>(local / 3)] + local % 3;
        slit.push_back(side);
        slit.push_back(sides.twin[static_cast<size_t>(side)]);
      }
      std::sort(slit.begin(), slit.end());
      return slit;
    }
    for (const int side : leaving[static_cast<size_t>(p)]) {
      const auto& t = triangles[static_cast<size_t>(side / 3)];
      const int a = t[static_cast<size_t>(side % 3)], b = t[static_cast<size_t>((side % 3 + 1) % 3)];
      const int q = a == p ? b : a;
      Way& there = way[static_cast<size_t>(q)];
      const double through =
          length + (points[static_cast<size_t>(q)] - points[static_cast<size_t>(p)]).norm();
      if (through >= there.length) continue;
      there = {through, side, p};
      queue.emplace(through, q);
    }
  }
  return {};
}

}  // namespace anisomesh::detail
