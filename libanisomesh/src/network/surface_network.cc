#include "network/surface_network.hh"

namespace anisomesh::detail {

NetworkGraph network_of(const SurfaceRef& surface, const SurfaceNormals& normals, const Overlay& overlay) {
  NetworkGraph network;
  network.planar = false;
  network.points = overlay.points;
  network.origins = overlay.origins;
  network.fixed = overlay.fixed;
  network.crossings = overlay.crossings;
  for (const SurfacePoint& p : overlay.points) {
    network.graph.add_node({0, 0});
    network.positions.push_back(position(surface, p));
    network.normals.push_back(normals.at(p));
  }
  for (const auto& e : overlay.edges) network.graph.add_edge(e.node[0], e.node[1], e.kind, 0);
  return network;
}

}  // namespace anisomesh::detail
