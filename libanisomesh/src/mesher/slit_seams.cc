#include "mesher/slit_seams.hh"

#include <algorithm>
#include <cmath>

#include "anisomesh/properties.hh"
#include "mesher/polygon_adjacency.hh"

namespace anisomesh::detail {

namespace {

using Polygon = std::vector<int>;
size_t at(int i) { return static_cast<size_t>(i); }

/// Of an edge of the surface: places nearer than this are one.
constexpr double same_place = 1e-6;

std::array<int, 2> side_of(const Polygon& polygon, size_t i) {
  return {polygon[i], polygon[(i + 1) % polygon.size()]};
}

}  // namespace

/// What the polygons have on seams, on any of their sides.
struct SlitSeams::Wanted {
  std::vector<std::map<double, Vec3d>> on_seam;  // place along it and position, but for the ends
  std::set<Key> ends;
};

SlitSeams::SlitSeams(const SurfaceRef& surface) : surface_(surface) {
  const auto& mesh = surface.connectivity();
  std::map<std::array<Key, 2>, std::vector<int>> in_place;
  for (const auto h : mesh.halfedges()) {
    if (mesh.is_boundary(h) || !mesh.is_boundary(mesh.opposite_halfedge_handle(h))) continue;
    const Key a = key_of(mesh.from_vertex_handle(h)), b = key_of(mesh.to_vertex_handle(h));
    if (a != b) in_place[{std::min(a, b), std::max(a, b)}].push_back(h.idx());
  }
  for (const auto& [ends, halfedges] : in_place) {
    if (halfedges.size() < 2) continue;
    if (seam_of_.empty()) seam_of_.assign(mesh.n_halfedges(), -1);
    for (const int h : halfedges) seam_of_[at(h)] = static_cast<int>(seams_);
    ends_.insert(ends.begin(), ends.end());
    ++seams_;
  }
}

SlitSeams::Key SlitSeams::key_of(OpenMesh::VertexHandle v) const {
  const Vec3d& p = surface_.point(v);
  return {p[0], p[1], p[2]};
}

/// The halfedge with a face that follows on the border.
int SlitSeams::next(int halfedge) const {
  const auto& mesh = surface_.connectivity();
  const auto outside = mesh.opposite_halfedge_handle(OpenMesh::HalfedgeHandle(halfedge));
  return mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(outside)).idx();
}

/// None if the point is not on the border. Vertices are at the beginning of their halfedge.
SlitSeams::Place SlitSeams::place_of(const SurfacePoint& point) const {
  const auto& mesh = surface_.connectivity();
  const auto corners = surface_.corners(point.face);
  const Vec3d& w = point.barycentric;
  for (int k = 0; k < 3; ++k) {
    if (w[k] < 1) continue;
    const auto outgoing = mesh.halfedge_handle(corners.vertex[k]);  // on the border if the vertex is
    if (!mesh.is_boundary(outgoing)) return {};
    return {mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(outgoing)).idx(), 0};
  }
  for (int k = 0; k < 3; ++k) {
    if (w[k] > 0) continue;
    const auto a = corners.vertex[(k + 1) % 3], b = corners.vertex[(k + 2) % 3];
    const auto h = mesh.find_halfedge(a, b);
    if (h.is_valid() && mesh.is_boundary(mesh.opposite_halfedge_handle(h))) return {h.idx(), w[(k + 2) % 3]};
  }
  return {};
}

/// Counted the same way on all sides of the seam.
double SlitSeams::along_seam(const Place& place) const {
  const auto& mesh = surface_.connectivity();
  const OpenMesh::HalfedgeHandle h(place.halfedge);
  return key_of(mesh.from_vertex_handle(h)) < key_of(mesh.to_vertex_handle(h)) ? place.along
                                                                               : 1 - place.along;
}

SurfacePoint SlitSeams::point_at(int halfedge, double along) const {
  const auto& mesh = surface_.connectivity();
  const OpenMesh::HalfedgeHandle h(halfedge);
  SurfacePoint point{mesh.face_handle(h), {0, 0, 0}};
  const auto corners = surface_.corners(point.face);
  for (int k = 0; k < 3; ++k) {
    if (corners.vertex[k] == mesh.from_vertex_handle(h)) point.barycentric[k] = 1 - along;
    if (corners.vertex[k] == mesh.to_vertex_handle(h)) point.barycentric[k] = along;
  }
  return point;
}

SlitSeams::Wanted SlitSeams::wanted(const std::vector<Polygon>& polygons, NetworkGraph& network) const {
  Wanted wanted;
  wanted.on_seam.resize(seams_);
  std::set<int> nodes;
  for (const Polygon& polygon : polygons) nodes.insert(polygon.begin(), polygon.end());
  for (const int n : nodes) {
    const Place place = place_of(network.points[at(n)]);
    if (place.halfedge < 0) continue;
    const auto& mesh = surface_.connectivity();
    if (place.along == 0) {
      const Key key = key_of(mesh.from_vertex_handle(OpenMesh::HalfedgeHandle(place.halfedge)));
      if (ends_.count(key) == 0) continue;
      wanted.ends.insert(key);
      continue;
    }
    const int seam = seam_of_[at(place.halfedge)];
    if (seam < 0) continue;
    auto& known = wanted.on_seam[at(seam)];
    const double along = along_seam(place);
    const auto near = known.lower_bound(along - same_place);
    if (near != known.end() && near->first < along + same_place)
      network.positions[at(n)] = near->second;
    else
      known.emplace(along, network.positions[at(n)]);
  }
  return wanted;
}

