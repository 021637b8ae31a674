#include "fit/fit_mesh.hh"

#include <algorithm>
#include <cmath>

#include "compare/compare_parts.hh"

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

constexpr double no_side = 1e100;  // "height" over a diagonal: beyond it lies the same polygon

bool is_curve(const OpenMesh::PolyMesh& mesh, OpenMesh::EdgeHandle e) {
  return mesh.is_boundary(e) || (mesh.has_edge_status() && mesh.status(e).feature());
}

// The polygons around a corner of a polygon, both ways as far as a feature or the border.
void add_fan(const OpenMesh::PolyMesh& mesh, OpenMesh::HalfedgeHandle start, std::vector<int>& found) {
  const auto wall = [&](OpenMesh::HalfedgeHandle h) { return is_curve(mesh, mesh.edge_handle(h)); };
  // around the to-vertex of `start`
  auto h = start;
  while (!wall(h)) {
    h = mesh.prev_halfedge_handle(mesh.opposite_halfedge_handle(h));
    if (h == start) return;
    found.push_back(mesh.face_handle(h).idx());
  }
  for (h = mesh.next_halfedge_handle(start); !wall(h);) {
    h = mesh.next_halfedge_handle(mesh.opposite_halfedge_handle(h));
    found.push_back(mesh.face_handle(h).idx());
  }
}

}  // namespace

FitMesh::FitMesh(const OpenMesh::PolyMesh& mesh) : n_vertices(static_cast<int>(mesh.n_vertices())) {
  first_corner.push_back(0);
  first_around.push_back(0);
  first_polygon.assign(at(n_vertices) + 1, 0);
  for (const auto e : mesh.edges()) sides.push_back({e.v0().idx(), e.v1().idx(), is_curve(mesh, e)});
  std::vector<int> found;
  for (const auto f : mesh.faces()) {
    found.clear();
    for (const auto h : mesh.fh_range(f)) {
      corner_side.push_back(mesh.edge_handle(mesh.next_halfedge_handle(h)).idx());
      corners.push_back(mesh.to_vertex_handle(h).idx());
      ++first_polygon[at(corners.back()) + 1];
      add_fan(mesh, h, found);
    }
    first_corner.push_back(static_cast<int>(corners.size()));
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    for (const int p : found)
      if (p != f.idx()) around.push_back(p);
    first_around.push_back(static_cast<int>(around.size()));
  }
  for (int v = 0; v < n_vertices; ++v) first_polygon[at(v) + 1] += first_polygon[at(v)];
  polygons.resize(corners.size());
  std::vector<int> next(first_polygon.begin(), first_polygon.end() - 1);
  for (int p = 0; p < n_polygons(); ++p)
    for (const int* v = begin(p); v != end(p); ++v) polygons[at(next[at(*v)]++)] = p;
  connect_sides();
}

void FitMesh::connect_sides() {
  beside.assign(sides.size(), {-1, -1});
  for (int p = 0; p < n_polygons(); ++p)
    for (int i = first_corner[at(p)]; i < first_corner[at(p) + 1]; ++i) {
      auto& pair = beside[at(corner_side[at(i)])];
      pair[pair[0] < 0 ? 0 : 1] = p;
    }
  first_side.assign(at(n_vertices) + 1, 0);
  for (const Side& side : sides)
    for (const int v : {side.from, side.to}) ++first_side[at(v) + 1];
  for (int v = 0; v < n_vertices; ++v) first_side[at(v) + 1] += first_side[at(v)];
  sides_at.resize(2 * sides.size());
  std::vector<int> next(first_side.begin(), first_side.end() - 1);
  for (size_t s = 0; s < sides.size(); ++s)
    for (const int v : {sides[s].from, sides[s].to}) sides_at[at(next[at(v)]++)] = static_cast<int>(s);
}

int FitMesh::side(int polygon, int v, int w) const {
  const int n = degree(polygon), first = first_corner[at(polygon)];
  for (int i = 0; i < n; ++i)
    if (corners[at(first + i)] == v && corners[at(first + (i + 1) % n)] == w)
      return corner_side[at(first + i)];
  return -1;
}

FitTriangles::FitTriangles(const FitMesh& mesh, const std::vector<Vec3d>& points) {
  std::vector<Vec3d> place;
  for (int p = 0; p < mesh.n_polygons(); ++p) {
    first.push_back(static_cast<int>(corner.size()));
    place.clear();
    Vec3d sum(0, 0, 0), newell(0, 0, 0);
    for (const int* v = mesh.begin(p); v != mesh.end(p); ++v) {
      place.push_back(points[at(*v)]);
      sum += place.back();
    }
    for (size_t i = 1; i + 1 < place.size(); ++i)
      newell += cross(place[i] - place[0], place[i + 1] - place[0]);
    const double length = newell.norm();
    centre.push_back(sum / static_cast<double>(place.size()));
    double squared = 0;
    for (const Vec3d& x : place) squared = std::max(squared, (x - centre.back()).sqrnorm());
    radius.push_back(std::sqrt(squared));
    for (const Triangle& local :
         triangulate_polygon(place, length > 0 ? newell / length : newell, FaceDiagonal::shorter)) {
      const Vec3d &a = place[at(local[0])], &b = place[at(local[1])], &c = place[at(local[2])];
      const Vec3d n = cross(b - a, c - a);
      const double twice = n.norm();
      corner.push_back({mesh.begin(p)[local[0]], mesh.begin(p)[local[1]], mesh.begin(p)[local[2]]});
      side.push_back({mesh.side(p, corner.back()[0], corner.back()[1]),
                      mesh.side(p, corner.back()[1], corner.back()[2]),
                      mesh.side(p, corner.back()[2], corner.back()[0])});
      normal.push_back(twice > 0 ? n / twice : Vec3d(0, 0, 0));
      area.push_back(0.5 * twice);
      box.emplace_back();
      for (const Vec3d& x : {a, b, c}) box.back().add(x);
      const auto over = [&](size_t k, const Vec3d& along) {
        if (side.back()[k] < 0) return no_side;
        return twice > 0 ? twice / along.norm() : 0;
      };
      height.emplace_back(over(1, c - b), over(2, a - c), over(0, b - a));
    }
  }
  first.push_back(static_cast<int>(corner.size()));
}

}  // namespace anisomesh::detail
