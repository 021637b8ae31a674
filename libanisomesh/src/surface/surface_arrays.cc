#include "surface/surface_arrays.hh"

#include "anisomesh/features.hh"

namespace anisomesh::detail {

SurfaceArrays::SurfaceArrays(const SurfaceRef& surface) : points(surface.points()) {
  const auto& mesh = surface.connectivity();
  corners.resize(mesh.n_faces());
  neighbours.resize(mesh.n_faces());
  at_wall.assign(points.size(), 0);
  star_begin.assign(points.size() + 1, 0);
  for (size_t f = 0; f < corners.size(); ++f) {
    const OpenMesh::FaceHandle face(static_cast<int>(f));
    auto halfedge = mesh.next_halfedge_handle(mesh.halfedge_handle(face));  // from corner 0 to corner 1
    for (size_t i = 0; i < 3; ++i, halfedge = mesh.next_halfedge_handle(halfedge)) {
      const int from = mesh.from_vertex_handle(halfedge).idx();
      corners[f][i] = from;
      ++star_begin[static_cast<size_t>(from) + 1];
      const bool wall = is_feature_or_border(mesh, mesh.edge_handle(halfedge));
      neighbours[f][i] = wall ? -1 : mesh.face_handle(mesh.opposite_halfedge_handle(halfedge)).idx();
      if (wall)
        at_wall[static_cast<size_t>(from)] =
            at_wall[static_cast<size_t>(mesh.to_vertex_handle(halfedge).idx())] = 1;
    }
  }
  for (size_t v = 0; v < points.size(); ++v) star_begin[v + 1] += star_begin[v];
  star.resize(static_cast<size_t>(star_begin.back()));
  std::vector<int> next(star_begin.begin(), star_begin.end() - 1);
  for (size_t f = 0; f < corners.size(); ++f)
    for (const int v : corners[f])
      star[static_cast<size_t>(next[static_cast<size_t>(v)]++)] = static_cast<int>(f);
}

}  // namespace anisomesh::detail
