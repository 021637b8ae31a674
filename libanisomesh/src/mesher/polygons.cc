#include "mesher/polygons.hh"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "mesher/region_layout.hh"
#include "network/feature_sides.hh"

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

class Extractor {
 public:
  Extractor(NetworkGraph& network, const SurfaceRef& surface, const SurfaceNormals& normals,
            const PolygonJudge& judge, const RegionOptions& options)
      : network_(network), surface_(surface), normals_(normals), judge_(judge), options_(options) {}

  PolygonSet run(std::vector<Cell>&& cells) {
    std::vector<Region> regions(cells.size());
    std::vector<RegionPolygons> results(cells.size());
    tbb::parallel_for(size_t{0}, cells.size(), [&](size_t c) {
      regions[c] = region_of(cells[c]);
      results[c] = mesh_region(regions[c], judge_, options_);
    });
    if (!network_.planar) settle_chords(cells, regions, results);
    PolygonSet set;
    for (size_t c = 0; c < cells.size(); ++c) append(regions[c], results[c], set);
    return set;
  }

 private:
  Region region_of(const Cell& cell, const std::vector<std::array<int, 2>>& taken = {}) const;
  void settle_chords(const std::vector<Cell>& cells, std::vector<Region>& regions,
                     std::vector<RegionPolygons>& results) const;
  void find_faces(const Cell& cell, RegionCorners& corners) const;
  void set_normal(Region& region) const;
  void append(const Region& region, RegionPolygons& result, PolygonSet& set);

  NetworkGraph& network_;
  const SurfaceRef& surface_;
  const SurfaceNormals& normals_;
  const PolygonJudge& judge_;
  RegionOptions options_;
};