int SlitSeams::add_node(const SurfacePoint& point, const Vec3d& position, NetworkGraph& network,
                        const SurfaceNormals& normals) const {
  Vec2d uv(0, 0);
  if (network.planar) {
    const auto parameters = require_property(surface_.connectivity(), property::uv);
    const auto corners = surface_.corners(point.face);
    for (int k = 0; k < 3; ++k)
      uv += point.barycentric[k] * surface_.connectivity().property(parameters, corners.vertex[k]);
  }
  const int node = network.graph.add_node(uv);
  network.points.push_back(point);
  network.positions.push_back(position);
  network.normals.push_back(normals.at(point));
  network.origins.push_back(Origin::border);
  network.fixed.push_back(1);
  if (!network.share.empty()) network.share.push_back(1);
  return node;
}

/// Nodes for all that is wanted on the border between two places.
std::vector<int> SlitSeams::between(const Place& from, const Place& to, const Wanted& wanted,
                                    NetworkGraph& network, const SurfaceNormals& normals) const {
  const auto& mesh = surface_.connectivity();
  std::vector<int> nodes;
  size_t steps = 0;
  for (Place here = from; steps <= mesh.n_edges(); here = {next(here.halfedge), 0}, ++steps) {
    const OpenMesh::HalfedgeHandle h(here.halfedge);
    if (steps > 0 && here.halfedge == to.halfedge && to.along == 0) return nodes;
    if (const auto v = mesh.from_vertex_handle(h); steps > 0 && wanted.ends.count(key_of(v)) > 0)
      nodes.push_back(add_node(point_at(here.halfedge, 0), surface_.point(v), network, normals));
    const bool last = here.halfedge == to.halfedge && here.along < to.along;
    const double end = last ? to.along : 1;
    if (const int seam = seam_of_[at(here.halfedge)]; seam >= 0) {
      std::map<double, Vec3d> missing;
      for (const auto& [along, position] : wanted.on_seam[at(seam)]) {
        const double t = along_seam({here.halfedge, along});  // its own inverse
        if (t > here.along + same_place && t < end - same_place) missing.emplace(t, position);
      }
      for (const auto& [t, position] : missing)
        nodes.push_back(add_node(point_at(here.halfedge, t), position, network, normals));
    }
    if (last) return nodes;
  }
  return {};  // the side does not run along the border
}

void SlitSeams::zip(std::vector<Polygon>& polygons, NetworkGraph& network, const SurfaceNormals& normals,
                    const PolygonJudge& judge, const PartitionOptions& options) const {
  if (seams_ == 0) return;
  const Wanted all = wanted(polygons, network);
  std::set<std::array<int, 2>> sides;
  for (const Polygon& polygon : polygons)
    for (size_t i = 0; i < polygon.size(); ++i) sides.insert(side_of(polygon, i));
  std::vector<char> larger(polygons.size(), 0);
  for (size_t p = 0; p < polygons.size(); ++p) {
    Polygon corners;
    for (size_t i = 0; i < polygons[p].size(); ++i) {
      const auto [a, b] = side_of(polygons[p], i);
      corners.push_back(a);
      if (sides.count({b, a}) > 0) continue;
      const Place from = place_of(network.points[at(a)]), to = place_of(network.points[at(b)]);
      if (from.halfedge < 0 || to.halfedge < 0) continue;
      int last = a;
      for (const int n : between(from, to, all, network, normals)) {
        if (const int edge = network.graph.find_edge(last, b); edge >= 0) network.graph.split_edge(edge, n);
        corners.push_back(last = n);
      }
    }
    larger[p] = corners.size() > polygons[p].size();
    polygons[p] = std::move(corners);
  }
  if (options.max_degree == 0) return;
  const PolygonAdjacency adjacency(polygons, network.graph.n_nodes(), [](int, int) { return true; });
  std::vector<Polygon> result;
  for (size_t p = 0; p < polygons.size(); ++p) {
    if (!larger[p] || polygons[p].size() <= at(options.max_degree)) {
      result.push_back(polygons[p]);
      continue;
    }
    const RegionCorners corners = adjacency.around(polygons, {static_cast<int>(p)}, network);
    for (Polygon& piece : partition_region(corners, judge, options)) {
      for (int& i : piece) i = corners.node[at(i)];
      result.push_back(std::move(piece));
    }
  }
  polygons = std::move(result);
}

}  // namespace anisomesh::detail
