#include "network/network_graph.hh"

#include <algorithm>
#include <string>

#include "anisomesh/features.hh"
#include "numerics/arrangement.hh"
#include "surface/canonical_copy.hh"

namespace anisomesh::detail {

namespace {

using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

size_t at(int i) { return static_cast<size_t>(i); }

// Barycentric coordinates below this are taken for zero at the end of a line that says it stopped on an edge.
constexpr double on_edge = 1e-6;

class Builder {
 public:
  Builder(const SurfaceRef& surface, const UvLocator& locator, const LineNetwork& lines, double corner_angle)
      : surface_(surface),
        mesh_(surface.connectivity()),
        locator_(locator),
        lines_(lines),
        skeleton_(feature_skeleton(surface, corner_angle)),
        arrangement_(low_corner(), high_corner()),
        node_of_vertex_(mesh_.n_vertices(), -1) {}

  NetworkGraph build() {
    snap_line_ends();
    insert_curves();
    insert_lines();
    insert_isotropic_samples();
    NetworkGraph result;
    result.graph = arrangement_.graph();
    settle_crossings();
    result.points = std::move(points_);
    result.origins = std::move(origins_);
    result.fixed = std::move(fixed_);
    result.crossings = arrangement_.crossings().size();
    result.positions.reserve(result.points.size());
    for (const SurfacePoint& p : result.points) result.positions.push_back(position(surface_, p));
    return result;
  }

 private:
  Vec2d low_corner() const {
    Vec2d low = locator_.uv(VertexHandle(0));
    for (const auto v : mesh_.vertices()) low.minimize(locator_.uv(v));
    return low;
  }
  Vec2d high_corner() const {
    Vec2d high = locator_.uv(VertexHandle(0));
    for (const auto v : mesh_.vertices()) high.maximize(locator_.uv(v));
    return high;
  }

  // The end of a line on the border or a feature, as a place on that edge of the mesh.
  struct EdgePoint {
    int edge;
    double t;  // from the from-vertex of the edge's first halfedge
    int sample;
  };

  void snap_line_ends();
  void snap_line_end(const SurfacePoint& point, int sample);
  void insert_curves();
  void insert_curve_edge(HalfedgeHandle h, EdgeKind kind);
  void insert_lines();
  void insert_isotropic_samples();
  void settle_crossings();

  int insert(const SurfacePoint& point, const Vec2d& uv, Origin origin, bool fixed);
  int insert_vertex(VertexHandle v, Origin origin);
  void connect(int a, int b, EdgeKind kind, int tag);
  SurfacePoint on_mesh_edge(EdgeHandle e, double t) const;
  SurfacePoint at_vertex(VertexHandle v) const;

  const SurfaceRef& surface_;
  const OpenMesh::TriConnectivity& mesh_;
  const UvLocator& locator_;
  const LineNetwork& lines_;
  FeatureSkeleton skeleton_;
  Arrangement arrangement_;

