#include "polygons.hh"

#include <algorithm>
#include <array>

#include "numerics/arrangement.hh"

namespace anisomesh::detail {

namespace {

using Triangle = Arrangement::Triangle;
size_t at(int i) { return static_cast<size_t>(i); }

class Extractor {
 public:
  Extractor(const NetworkGraph& network, const PolygonJudge& judge, const PartitionOptions& options)
      : network_(network), judge_(judge), options_(options) {}

  PolygonSet run() {
    triangulate();
    mark_outside();
    for (size_t t = 0; t < triangles_.size(); ++t)
      if (region_of_[t] == unseen) extract(flood(static_cast<int>(t), ++regions_));
    return std::move(result_);
  }

 private:
  static constexpr int unseen = -2, outside = -1;

  void triangulate();
  void mark_outside();
  std::vector<int> flood(int start, int region);
  bool is_barrier(const Triangle& t, size_t k) const;
  bool is_isotropic(int node) const {
    return network_.origins[at(node)] == Origin::isotropic && network_.fixed[at(node)];
  }
  void extract(const std::vector<int>& triangles);
  RegionCorners corners_of(const std::vector<int>& nodes, const std::vector<int>& triangles) const;

  const NetworkGraph& network_;
  const PolygonJudge& judge_;
  PartitionOptions options_;
  std::vector<Triangle> triangles_;  // their nodes are those of the network
  std::vector<int> kind_;            // of each graph edge of the arrangement
  std::vector<int> region_of_;
  int regions_ = 0;
  PolygonSet result_;
};

void Extractor::triangulate() {
  const PlanarGraph& graph = network_.graph;
  Vec2d low = graph.uv(0), high = graph.uv(0);
  std::vector<int> used;
  for (int n = 0; n < static_cast<int>(graph.n_nodes()); ++n) {
    if (graph.degree(n) == 0 && !network_.fixed[at(n)]) continue;
    used.push_back(n);
  }
  for (const int n : used) {
    low.minimize(graph.uv(n));
    high.maximize(graph.uv(n));
  }
  Arrangement arrangement(low, high);
  std::vector<int> local(graph.n_nodes(), -1);
  for (const int n : used) local[at(n)] = arrangement.insert_point(graph.uv(n));
  for (size_t e = 0; e < graph.n_edges(); ++e) {
    const auto& edge = graph.edge(static_cast<int>(e));
    if (edge.alive)
      arrangement.insert_segment(local[at(edge.node[0])], local[at(edge.node[1])], edge.kind, 0);
  }
  if (arrangement.graph().n_nodes() != used.size())
    throw CannotProcess("the decimated network of lines is not planar; the parameterization is degenerate");
  triangles_ = arrangement.triangles();
  for (Triangle& t : triangles_) {
    for (int& n : t.node) n = n < 0 ? -1 : used[at(n)];
    for (int& e : t.edge) e = e < 0 ? -1 : arrangement.graph().edge(e).kind;
  }
}

// An edge of the network, or of the triangulation at an isotropic sample.
bool Extractor::is_barrier(const Triangle& t, size_t k) const {
  return t.edge[k] >= 0 || is_isotropic(t.node[(k + 1) % 3]) || is_isotropic(t.node[(k + 2) % 3]);
}

void Extractor::mark_outside() {
  region_of_.assign(triangles_.size(), unseen);
  for (size_t t = 0; t < triangles_.size(); ++t) {
    const auto& node = triangles_[t].node;
    if (region_of_[t] == unseen && std::count(node.begin(), node.end(), -1) > 0)
      flood(static_cast<int>(t), outside);
  }
}

std::vector<int> Extractor::flood(int start, int region) {
  std::vector<int> found{start};
  region_of_[at(start)] = region;
  for (size_t i = 0; i < found.size(); ++i) {
    const Triangle& t = triangles_[at(found[i])];
    for (size_t k = 0; k < 3; ++k) {
      const int next = t.neighbor[k];
      const bool blocked = region == outside ? t.edge[k] >= 0 : is_barrier(t, k);
      if (next < 0 || blocked || region_of_[at(next)] != unseen) continue;
      region_of_[at(next)] = region;
      found.push_back(next);
    }
  }
  return found;
}

RegionCorners Extractor::corners_of(const std::vector<int>& nodes, const std::vector<int>& triangles) const {
  RegionCorners corners;
  corners.node = nodes;
  for (const int n : nodes) {
    corners.uv.push_back(network_.graph.uv(n));
    corners.position.push_back(network_.positions[at(n)]);
    corners.face.push_back(network_.points[at(n)].face);
  }
  // One normal for the region: that of the surface in the middle of its triangles, by their size in space.
  for (const int t : triangles) {
    const auto& node = triangles_[at(t)].node;
    Vec2d middle(0, 0);
    for (const int n : node) middle += network_.graph.uv(n) / 3;
    const Vec3d &a = network_.positions[at(node[0])], &b = network_.positions[at(node[1])],
                &c = network_.positions[at(node[2])];
    corners.normal +=
        cross(b - a, c - a).norm() * judge_.surface_normal(middle, network_.points[at(node[0])].face);
  }
  const double length = corners.normal.norm();
  if (length > 0) corners.normal /= length;
  return corners;
}

void Extractor::extract(const std::vector<int>& triangles) {
  std::vector<std::array<int, 2>> sides;
  for (const int t : triangles)
    for (size_t k = 0; k < 3; ++k) {
      const Triangle& triangle = triangles_[at(t)];
      const int next = triangle.neighbor[k];
      if (next < 0 || region_of_[at(next)] != region_of_[at(t)] || is_barrier(triangle, k))
        sides.push_back({triangle.node[(k + 1) % 3], triangle.node[(k + 2) % 3]});
    }
  std::sort(sides.begin(), sides.end());
  const auto leaving = [&](int node) {
    return std::lower_bound(sides.begin(), sides.end(), std::array<int, 2>{node, -1});
  };
  std::vector<int> loop{sides.front()[0]};
  for (int node = sides.front()[1]; node != loop.front() && loop.size() <= sides.size();
       node = (*leaving(node))[1])
    loop.push_back(node);
  const bool once = std::adjacent_find(sides.begin(), sides.end(), [](const auto& x, const auto& y) {
                      return x[0] == y[0];
                    }) == sides.end();

  std::vector<std::vector<int>> pieces;
  RegionCorners corners;
  bool convex = true;
  if (once && loop.size() == sides.size()) {
    corners = corners_of(loop, triangles);
    convex = PolygonJudge::is_convex(corners.position);
    pieces = partition_region(corners, judge_, options_);
  } else {  // a hole, or an edge that ends inside
    std::vector<int> nodes;
    for (const int t : triangles)
      for (const int n : triangles_[at(t)].node) nodes.push_back(n);
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    corners = corners_of(nodes, triangles);
    for (const int t : triangles) {
      pieces.emplace_back();
      for (const int n : triangles_[at(t)].node)
        pieces.back().push_back(
            static_cast<int>(std::lower_bound(nodes.begin(), nodes.end(), n) - nodes.begin()));
    }
    pieces = join_triangles(corners, std::move(pieces), judge_, options_);
  }
  (convex ? result_.conforming_edges : result_.convexity_splits) += pieces.size() - 1;
  for (auto& piece : pieces) {
    for (int& corner : piece) corner = corners.node[at(corner)];
    result_.polygons.push_back(std::move(piece));
  }
}

}  // namespace

PolygonSet extract_polygons(const NetworkGraph& network, const PolygonJudge& judge,
                            const PartitionOptions& options) {
  return Extractor(network, judge, options).run();
}

}  // namespace anisomesh::detail
