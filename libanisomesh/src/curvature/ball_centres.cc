#include "curvature/ball_centres.hh"

#include "curvature/ball_flood.hh"
#include "surface/intrinsic_order.hh"

namespace anisomesh::detail {

std::vector<int> choose_centres(const SurfaceArrays& surface, const std::vector<double>& reach) {
  std::vector<int> centres;
  std::vector<char> covered(reach.size(), 0);
  BallFlood flood(surface);
  for (const int v : intrinsic_vertex_order(surface)) {
    const auto i = static_cast<size_t>(v);
    if (surface.at_wall[i] || surface.star_size(v) == 0) {
      centres.push_back(v);
      continue;
    }
    if (covered[i]) continue;
    centres.push_back(v);
    flood.reset();
    flood.walk(surface.star_of(v)[0], surface.points[i], reach[i], [&](int face, bool whole) {
      for (const int corner : surface.corners[static_cast<size_t>(face)]) {
        const auto c = static_cast<size_t>(corner);
        if (whole || (surface.points[c] - surface.points[i]).sqrnorm() < reach[i] * reach[i]) covered[c] = 1;
      }
    });
  }
  return centres;
}

}  // namespace anisomesh::detail
