#include "mesher/upright_quads.hh"

#include <algorithm>
#include <array>

#include "mesher/polygon_adjacency.hh"
#include "numerics/shorter_diagonal.hh"
#include "surface/rounding.hh"

namespace anisomesh::detail {

namespace {

constexpr double least_cosine = 0.3;
size_t at(int i) { return static_cast<size_t>(i); }

/// Whether both edges between three nodes are of a feature or the border.
bool on_curve(int a, int b, int c, const PlanarGraph& graph) {
  for (const auto& side : {std::array<int, 2>{a, b}, {b, c}}) {
    const int e = graph.find_edge(side[0], side[1]);
    if (e < 0 || is_line(graph.edge(e).kind)) return false;
  }
  return true;
}

/// Whether a triangle beside the diagonal from a corner has three corners of one curve and stands upright.
bool is_upright(const std::vector<int>& quad, size_t corner, const NetworkGraph& network) {
  const auto node = [&](size_t k) { return quad[(corner + k) % 4]; };
  const auto p = [&](size_t k) { return network.positions[at(node(k))]; };
  const Vec3d along = p(2) - p(0), first = cross(p(1) - p(0), along), second = cross(along, p(3) - p(0));
  const Vec3d whole = first + second;
  // One without area, as between three corners on a straight curve, faces nowhere; it is no better.
  const double least = kRounding * along.sqrnorm();
  const auto stands = [&](const Vec3d& n) {
    return n.norm() <= least || (n | whole) < least_cosine * n.norm() * whole.norm();
  };
  return (stands(first) && on_curve(node(0), node(1), node(2), network.graph)) ||
         (stands(second) && on_curve(node(2), node(3), node(0), network.graph));
}

}  // namespace

size_t split_upright_quads(std::vector<std::vector<int>>& polygons, const NetworkGraph& network) {
  struct Split {
    size_t polygon, corner;
  };
  std::vector<Split> splits;
  for (size_t i = 0; i < polygons.size(); ++i) {
    const auto& quad = polygons[i];
    if (quad.size() != 4) continue;
    const size_t shorter = shorter_diagonal(quad, network.positions);
    if (is_upright(quad, shorter, network) && !is_upright(quad, 1 - shorter, network))
      splits.push_back({i, 1 - shorter});
  }
  if (splits.empty()) return 0;
  const PolygonAdjacency adjacency(polygons, network.graph.n_nodes(), [](int, int) { return true; });
  std::vector<std::array<int, 2>> taken;
  for (const Split& split : splits) {
    const std::vector<int> quad = polygons[split.polygon];
    const int a = quad[split.corner], c = quad[split.corner + 2];
    const std::array<int, 2> diagonal{std::min(a, c), std::max(a, c)};
    if (adjacency.are_joined(a, c) || std::find(taken.begin(), taken.end(), diagonal) != taken.end())
      continue;
    taken.push_back(diagonal);
    polygons[split.polygon] = {a, quad[split.corner + 1], c};
    polygons.push_back({a, c, quad[(split.corner + 3) % 4]});
  }
  return taken.size();
}

}  // namespace anisomesh::detail