// The nodes around a cell, in order if they form one loop, and all of them otherwise.
std::vector<int> border_of(const Cell& cell, bool& simple) {
  std::vector<int> nodes = loop_around(cell);
  simple = !nodes.empty();
  if (simple) return nodes;
  // a hole, or an edge that ends inside
  for (const auto& t : cell.triangles) nodes.insert(nodes.end(), t.begin(), t.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

// At corners on features, where the surface goes on beyond the cell; none where the cell is twice at a node.
void Extractor::find_faces(const Cell& cell, RegionCorners& corners) const {
  std::map<int, std::vector<int>> before, after;
  for (const auto& [n, m] : cell.sides) {
    after[n].push_back(m);
    before[m].push_back(n);
  }
  for (size_t i = 0; i < corners.size(); ++i) {
    const auto in = before.find(corners.node[i]), out = after.find(corners.node[i]);
    if (in == before.end() || out == after.end() || in->second.size() != 1 || out->second.size() != 1)
      continue;
    corners.set_face(network_, in->second[0], static_cast<int>(i), out->second[0]);
  }
}

// That of the surface in the middle of the triangles, by their size in space.
void Extractor::set_normal(Region& region) const {
  RegionCorners& corners = region.corners;
  for (const auto& t : region.triangles) {
    Vec2d middle(0, 0);
    Vec3d place(0, 0, 0);
    for (const int i : t) {
      middle += corners.uv[at(i)] / 3;
      place += corners.position[at(i)] / 3;
    }
    const Vec3d &a = corners.position[at(t[0])], &b = corners.position[at(t[1])],
                &c = corners.position[at(t[2])];
    corners.normal +=
        cross(b - a, c - a).norm() * judge_.surface_normal(middle, place, corners.face[at(t[0])]);
  }
  const double length = corners.normal.norm();
  if (length > 0) corners.normal /= length;
}

// \param taken pairs of corners that another cell has joined
Region Extractor::region_of(const Cell& cell, const std::vector<std::array<int, 2>>& taken) const {
  Region region;
  const std::vector<int> loop = border_of(cell, region.simple);
  for (const int n : loop) region.corners.add(network_, n);
  region.corners.loop = region.simple ? loop.size() : 0;
  if (cell.holds_samples)
    for (const int n : cell.samples) region.corners.add(network_, n);
  std::vector<std::array<int, 2>> index;  // node, corner
  for (size_t i = 0; i < region.corners.size(); ++i)
    index.push_back({region.corners.node[i], static_cast<int>(i)});
  std::sort(index.begin(), index.end());
  const auto corner = [&](int n) {
    return (*std::lower_bound(index.begin(), index.end(), std::array<int, 2>{n, -1}))[1];
  };
  for (const auto& t : cell.triangles) region.triangles.push_back({corner(t[0]), corner(t[1]), corner(t[2])});
  if (!region.simple) {
    // An edge that ends inside, as a feature may, has the cell on both sides.
    auto sides = cell.sides;
    std::sort(sides.begin(), sides.end());
    for (const auto& [n, m] : sides)
      if (n < m && std::binary_search(sides.begin(), sides.end(), std::array<int, 2>{m, n}))
        region.walls.push_back({corner(n), corner(m)});
  }
  if (!cell.holds_samples)
    for (const int n : cell.samples) region.corners.add(network_, n);
  region.isotropic = cell.samples.size();
  region.holds_samples = cell.holds_samples;
  if (!network_.share.empty())
    for (const int n : region.corners.node) region.share = std::min(region.share, network_.share[at(n)]);
  region.probes = cell.probes;
  if (!network_.planar) find_faces(cell, region.corners);
  set_normal(region);
  if (!network_.planar) {
    for (const auto& pair : cell.forbidden) region.corners.forbid(corner(pair[0]), corner(pair[1]));
    for (const auto& pair : taken) region.corners.forbid(pair[0], pair[1]);
    region.corners.on_surface = true;
    region.at_feature = std::any_of(region.corners.corner_normal.begin(), region.corners.corner_normal.end(),
                                    [](const Vec3d& n) { return n.sqrnorm() == 0; });
    region.corners.take_normals_of(region.triangles);
    lay_out(region);
  }
  return region;
}

// On the surface two cells that share two corners may both join them by a chord, which would be one edge of
// four polygons: the later cell is cut up anew without it.
void Extractor::settle_chords(const std::vector<Cell>& cells, std::vector<Region>& regions,
                              std::vector<RegionPolygons>& results) const {
  constexpr int max_rounds = 8;
  using Chord = std::array<int, 2>;
  std::set<Chord> taken;
  for (size_t c = 0; c < cells.size(); ++c) {
    std::vector<Chord> chords, wrong;  // by node; by corner
    for (int round = 0; round < max_rounds; ++round) {
      const RegionCorners& corners = regions[c].corners;
      chords.clear();
      const size_t known = wrong.size();
      for (const auto& polygon : results[c].polygons)
        for (size_t i = 0; i < polygon.size(); ++i) {
          const int a = polygon[i], b = polygon[(i + 1) % polygon.size()];
          if (a > b || corners.is_side(a, b) || corners.is_side(b, a)) continue;
          const int n = corners.node[at(a)], m = corners.node[at(b)];
          if (n < 0 || m < 0) continue;
          chords.push_back({std::min(n, m), std::max(n, m)});
          if (taken.count(chords.back()) > 0) wrong.push_back({a, b});
        }
      if (wrong.size() == known) break;
      regions[c] = region_of(cells[c], wrong);
      results[c] = mesh_region(regions[c], judge_, options_);
    }
    taken.insert(chords.begin(), chords.end());
  }
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

PolygonSet extract_polygons(NetworkGraph& network, std::vector<Cell> cells, const SurfaceRef& surface,
                            const SurfaceNormals& normals, const PolygonJudge& judge,
                            const RegionOptions& options) {
  if (!network.planar) network.feature_sides = std::make_shared<const FeatureSides>(surface, network);
  return Extractor(network, surface, normals, judge, options).run(std::move(cells));
}

}  // namespace anisomesh::detail
