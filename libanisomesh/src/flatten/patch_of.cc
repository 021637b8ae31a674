#include "flatten/patch_of.hh"

#include <string>

#include "anisomesh/errors.hh"
#include "surface/canonical_copy.hh"

namespace anisomesh::detail {

namespace {

size_t count_components(const OpenMesh::TriConnectivity& mesh) {
  std::vector<bool> seen(mesh.n_vertices(), false);
  std::vector<OpenMesh::VertexHandle> stack;
  size_t components = 0;
  for (const auto start : mesh.all_vertices()) {
    if (seen[static_cast<size_t>(start.idx())]) continue;
    ++components;
    seen[static_cast<size_t>(start.idx())] = true;
    stack.push_back(start);
    while (!stack.empty()) {
      const auto v = stack.back();
      stack.pop_back();
      for (const auto w : mesh.vv_range(v))
        if (!seen[static_cast<size_t>(w.idx())]) {
          seen[static_cast<size_t>(w.idx())] = true;
          stack.push_back(w);
        }
    }
  }
  return components;
}

void refuse_loose_vertices(const SurfaceRef& surface) {
  const auto& mesh = surface.connectivity();
  for (const auto v : mesh.all_vertices()) {
    if (mesh.is_isolated(v))
      throw CannotProcess("vertex " + std::to_string(given_number(surface, v)) +
                          " belongs to no face; remove such vertices");
    int gaps = 0;
    for (const auto h : mesh.voh_range(v)) gaps += h.is_boundary() ? 1 : 0;
    if (gaps > 1)
      throw CannotProcess("vertex " + std::to_string(given_number(surface, v)) +
                          " joins parts of the surface that share nothing else there (it has " +
                          std::to_string(gaps) + " borders); split it");
  }
}

/// The border loops, each with the surface on its left.
std::vector<std::vector<int>> border_loops(const OpenMesh::TriConnectivity& mesh) {
  std::vector<std::vector<int>> loops;
  std::vector<bool> seen(mesh.n_halfedges(), false);
  for (const auto start : mesh.all_halfedges()) {
    if (!start.is_boundary() || seen[static_cast<size_t>(start.idx())]) continue;
    std::vector<int> loop;
    auto h = start;
    do {  // border halfedges run with the surface on their right: walk against them
      seen[static_cast<size_t>(h.idx())] = true;
      loop.push_back(h.to().idx());
      h = h.prev();
    } while (h != start);
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace

Patch patch_of(const SurfaceRef& surface) {
  const auto& mesh = surface.connectivity();
  refuse_loose_vertices(surface);
  const size_t components = count_components(mesh);
  auto loops = border_loops(mesh);
  const long euler = static_cast<long>(mesh.n_vertices()) - static_cast<long>(mesh.n_edges()) +
                     static_cast<long>(mesh.n_faces());
  if (components != 1 || loops.size() != 1 || euler != 1)
    throw CannotProcess("the surface is not a disc: it has " + std::to_string(components) +
                        " component(s), " + std::to_string(loops.size()) +
                        " border loop(s) and Euler characteristic " + std::to_string(euler) +
                        " where a disc has 1, 1 and 1; " +
                        (components != 1 ? "take one component at a time"
                         : loops.empty() ? "cut it open along a path of edges first"
                         : euler + static_cast<long>(loops.size()) == 2
                             ? "fill the holes that do not matter, or cut it from one border loop to the next"
                             : "cut its handles open first"));
  Patch patch;
  patch.points = surface.points();
  patch.origin = given_place(surface, {0, 0, 0});
  patch.border = std::move(loops.front());
  patch.triangles.reserve(mesh.n_faces());
  for (const auto f : mesh.all_faces()) {
    const auto corners = surface.corners(f);
    patch.triangles.push_back({corners.vertex[0].idx(), corners.vertex[1].idx(), corners.vertex[2].idx()});
  }
  return patch;
}

}  // namespace anisomesh::detail
