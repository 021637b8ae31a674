#include "plane_domain.hh"

#include <algorithm>
#include <cmath>
#include <queue>
#include <set>

#include "anisomesh/properties.hh"
#include "anisomesh/smoothing.hh"
#include "numerics/disjoint_sets.hh"
#include "numerics/proximity.hh"

namespace anisomesh::detail {

namespace {

constexpr int kFeature = -1, kBorder = -2;  // what lies across an edge, where it is no face

bool is_fence(const OpenMesh::TriConnectivity& mesh, OpenMesh::EdgeHandle edge) {
  return mesh.is_boundary(edge) || (mesh.has_edge_status() && mesh.status(edge).feature());
}

double larger_curvature(const Vec3d& tensor) {
  double k_min = 0, k_max = 0;
  eigenvalues(tensor, k_min, k_max);
  return std::max(std::abs(k_min), std::abs(k_max));
}

// Area-weighted mean of the larger |principal curvature|.
double mean_curvature(const SurfaceRef& surface, const PlaneInput& input) {
  double sum = 0, total = 0;
  for (const auto face : surface.connectivity().all_faces()) {
    const auto c = surface.corners(face);
    const Vec3d a = surface.point(c.vertex[0]);
    const double area = 0.5 * ((surface.point(c.vertex[1]) - a) % (surface.point(c.vertex[2]) - a)).norm();
    double k = 0;
    for (const Vec3d& tensor : input.corner_tensors[static_cast<size_t>(face.idx())])
      k += larger_curvature(tensor) / 3;
    sum += area * k;
    total += area;
  }
  return total > 0 ? sum / total : 0;
}

// The halfedge opposite corner i, in the order of SurfaceRef::corners().
OpenMesh::HalfedgeHandle opposite_halfedge(const OpenMesh::TriConnectivity& mesh, OpenMesh::FaceHandle face,
                                           int corner) {
  const auto first = mesh.halfedge_handle(face);  // from corner 2 to corner 0
  if (corner == 1) return first;
  return corner == 2 ? mesh.next_halfedge_handle(first) : mesh.prev_halfedge_handle(first);
}

int corner_of(const SurfaceRef& surface, OpenMesh::FaceHandle face, OpenMesh::VertexHandle vertex) {
  const auto c = surface.corners(face);
  return c.vertex[0] == vertex ? 0 : c.vertex[1] == vertex ? 1 : 2;
}

}  // namespace

PlaneInput read_plane_input(const SurfaceRef& surface) {
  auto& mesh = surface.connectivity();
  const auto uv = require_property(mesh, property::uv);
  const auto stretch = require_property(mesh, property::area_stretch);
  require_property(mesh, property::tensor2d);
  const auto umbilic = require_property(mesh, property::umbilic);
  const auto where = require_property(mesh, property::umbilic_position);
  PlaneInput input;
  for (const auto v : mesh.all_vertices()) {
    input.uv.push_back(mesh.property(uv, v));
    input.area_stretch.push_back(mesh.property(stretch, v));
  }
  input.corner_tensors = corner_tensors(surface);
  for (const auto f : mesh.all_faces()) {
    if (mesh.property(umbilic, f) == 0) continue;
    const Vec3d b = mesh.property(where, f);
    const auto& t = input.corner_tensors[static_cast<size_t>(f.idx())];
    input.umbilics.push_back(
        {{f, b}, mesh.property(umbilic, f), larger_curvature(b[0] * t[0] + b[1] * t[1] + b[2] * t[2])});
  }
  return input;
}

PlaneDomain::PlaneDomain(const SurfaceRef& surface, const PlaneInput& input, const DensityOptions& density)
    : umbilics_(input.umbilics),
      max_slope_(density.max_slope),
      density_(density, surface.diagonal(), mean_curvature(surface, input)) {
  faces_.resize(surface.connectivity().n_faces());
  make_nodes(surface, input);
  make_neighbours(surface);
  make_spacing();
  register_umbilics();
}

void PlaneDomain::make_nodes(const SurfaceRef& surface, const PlaneInput& input) {
  auto& mesh = surface.connectivity();
  DisjointSets sides(3 * faces_.size());
  for (const auto edge : mesh.all_edges()) {
    if (is_fence(mesh, edge)) continue;
    const auto h = mesh.halfedge_handle(edge, 0);
    const auto left = mesh.face_handle(h), right = mesh.opposite_face_handle(h);
    for (const auto v : {mesh.from_vertex_handle(h), mesh.to_vertex_handle(h)})
      sides.join(static_cast<size_t>(3 * left.idx() + corner_of(surface, left, v)),
                 static_cast<size_t>(3 * right.idx() + corner_of(surface, right, v)));
  }
  std::vector<int> number(3 * faces_.size(), -1), count;
  for (const auto f : mesh.all_faces()) {
    const auto corners = surface.corners(f);
    for (int i = 0; i < 3; ++i) {
      int& id = number[sides.root(static_cast<size_t>(3 * f.idx() + i))];
      const size_t vertex = static_cast<size_t>(corners.vertex[i].idx());
      if (id < 0) {
        id = static_cast<int>(nodes_.size());
        nodes_.push_back({input.uv[vertex], std::sqrt(input.area_stretch[vertex]), {0, 0, 0}, {0, 0}});
        count.push_back(0);
      }
      faces_[static_cast<size_t>(f.idx())].node[i] = id;
      nodes_[static_cast<size_t>(id)].tensor +=
          input.corner_tensors[static_cast<size_t>(f.idx())][static_cast<size_t>(i)];
      ++count[static_cast<size_t>(id)];
    }
  }
  for (size_t i = 0; i < nodes_.size(); ++i) nodes_[i].tensor /= count[i];
}

void PlaneDomain::make_neighbours(const SurfaceRef& surface) {
  auto& mesh = surface.connectivity();
  for (const auto f : mesh.all_faces())
    for (int i = 0; i < 3; ++i) {
      const auto h = opposite_halfedge(mesh, f, i);
      int& across = faces_[static_cast<size_t>(f.idx())].across[i];
      if (mesh.is_boundary(mesh.edge_handle(h)))
        across = kBorder;
      else if (is_fence(mesh, mesh.edge_handle(h)))
        across = kFeature;
      else
        across = mesh.opposite_face_handle(h).idx();
    }
}

void PlaneDomain::make_spacing() {
  constexpr double kRelativeNoise = 0.01;
  for (Node& node : nodes_) {
    double k_min = 0, k_max = 0;
    eigenvalues(node.tensor, k_min, k_max);
    // Beside a large curvature a small one is not known better than this: without the threshold the noise of
    // the estimate would space the lines along a cylinder.
    const double noise = kRelativeNoise * std::max(std::abs(k_min), std::abs(k_max));
    for (double* k : {&k_min, &k_max}) *k = std::copysign(std::max(std::abs(*k) - noise, 0.0), *k);
    node.spacing[static_cast<int>(LineKind::min)] = density_.min_line_spacing(k_min, k_max);
    node.spacing[static_cast<int>(LineKind::max)] = density_.max_line_spacing(k_min, k_max);
  }
  make_links();
  grade_spacing(static_cast<int>(LineKind::min));
  grade_spacing(static_cast<int>(LineKind::max));
  links_ = {};
  links_begin_ = {};
}

// The largest spacing below the wanted one that changes by at most max_slope of a unit over a unit: lines at
// the wanted distance on one side of a gap can then also be at the wanted distance on the other.
void PlaneDomain::grade_spacing(int kind) {
  using Entry = std::pair<double, int>;
  std::vector<Entry> entries;
  entries.reserve(nodes_.size());
  for (size_t i = 0; i < nodes_.size(); ++i)
    entries.emplace_back(nodes_[i].spacing[kind], static_cast<int>(i));
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue(std::greater<>(), std::move(entries));
  while (!queue.empty()) {
    const auto [spacing, i] = queue.top();
    queue.pop();
    if (spacing > nodes_[static_cast<size_t>(i)].spacing[kind]) continue;
    for (int e = links_begin_[static_cast<size_t>(i)]; e < links_begin_[static_cast<size_t>(i) + 1]; ++e) {
      const Link& link = links_[static_cast<size_t>(e)];
      double& other = nodes_[static_cast<size_t>(link.node)].spacing[kind];
      if (other <= spacing + max_slope_ * link.length) continue;
      other = spacing + max_slope_ * link.length;
      queue.emplace(other, link.node);
    }
  }
}

// Edges of the triangulation, both ways, by the node they start from.
void PlaneDomain::make_links() {
  links_begin_.assign(nodes_.size() + 1, 0);
  for (const Face& face : faces_)
    for (const int n : face.node) links_begin_[static_cast<size_t>(n) + 1] += 2;
  std::partial_sum(links_begin_.begin(), links_begin_.end(), links_begin_.begin());
  links_.resize(6 * faces_.size());
  std::vector<int> next(links_begin_.begin(), links_begin_.end() - 1);
  for (const Face& face : faces_)
    for (int i = 0; i < 3; ++i) {
      const int a = face.node[i], b = face.node[(i + 1) % 3];
      const Node &from = nodes_[static_cast<size_t>(a)], &to = nodes_[static_cast<size_t>(b)];
      const double length = (to.uv - from.uv).norm() / (0.5 * (from.scale + to.scale));
      links_[static_cast<size_t>(next[static_cast<size_t>(a)]++)] = {b, length};
      links_[static_cast<size_t>(next[static_cast<size_t>(b)]++)] = {a, length};
    }
}

std::vector<int> PlaneDomain::faces_within(const SurfacePoint& at, double radius) const {
  const Vec2d centre = plane_position(at);
  const double plane_radius = radius * scale(at);
  std::vector<int> found{at.face.idx()};
  // The faces of a disc are few beside those of the mesh: a sorted list of the seen beats a flag for each.
  std::set<int> seen{at.face.idx()};
  for (size_t next_visited = 0; next_visited < found.size(); ++next_visited) {
    const Face& current = faces_[static_cast<size_t>(found[next_visited])];
    for (int i = 0; i < 3; ++i) {
      const int next = current.across[i];
      if (next < 0) continue;
      const Vec2d a = node(current, (i + 1) % 3).uv, ab = node(current, (i + 2) % 3).uv - a;
      const double t = std::clamp(((centre - a) | ab) / ab.sqrnorm(), 0.0, 1.0);
      if ((a + t * ab - centre).norm() <= plane_radius && seen.insert(next).second) found.push_back(next);
    }
  }
  return found;
}

void PlaneDomain::register_umbilics() {
  for (size_t u = 0; u < umbilics_.size(); ++u) {
    const SurfacePoint& at = umbilics_[u].point;
    const double reach = std::max(spacing(LineKind::min, at), spacing(LineKind::max, at)) / 3;
    for (const int f : faces_within(at, reach)) near_umbilics_.emplace_back(f, static_cast<int>(u));
  }
  std::sort(near_umbilics_.begin(), near_umbilics_.end());
}

NearUmbilic PlaneDomain::umbilic_near(LineKind kind, const SurfacePoint& at) const {
  NearUmbilic best;
  const auto first =
      std::lower_bound(near_umbilics_.begin(), near_umbilics_.end(), std::pair(at.face.idx(), -1));
  for (auto it = first; it != near_umbilics_.end() && it->first == at.face.idx(); ++it) {
    const SurfacePoint& umbilic = umbilics_[static_cast<size_t>(it->second)].point;
    const double distance = (plane_position(umbilic) - plane_position(at)).norm() / scale(at);
    if (distance < best.distance && distance < spacing(kind, at) / 3) best = {it->second, distance};
  }
  return best;
}

Vec2d PlaneDomain::plane_position(const SurfacePoint& at) const {
  const Face& f = face(at.face);
  return at.barycentric[0] * node(f, 0).uv + at.barycentric[1] * node(f, 1).uv +
         at.barycentric[2] * node(f, 2).uv;
}

double PlaneDomain::scale(const SurfacePoint& at) const {
  const Face& f = face(at.face);
  return at.barycentric[0] * node(f, 0).scale + at.barycentric[1] * node(f, 1).scale +
         at.barycentric[2] * node(f, 2).scale;
}

Vec3d PlaneDomain::tensor(const SurfacePoint& at) const {
  const Face& f = face(at.face);
  return at.barycentric[0] * node(f, 0).tensor + at.barycentric[1] * node(f, 1).tensor +
         at.barycentric[2] * node(f, 2).tensor;
}

Vec3d PlaneDomain::tensor_ahead(const SurfacePoint& from, const Vec2d& vector) const {
  return tensor(walk(from, vector).point);
}

double PlaneDomain::spacing(LineKind kind, const SurfacePoint& at) const {
  const Face& f = face(at.face);
  const int k = static_cast<int>(kind);
  return at.barycentric[0] * node(f, 0).spacing[k] + at.barycentric[1] * node(f, 1).spacing[k] +
         at.barycentric[2] * node(f, 2).spacing[k];
}

double PlaneDomain::isotropic_spacing(const SurfacePoint& at) const {
  return std::min(spacing(LineKind::min, at), spacing(LineKind::max, at));
}

bool PlaneDomain::isotropic(const SurfacePoint& at) const {
  constexpr double kFlat = 0.1;        // of the curvature at which the spacing reaches its upper bound
  constexpr double kSpherical = 0.05;  // (k_max - k_min) / 2 over the larger of |k_min|, |k_max|
  const Vec3d t = tensor(at);
  const double larger = larger_curvature(t);
  return larger < kFlat * density_.flat_curvature() || deviator_norm(t) < kSpherical * larger;
}

double PlaneDomain::turning_length(const SurfacePoint& at) const {
  const Face& f = face(at.face);
  const Vec2d u = node(f, 1).uv - node(f, 0).uv, v = node(f, 2).uv - node(f, 0).uv;
  const Vec2d du = deviator(node(f, 1).tensor - node(f, 0).tensor);
  const Vec2d dv = deviator(node(f, 2).tensor - node(f, 0).tensor);
  const double area = cross2(u, v);
  const Vec2d gradient_x = (v[1] * du - u[1] * dv) / area, gradient_y = (u[0] * dv - v[0] * du) / area;
  const double gradient = std::sqrt(gradient_x.sqrnorm() + gradient_y.sqrnorm());
  const double norm = deviator_norm(tensor(at));
  return norm / gradient / scale(at);  // infinite where the field is constant
}

double PlaneDomain::area(OpenMesh::FaceHandle handle) const {
  const Face& f = face(handle);
  const double mean_scale = (node(f, 0).scale + node(f, 1).scale + node(f, 2).scale) / 3;
  return 0.5 * cross2(node(f, 1).uv - node(f, 0).uv, node(f, 2).uv - node(f, 0).uv) /
         (mean_scale * mean_scale);
}

Vec3d PlaneDomain::barycentric(const Face& f, const Vec2d& point) const {
  const Vec2d a = node(f, 0).uv - point, b = node(f, 1).uv - point, c = node(f, 2).uv - point;
  const Vec3d areas(cross2(b, c), cross2(c, a), cross2(a, b));
  const double total = cross2(node(f, 1).uv - node(f, 0).uv, node(f, 2).uv - node(f, 0).uv);
  return areas / total;
}

Reach PlaneDomain::walk(const SurfacePoint& from, const Vec2d& vector) const {
  const auto clean = [](Vec3d b) {
    b.maximize(Vec3d(0, 0, 0));
    return b / (b[0] + b[1] + b[2]);
  };
  const Vec2d target = plane_position(from) + scale(from) * vector;
  Reach reach;
  int current = from.face.idx(), entered = -1;
  Vec3d at = from.barycentric;
  double left = 1;  // of the vector
  // A straight line visits a triangle once; the bound only matters where rounding lets it circle a vertex.
  for (size_t crossings = 0; crossings <= faces_.size(); ++crossings) {
    const Face& f = faces_[static_cast<size_t>(current)];
    const Vec3d end = barycentric(f, target);
    int exit = -1;
    double t = 1;
    for (int i = 0; i < 3; ++i) {
      if (i == entered || end[i] >= 0 || end[i] >= at[i]) continue;
      const double t_i = at[i] / (at[i] - end[i]);
      if (t_i <= t) exit = i, t = t_i;
    }
    if (exit < 0) {
      at = clean(end);
      left = 0;
      break;
    }
    at = clean(at + t * (end - at));
    at[exit] = 0;
    left *= 1 - t;
    const int next = f.across[exit];
    if (next < 0) {
      at = clean(at);
      reach.blocked = true;
      reach.border = next == kBorder;
      break;
    }
    const Face& g = faces_[static_cast<size_t>(next)];
    Vec3d carried(0, 0, 0);
    for (int i = 0; i < 3; ++i) {
      int j = 0;
      while (j < 3 && (j == exit || f.node[j] != g.node[i])) ++j;
      if (j < 3)
        carried[i] = at[j];
      else
        entered = i;
    }
    at = clean(carried);
    current = next;
  }
  reach.point = {OpenMesh::FaceHandle(current), at};
  reach.fraction = 1 - left;
  return reach;
}

std::vector<Vec2d> PlaneDomain::separatrices(const UmbilicPoint& umbilic, LineKind kind) const {
  const Face& f = face(umbilic.point.face);
  const Vec2d u = node(f, 1).uv - node(f, 0).uv, v = node(f, 2).uv - node(f, 0).uv;
  const Vec2d du = deviator(node(f, 1).tensor - node(f, 0).tensor);
  const Vec2d dv = deviator(node(f, 2).tensor - node(f, 0).tensor);
  const double area = cross2(u, v);
  const Vec2d gx = (v[1] * du - u[1] * dv) / area, gy = (u[0] * dv - v[0] * du) / area;
  // Along a separatrix the deviator, seen from the umbilic, is an eigenvector of itself: its angle is twice
  // that of the ray, up to a half turn that tells min from max.
  const double sign = kind == LineKind::max ? 1 : -1;
  const auto off_ray = [&](double angle) {
    const Vec2d d = std::cos(angle) * gx + std::sin(angle) * gy;
    return sign * cross2(Vec2d(std::cos(2 * angle), std::sin(2 * angle)), d);
  };
  const auto along = [&](double angle) {
    const Vec2d d = std::cos(angle) * gx + std::sin(angle) * gy;
    return sign * (d | Vec2d(std::cos(2 * angle), std::sin(2 * angle)));
  };
  std::vector<double> angles;
  constexpr int kSamples = 360;
  const double step = 2 * M_PI / kSamples;
  for (int i = 0; i < kSamples; ++i) {
    double low = i * step, high = (i + 1) * step;
    if ((off_ray(low) < 0) == (off_ray(high) < 0)) continue;
    const bool low_negative = off_ray(low) < 0;
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (low + high);
      ((off_ray(middle) < 0) == low_negative ? low : high) = middle;
    }
    if (along(low) > 0) angles.push_back(low);
  }
  // A wedge with three rays has them on one side: the middle one stands for them.
  if (umbilic.index > 0 && angles.size() == 3) {
    double largest_gap = -1;
    size_t after = 0;
    for (size_t i = 0; i < 3; ++i) {
      double gap = angles[(i + 1) % 3] - angles[i];
      if (gap < 0) gap += 2 * M_PI;
      if (gap > largest_gap) largest_gap = gap, after = i;
    }
    angles = {angles[(after + 2) % 3]};
  }
  std::vector<Vec2d> directions;
  for (const double angle : angles) directions.emplace_back(std::cos(angle), std::sin(angle));
  return directions;
}