  std::vector<int> node_of_vertex_, node_of_sample_;
  std::vector<EdgePoint> edge_points_;
  std::vector<FaceHandle> face_of_sample_;
  std::vector<SurfacePoint> points_;
  std::vector<Origin> origins_;
  std::vector<char> fixed_;
};

SurfacePoint Builder::on_mesh_edge(EdgeHandle e, double t) const {
  auto h = mesh_.halfedge_handle(e, 0);
  if (mesh_.is_boundary(h)) {
    h = mesh_.halfedge_handle(e, 1);
    t = 1 - t;
  }
  SurfacePoint point{mesh_.face_handle(h), {0, 0, 0}};
  const auto corners = surface_.corners(point.face);
  for (size_t k = 0; k < 3; ++k) {
    if (corners.vertex[k] == mesh_.from_vertex_handle(h)) point.barycentric[k] = 1 - t;
    if (corners.vertex[k] == mesh_.to_vertex_handle(h)) point.barycentric[k] = t;
  }
  return point;
}

SurfacePoint Builder::at_vertex(VertexHandle v) const {
  auto h = mesh_.halfedge_handle(v);
  if (mesh_.is_boundary(h)) h = mesh_.opposite_halfedge_handle(h);
  SurfacePoint point{mesh_.face_handle(h), {0, 0, 0}};
  const auto corners = surface_.corners(point.face);
  for (size_t k = 0; k < 3; ++k)
    if (corners.vertex[k] == v) point.barycentric[k] = 1;
  return point;
}

int Builder::insert(const SurfacePoint& point, const Vec2d& uv, Origin origin, bool fixed) {
  const int node = arrangement_.insert_point(uv);
  if (at(node) >= points_.size()) {  // crossings before it are settled at the end
    points_.resize(at(node));
    origins_.resize(at(node), Origin::crossing);
    fixed_.resize(at(node), 0);
    points_.push_back(point);
    origins_.push_back(origin);
    fixed_.push_back(fixed);
  } else if (fixed) {
    fixed_[at(node)] = 1;
    if (origins_[at(node)] == Origin::line || origins_[at(node)] == Origin::crossing)
      origins_[at(node)] = origin;
  }
  return node;
}

int Builder::insert_vertex(VertexHandle v, Origin origin) {
  int& node = node_of_vertex_[at(v.idx())];
  if (node < 0) node = insert(at_vertex(v), locator_.uv(v), origin, origin == Origin::corner);
  return node;
}

void Builder::connect(int a, int b, EdgeKind kind, int tag) {
  if (a == b) return;
  const bool followed = arrangement_.insert_segment(a, b, static_cast<int>(kind), tag);
  // A line cut short there is trimmed like any other that ends in the middle of nowhere.
  if (!followed && (kind == EdgeKind::border || kind == EdgeKind::feature))
    throw CannotProcess("edge " + std::to_string(given_number(surface_, EdgeHandle(-1 - tag))) +
                        " of the border or a feature cannot be followed in the parameter plane; the "
                        "parameterization overlaps or is degenerate there");
}

void Builder::snap_line_end(const SurfacePoint& point, int sample) {
  if (node_of_sample_[at(sample)] >= 0) return;
  const auto corners = surface_.corners(point.face);
  for (size_t k = 0; k < 3; ++k)
    if (point.barycentric[k] > 1 - on_edge) {
      node_of_sample_[at(sample)] = -2 - corners.vertex[k].idx();
      return;
    }
  auto h = mesh_.halfedge_handle(point.face);  // ends in corner 0, so the edge before it is opposite corner 0
  h = mesh_.prev_halfedge_handle(h);
  for (size_t k = 0; k < 3; ++k, h = mesh_.next_halfedge_handle(h)) {
    const auto e = mesh_.edge_handle(h);
    if (point.barycentric[k] > on_edge || !is_feature_or_border(mesh_, e)) continue;
    const double to = point.barycentric[(k + 2) % 3], from = point.barycentric[(k + 1) % 3];
    const double t = to / (to + from);
    edge_points_.push_back({e.idx(), mesh_.halfedge_handle(e, 0) == h ? t : 1 - t, sample});
    return;
  }
}

void Builder::snap_line_ends() {
  size_t samples = 0;
  for (const Line& line : lines_.lines) samples += line.points.size();
  node_of_sample_.assign(samples, -1);
  face_of_sample_.reserve(samples);
  for (const Line& line : lines_.lines) {
    const int first = static_cast<int>(face_of_sample_.size());
    for (const SurfacePoint& p : line.points) face_of_sample_.push_back(p.face);
    if (line.closed || line.points.empty()) continue;
    const auto stopped = [](LineEnd reason) {
      return reason == LineEnd::feature || reason == LineEnd::border;
    };
    if (stopped(line.begin_reason)) snap_line_end(line.points.front(), first);
    if (stopped(line.end_reason))
      snap_line_end(line.points.back(), first + static_cast<int>(line.points.size()) - 1);
  }
  std::sort(edge_points_.begin(), edge_points_.end(), [](const EdgePoint& a, const EdgePoint& b) {
    if (a.edge != b.edge) return a.edge < b.edge;
    return a.t != b.t ? a.t < b.t : a.sample < b.sample;
  });
}

void Builder::insert_curve_edge(HalfedgeHandle h, EdgeKind kind) {
  const auto e = mesh_.edge_handle(h);
  const bool forward = mesh_.halfedge_handle(e, 0) == h;
  const Origin origin = kind == EdgeKind::border ? Origin::border : Origin::feature;
  const auto range = std::equal_range(edge_points_.begin(), edge_points_.end(), EdgePoint{e.idx(), 0, 0},
                                      [](const EdgePoint& a, const EdgePoint& b) { return a.edge < b.edge; });
  int node = insert_vertex(mesh_.from_vertex_handle(h), origin);
  const auto count = range.second - range.first;
  double before = 0;
  for (auto i = decltype(count){0}; i < count; ++i) {
    const EdgePoint& p = forward ? range.first[i] : range.first[count - 1 - i];
    // Two lines that end in the same place, one on each side, differ by rounding.
    if (i > 0 && std::abs(p.t - before) < on_edge) {
      node_of_sample_[at(p.sample)] = node;
      continue;
    }
    before = p.t;
    const SurfacePoint point = on_mesh_edge(e, p.t);
    const int next = insert(point, locator_.uv(point), origin, false);
    node_of_sample_[at(p.sample)] = next;
    connect(node, next, kind, -1 - e.idx());
    node = next;
  }
  connect(node, insert_vertex(mesh_.to_vertex_handle(h), origin), kind, -1 - e.idx());
}

void Builder::insert_curves() {
  for (const VertexHandle corner : skeleton_.corners) insert_vertex(corner, Origin::corner);
  for (const FeatureCurve& curve : skeleton_.curves)
    for (const HalfedgeHandle h : curve.halfedges)
      insert_curve_edge(h, curve.border ? EdgeKind::border : EdgeKind::feature);
}

void Builder::insert_lines() {
  int sample = 0;
  for (const Line& line : lines_.lines) {
    const EdgeKind kind = line.kind == LineKind::min ? EdgeKind::min : EdgeKind::max;
    int first = -1, before = -1;
    for (const SurfacePoint& point : line.points) {
      int node = node_of_sample_[at(sample)];
      if (node <= -2) {  // it ends in a vertex of the mesh
        const VertexHandle v(-2 - node);
        node = node_of_vertex_[at(v.idx())];
        if (node < 0) node = insert(at_vertex(v), locator_.uv(v), Origin::line, false);
      } else if (node == -1) {
        node = insert(point, locator_.uv(point), Origin::line, false);
      }
      if (before >= 0) connect(before, node, kind, sample - 1);
      if (first < 0) first = node;
      before = node;
      ++sample;
    }
    if (line.closed && line.points.size() > 2) connect(before, first, kind, sample - 1);
  }
}

void Builder::insert_isotropic_samples() {
  for (const SurfacePoint& point : lines_.isotropic_samples)
    insert(point, locator_.uv(point), Origin::isotropic, true);
}

void Builder::settle_crossings() {
  points_.resize(arrangement_.graph().n_nodes());
  origins_.resize(points_.size(), Origin::crossing);
  fixed_.resize(points_.size(), 0);
  for (const auto& crossing : arrangement_.crossings()) {
    const Vec2d uv = arrangement_.graph().uv(crossing.node);
    SurfacePoint& point = points_[at(crossing.node)];
    const int tag = std::min(crossing.tag[0], crossing.tag[1]);
    if (tag >= 0) {
      point = locator_.locate_surely(uv, face_of_sample_[at(tag)]);
      continue;
    }
    // On the border or a feature: the nearest place on that edge of the mesh.
    const EdgeHandle e(-1 - tag);
    const auto h = mesh_.halfedge_handle(e, 0);
    const Vec2d from = locator_.uv(mesh_.from_vertex_handle(h));
    const Vec2d along = locator_.uv(mesh_.to_vertex_handle(h)) - from;
    const double t = std::clamp(((uv - from) | along) / (along | along), 0.0, 1.0);
    point = on_mesh_edge(e, t);
    origins_[at(crossing.node)] = mesh_.is_boundary(e) ? Origin::border : Origin::feature;
  }
}

}  // namespace

NetworkGraph arrange_network(const SurfaceRef& surface, const UvLocator& locator,
                             const SurfaceNormals& normals, const LineNetwork& lines,
                             double corner_angle_degrees) {
  NetworkGraph network = Builder(surface, locator, lines, corner_angle_degrees).build();
  network.normals.reserve(network.points.size());
  for (const SurfacePoint& p : network.points) network.normals.push_back(normals.at(p));
  return network;
}

}  // namespace anisomesh::detail
