#include "polygons.hh"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "anisomesh/errors.hh"
#include "numerics/arrangement.hh"

namespace anisomesh::detail {

namespace {

using Triangle = Arrangement::Triangle;
size_t at(int i) { return static_cast<size_t>(i); }

double turn(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

class Extractor {
 public:
  Extractor(NetworkGraph& network, const SurfaceRef& surface, const UvLocator& locator,
            const SurfaceNormals& normals, const PolygonJudge& judge, const RegionOptions& options)
      : network_(network),
        surface_(surface),
        locator_(locator),
        normals_(normals),
        judge_(judge),
        options_(options) {}

  PolygonSet run() {
    triangulate();
    flood_all();
    gather_samples();
    if (std::isfinite(options_.cell_tolerance)) gather_probes();
    std::vector<RegionPolygons> results(regions_.size());
    tbb::parallel_for(size_t{0}, regions_.size(), [&](size_t r) {
      outline(regions_[r]);
      results[r] = mesh_region(regions_[r].region, judge_, options_);
    });
    PolygonSet set;
    for (size_t r = 0; r < regions_.size(); ++r) append(regions_[r].region, results[r], set);
    return set;
  }

 private:
  static constexpr int unseen = -2, outside = -1;
  struct Flooded {
    std::vector<int> triangles;
    std::vector<int> samples;  // isotropic, inside
    Region region;
  };

  void triangulate();
  void flood_all();
  std::vector<int> flood(int start, int region);
  int locate(const Vec2d& uv) const;
  const Vec2d& uv_of(int node) const { return node < 0 ? box_[at(-1 - node)] : network_.graph.uv(node); }
  void gather_samples();
  void gather_probes();
  void outline(Flooded& flooded) const;
  std::vector<int> border_of(const Flooded& flooded, bool& simple) const;
  void set_normal(Flooded& flooded) const;
  void append(const Region& region, RegionPolygons& result, PolygonSet& set);
  // A sample that no edge leads to; others are part of the network already.
  bool is_free_sample(int node) const { return network_.fixed[at(node)] && network_.graph.degree(node) == 0; }

  NetworkGraph& network_;
  const SurfaceRef& surface_;
  const UvLocator& locator_;
  const SurfaceNormals& normals_;
  const PolygonJudge& judge_;
  RegionOptions options_;
  std::vector<Triangle>
      triangles_;  // their nodes are those of the network, edge >= 0 says it is a constraint
  std::array<Vec2d, 4> box_;
  std::vector<int> region_of_;
  std::vector<Flooded> regions_;
  mutable int last_ = 0;
};

void Extractor::triangulate() {
  const PlanarGraph& graph = network_.graph;
  std::vector<int> used;
  for (int n = 0; n < static_cast<int>(graph.n_nodes()); ++n)
    if (graph.degree(n) > 0) used.push_back(n);
  Vec2d low = graph.uv(used.front()), high = low;
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
  for (Triangle& t : triangles_)
    for (int& n : t.node) n = n < 0 ? n : used[at(n)];
  for (int i = 0; i < 4; ++i) box_[at(i)] = arrangement.box_corner(-1 - i);
}

// Outside is what is connected to the corners of the box.
void Extractor::flood_all() {
  region_of_.assign(triangles_.size(), unseen);
  for (size_t t = 0; t < triangles_.size(); ++t) {
    const auto& node = triangles_[t].node;
    if (region_of_[t] == unseen && *std::min_element(node.begin(), node.end()) < 0)
      flood(static_cast<int>(t), outside);
  }
  for (size_t t = 0; t < triangles_.size(); ++t) {
    if (region_of_[t] != unseen) continue;
    Flooded flooded;
    flooded.triangles = flood(static_cast<int>(t), static_cast<int>(regions_.size()));
    regions_.push_back(std::move(flooded));
  }
}

std::vector<int> Extractor::flood(int start, int region) {
  std::vector<int> found{start};
  region_of_[at(start)] = region;
  for (size_t i = 0; i < found.size(); ++i) {
    const Triangle& t = triangles_[at(found[i])];
    for (size_t k = 0; k < 3; ++k) {
      const int next = t.neighbor[k];
      if (next < 0 || t.edge[k] >= 0 || region_of_[at(next)] != unseen) continue;
      region_of_[at(next)] = region;
      found.push_back(next);
    }
  }
  return found;
}

// The triangle at a point, by walking from the last one found; -1 outside the box.
int Extractor::locate(const Vec2d& uv) const {
  int t = last_;
  for (size_t step = 0; step <= triangles_.size(); ++step) {
    const Triangle& triangle = triangles_[at(t)];
    int next = -2;
    for (size_t i = 0; i < 3 && next == -2; ++i) {
      const size_t k = (i + step) % 3;
      if (turn(uv_of(triangle.node[(k + 1) % 3]), uv_of(triangle.node[(k + 2) % 3]), uv) < 0)
        next = triangle.neighbor[k];
    }
    if (next == -2) break;
    if (next < 0) return -1;
    t = next;
  }
  last_ = t;
  return t;
}

void Extractor::gather_samples() {
  for (int n = 0; n < static_cast<int>(network_.graph.n_nodes()); ++n) {
    if (!is_free_sample(n)) continue;
    const int t = locate(network_.graph.uv(n));
    if (t >= 0 && region_of_[at(t)] >= 0) regions_[at(region_of_[at(t)])].samples.push_back(n);
  }
}

// The surface is linear between its vertices, so they are where it is farthest from a polygon.
void Extractor::gather_probes() {
  const auto& mesh = surface_.connectivity();
  for (const auto f : mesh.faces()) {  // by faces: neighbours are near each other, and vertices in no order
    const auto corners = surface_.corners(f);
    for (size_t k = 0; k < 3; ++k) {
      const auto v = corners.vertex[k];
      if (mesh.is_boundary(v) || mesh.face_handle(mesh.halfedge_handle(v)) != f) continue;
      const int t = locate(locator_.uv(v));
      if (t < 0 || region_of_[at(t)] < 0) continue;
      Probe probe{locator_.uv(v), surface_.point(v), {f, {0, 0, 0}}};
      probe.point.barycentric[k] = 1;
      regions_[at(region_of_[at(t)])].region.probes.push_back(probe);
    }
  }
}

// The nodes around a region, in order if they form one loop.
std::vector<int> Extractor::border_of(const Flooded& flooded, bool& simple) const {
  std::vector<std::array<int, 2>> sides;
  for (const int t : flooded.triangles)
    for (size_t k = 0; k < 3; ++k)
      if (triangles_[at(t)].edge[k] >= 0)
        sides.push_back({triangles_[at(t)].node[(k + 1) % 3], triangles_[at(t)].node[(k + 2) % 3]});
  std::sort(sides.begin(), sides.end());
  simple = std::adjacent_find(sides.begin(), sides.end(),
                              [](const auto& x, const auto& y) { return x[0] == y[0]; }) == sides.end();
  std::vector<int> loop{sides.front()[0]};
  if (simple)
    for (int node = sides.front()[1]; node != loop.front();) {
      loop.push_back(node);
      node = (*std::lower_bound(sides.begin(), sides.end(), std::array<int, 2>{node, -1}))[1];
    }
  if (simple && loop.size() == sides.size()) return loop;
  simple = false;  // a hole, or an edge that ends inside
  loop.clear();
  for (const int t : flooded.triangles)
    loop.insert(loop.end(), triangles_[at(t)].node.begin(), triangles_[at(t)].node.end());
  std::sort(loop.begin(), loop.end());
  loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
  return loop;
}

// One normal for the region: that of the surface in the middle of its triangles, by their size in space.
void Extractor::set_normal(Flooded& flooded) const {
  Vec3d& normal = flooded.region.corners.normal;
  for (const int t : flooded.triangles) {
    const auto& node = triangles_[at(t)].node;
    Vec2d middle(0, 0);
    for (const int n : node) middle += network_.graph.uv(n) / 3;
    const Vec3d &a = network_.positions[at(node[0])], &b = network_.positions[at(node[1])],
                &c = network_.positions[at(node[2])];
    normal += cross(b - a, c - a).norm() * judge_.surface_normal(middle, network_.points[at(node[0])].face);
  }
  const double length = normal.norm();
  if (length > 0) normal /= length;
}

void Extractor::outline(Flooded& flooded) const {
  Region& region = flooded.region;
  const std::vector<int> loop = border_of(flooded, region.simple);
  for (const int n : loop) region.corners.add(network_, n);
  region.corners.loop = region.simple ? loop.size() : 0;
  std::vector<std::array<int, 2>> index;  // node, corner
  for (size_t i = 0; i < loop.size(); ++i) index.push_back({loop[i], static_cast<int>(i)});
  std::sort(index.begin(), index.end());
  for (const int t : flooded.triangles) {
    std::array<int, 3> triangle;
    for (size_t k = 0; k < 3; ++k)
      triangle[k] = (*std::lower_bound(index.begin(), index.end(),
                                       std::array<int, 2>{triangles_[at(t)].node[k], -1}))[1];
    region.triangles.push_back(triangle);
  }
  for (const int n : flooded.samples) region.corners.add(network_, n);
  region.isotropic = flooded.samples.size();
  set_normal(flooded);
}

void Extractor::append(const Region& region, RegionPolygons& result, PolygonSet& set) {
  std::vector<int> nodes = region.corners.node;
  size_t added = 0;
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i] >= 0) continue;
    nodes[i] = network_.graph.add_node(region.corners.uv[i]);
    const SurfacePoint& point = result.added[added++];
    network_.points.push_back(point);
    network_.positions.push_back(position(surface_, point));
    network_.normals.push_back(normals_.at(point));
    network_.origins.push_back(Origin::isotropic);
    network_.fixed.push_back(1);
  }
  set.added_samples += added;
  std::vector<char> used(nodes.size(), 0);
  for (auto& polygon : result.polygons) {
    for (int& corner : polygon) {
      used[at(corner)] = 1;
      corner = nodes[at(corner)];
    }
    set.polygons.push_back(std::move(polygon));
  }
  set.dropped_samples += static_cast<size_t>(std::count(used.begin(), used.end(), 0));
  (result.convex ? set.conforming_edges : set.convexity_splits) += result.polygons.size() - 1;
}

}  // namespace

PolygonSet extract_polygons(NetworkGraph& network, const SurfaceRef& surface, const UvLocator& locator,
                            const SurfaceNormals& normals, const PolygonJudge& judge,
                            const RegionOptions& options) {
  return Extractor(network, surface, locator, normals, judge, options).run();
}

}  // namespace anisomesh::detail