namespace {

class PlaneIndex final : public LineIndex {
 public:
  PlaneIndex(const PlaneDomain& domain, const std::vector<Proximity::Fence>& fences) : domain_(domain) {
    proximity_.enter_fences(fences);
  }

  Neighbourhood nearest(const SurfacePoint& at, double bound, int own, double from, double to) override {
    const double scale = domain_.scale(at);
    const Vec2d point = domain_.plane_position(at);
    // The stretch may differ between here and there; a margin keeps what is near by their mean.
    const auto found = proximity_.nearest(point, 1.15 * bound * scale, {own, from, to});
    return {as_neighbour(found.line, point, scale), as_neighbour(found.fence, point, scale)};
  }

  void enter(int line, const std::vector<ArcPoint>& points) override {
    std::vector<Proximity::Vertex> vertices;
    vertices.reserve(points.size());
    for (const ArcPoint& p : points)
      vertices.push_back({domain_.plane_position(p.point), p.arc, domain_.scale(p.point)});
    proximity_.enter_line(line, vertices);
  }

  void enter_sample(int id, const SurfacePoint& point) override {
    proximity_.enter_point(id, domain_.plane_position(point), domain_.scale(point));
  }

 private:
  static Neighbour as_neighbour(const PlaneNeighbour& found, const Vec2d& from, double scale) {
    Neighbour neighbour;
    if (std::isinf(found.distance)) return neighbour;
    const double mean = 0.5 * (scale + found.scale);
    neighbour.distance = found.distance / mean;
    neighbour.offset = (found.point - from) / mean;
    neighbour.direction = found.direction;
    neighbour.line = found.line;
    neighbour.arc = found.arc;
    return neighbour;
  }

  const PlaneDomain& domain_;
  Proximity proximity_;
};

}  // namespace

std::unique_ptr<LineIndex> PlaneDomain::make_index() const {
  std::vector<Proximity::Fence> fences;
  for (const Face& f : faces_)
    for (int i = 0; i < 3; ++i) {
      if (f.across[i] >= 0) continue;
      const Node &a = node(f, (i + 1) % 3), &b = node(f, (i + 2) % 3);
      fences.push_back({a.uv, b.uv, a.scale, b.scale});
    }
  return std::make_unique<PlaneIndex>(*this, fences);
}

}  // namespace anisomesh::detail
