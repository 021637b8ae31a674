#include "anisomesh/subdivide.hh"

#include <cmath>
#include <string>
#include <vector>

#include "anisomesh/errors.hh"
#include "anisomesh/mesher.hh"
#include "anisomesh/properties.hh"
#include "surface/unfit_mesh.hh"

namespace anisomesh {

namespace {

using OpenMesh::EdgeHandle, OpenMesh::FaceHandle, OpenMesh::PolyMesh, OpenMesh::VertexHandle;

/// A mesh and what holds its vertices: both survive a level.
struct Level {
  PolyMesh mesh;
  std::vector<char> fixed;  ///< of each vertex
};

size_t at(int i) { return static_cast<size_t>(i); }

bool is_crease(const PolyMesh& mesh, EdgeHandle edge) {
  return mesh.is_boundary(edge) || (mesh.has_edge_status() && mesh.status(edge).feature());
}

/// Every face in four, without moving anything: vertices, then one on each edge, then one in each face that
/// is no triangle.
Level divided(const Level& coarse) {
  const PolyMesh& mesh = coarse.mesh;
  Level fine;
  fine.mesh.request_vertex_status();
  fine.mesh.request_edge_status();
  fine.mesh.request_face_status();
  for (const auto v : mesh.vertices()) fine.mesh.add_vertex(mesh.point(v));
  for (const auto e : mesh.edges()) fine.mesh.add_vertex(mesh.calc_edge_midpoint(e));
  const auto on_edge = [&](EdgeHandle e) {
    return VertexHandle(static_cast<int>(mesh.n_vertices()) + e.idx());
  };
  for (const auto f : mesh.faces()) {
    const bool triangle = mesh.valence(f) == 3;
    const VertexHandle middle = triangle ? VertexHandle() : fine.mesh.add_vertex(mesh.calc_face_centroid(f));
    std::vector<VertexHandle> inner;
    for (const auto h : mesh.fh_range(f)) {
      const auto here = on_edge(mesh.edge_handle(h));
      const auto next = on_edge(mesh.edge_handle(mesh.next_halfedge_handle(h)));
      if (triangle)
        fine.mesh.add_face(here, mesh.to_vertex_handle(h), next);
      else
        fine.mesh.add_face(here, mesh.to_vertex_handle(h), next, middle);
      inner.push_back(here);
    }
    if (triangle) fine.mesh.add_face(inner);
  }
  for (const auto e : mesh.edges())
    if (is_crease(mesh, e))
      for (const int end : {0, 1}) {
        const auto h =
            fine.mesh.find_halfedge(mesh.to_vertex_handle(mesh.halfedge_handle(e, end)), on_edge(e));
        if (!mesh.is_boundary(e)) fine.mesh.status(fine.mesh.edge_handle(h)).set_feature(true);
      }
  fine.fixed = coarse.fixed;
  fine.fixed.resize(fine.mesh.n_vertices(), 0);
  return fine;
}

/// The mean of a vertex, the ends of its edges (half the weight) and the corners opposite in its quads (a
/// quarter), or along its crease. [Stam and Loop 2003]
Vec3d averaged(const PolyMesh& mesh, VertexHandle v) {
  Vec3d sum = mesh.point(v), along(0, 0, 0);
  double weight = 1;
  int creases = 0;
  for (const auto h : mesh.voh_range(v)) {
    const Vec3d& neighbour = mesh.point(mesh.to_vertex_handle(h));
    sum += 0.5 * neighbour;
    weight += 0.5;
    if (is_crease(mesh, mesh.edge_handle(h))) ++creases, along += neighbour;
    if (mesh.is_boundary(h) || mesh.valence(mesh.face_handle(h)) != 4) continue;
    sum += 0.25 * mesh.point(mesh.to_vertex_handle(mesh.next_halfedge_handle(h)));
    weight += 0.25;
  }
  if (creases == 0) return sum / weight;
  return creases == 2 ? 0.5 * mesh.point(v) + 0.25 * along : mesh.point(v);
}

void smooth(Level& level) {
  std::vector<Vec3d> points;
  points.reserve(level.mesh.n_vertices());
  for (const auto v : level.mesh.vertices())
    points.push_back(level.fixed[at(v.idx())] || level.mesh.is_isolated(v) ? level.mesh.point(v)
                                                                           : averaged(level.mesh, v));
  for (const auto v : level.mesh.vertices()) level.mesh.set_point(v, points[at(v.idx())]);
}

constexpr double most_faces = 1e8;  // OpenMesh counts sides, four times as many, in an int

double faces_after(const PolyMesh& mesh, int levels) {
  double faces = 0;  // after the first level
  for (const auto f : mesh.faces()) faces += mesh.valence(f) == 3 ? 4 : mesh.valence(f);
  return levels == 0 ? static_cast<double>(mesh.n_faces()) : faces * std::pow(4.0, levels - 1);
}

std::vector<char> corners(const PolyMesh& mesh) {
  std::vector<char> fixed(mesh.n_vertices(), 0);
  if (!has_property(mesh, property::origin)) return fixed;
  const auto origin = require_property(mesh, property::origin);
  for (const auto v : mesh.vertices())
    fixed[at(v.idx())] = mesh.property(origin, v) == static_cast<int>(Origin::corner);
  return fixed;
}

}  // namespace

PolyMesh subdivide(const PolyMesh& mesh, int levels) {
  if (levels < 0 || levels > 8)
    throw InvalidOption("levels must be from 0 to 8, but is " + std::to_string(levels));
  if (mesh.n_faces() == 0) throw InvalidInput("the mesh has no faces");
  detail::refuse_deleted_elements(mesh, "the mesh");
  if (faces_after(mesh, levels) > most_faces)
    throw InvalidOption("levels must be fewer than " + std::to_string(levels) + " for a mesh of " +
                        std::to_string(mesh.n_faces()) + " faces: 100,000,000 are the most that are made");
  Level level{mesh, corners(mesh)};
  for (int i = 0; i < levels; ++i) {
    level = divided(level);
    smooth(level);
  }
  return std::move(level.mesh);
}

}  // namespace anisomesh
