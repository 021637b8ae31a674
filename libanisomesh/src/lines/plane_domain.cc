#include "lines/plane_domain.hh"

#include <algorithm>
#include <cmath>
#include <set>

#include "anisomesh/features.hh"
#include "anisomesh/properties.hh"
#include "anisomesh/smoothing.hh"
#include "numerics/disjoint_sets.hh"
#include "numerics/proximity.hh"

namespace anisomesh::detail {

namespace {

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
  PlaneInput input;
  for (const auto v : mesh.all_vertices()) {
    input.uv.push_back(mesh.property(uv, v));
    input.area_stretch.push_back(mesh.property(stretch, v));
  }
  input.corner_tensors = corner_tensors(surface);
  input.umbilics = read_umbilics(surface, input.corner_tensors);
  return input;
}

PlaneDomain::PlaneDomain(const SurfaceRef& surface, const PlaneInput& input, const DensityOptions& density,
                         Follow follow)
    : FaceDomain(surface.connectivity().n_faces(), input.umbilics, density,
                 Density(density, surface.diagonal(), surface.extent(),
                         mean_curvature(surface, input.corner_tensors)),
                 follow) {
  make_nodes(surface, input);
  set_across(surface, faces_);
  std::vector<Vec3d> tensors;
  for (const Node& node : nodes_) tensors.push_back(node.tensor);
  make_spacing(tensors, [this](size_t f, int i) {
    const Node &from = node(faces_[f], i), &to = node(faces_[f], (i + 1) % 3);
    return (to.uv - from.uv).norm() / (0.5 * (from.scale + to.scale));
  });
  register_umbilics([this](const SurfacePoint& at, double radius, const IsHidden& is_hidden) {
    const Vec2d place = plane_position(at);
    std::vector<NearFace> found;
    for (const int f : faces_within(at, radius, is_hidden)) {
      double farthest = 0;
      for (int i = 0; i < 3; ++i)
        farthest = std::max(farthest, (node(faces_[static_cast<size_t>(f)], i).uv - place).norm());
      found.push_back({f, place, farthest});
    }
    return found;
  });
}

void PlaneDomain::make_nodes(const SurfaceRef& surface, const PlaneInput& input) {
  auto& mesh = surface.connectivity();
  DisjointSets sides(3 * faces_.size());
  const auto corner = [](OpenMesh::FaceHandle f, int i) {
    return 3 * static_cast<size_t>(f.idx()) + static_cast<size_t>(i);
  };
  for (const auto edge : mesh.all_edges()) {
    if (is_feature_or_border(mesh, edge)) continue;
    const auto h = mesh.halfedge_handle(edge, 0);
    const auto left = mesh.face_handle(h), right = mesh.opposite_face_handle(h);
    for (const auto v : {mesh.from_vertex_handle(h), mesh.to_vertex_handle(h)})
      sides.join(corner(left, corner_of(surface, left, v)), corner(right, corner_of(surface, right, v)));
  }
  std::vector<int> number(3 * faces_.size(), -1), count;
  for (const auto f : mesh.all_faces()) {
    const auto corners = surface.corners(f);
    for (int i = 0; i < 3; ++i) {
      int& id = number[sides.root(corner(f, i))];
      const size_t vertex = static_cast<size_t>(corners.vertex[i].idx());
      if (id < 0) {
        id = static_cast<int>(nodes_.size());
        nodes_.push_back({input.uv[vertex], std::sqrt(input.area_stretch[vertex]), {0, 0, 0}});
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

void PlaneDomain::mark_within(const SurfacePoint& at, double radius, std::vector<char>& marks) const {
  for (const int f : faces_within(at, radius, [](int, double) { return false; }))
    marks[static_cast<size_t>(f)] = 1;
}

std::vector<int> PlaneDomain::faces_within(const SurfacePoint& at, double radius,
                                           const IsHidden& is_hidden) const {
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
      const double distance = (a + t * ab - centre).norm();
      if (distance <= plane_radius && !is_hidden(next, distance) && seen.insert(next).second)
        found.push_back(next);
    }
  }
  return found;
}

double PlaneDomain::distance(const SurfacePoint& at, const Vec2d& place) const {
  return (place - plane_position(at)).norm() / scale(at);
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
  return followed(at.barycentric[0] * node(f, 0).tensor + at.barycentric[1] * node(f, 1).tensor +
                      at.barycentric[2] * node(f, 2).tensor,
                  follow());
}

Vec3d PlaneDomain::tensor_ahead(const SurfacePoint& from, const Vec2d& vector) const {
  return tensor(walk(from, vector).point);
}

LinearField PlaneDomain::field(const Face& f) const {
  return {{node(f, 0).uv, node(f, 1).uv, node(f, 2).uv},
          {node(f, 0).tensor, node(f, 1).tensor, node(f, 2).tensor}};
}

double PlaneDomain::turning_length(const SurfacePoint& at) const {
  return detail::turning_length(field(face(at.face)), tensor(at)) / scale(at);
}

double PlaneDomain::area(OpenMesh::FaceHandle handle) const {
  const Face& f = face(handle);
  const double mean_scale = (node(f, 0).scale + node(f, 1).scale + node(f, 2).scale) / 3;
  return 0.5 * cross2(node(f, 1).uv - node(f, 0).uv, node(f, 2).uv - node(f, 0).uv) /
         (mean_scale * mean_scale);
}

double PlaneDomain::side(OpenMesh::FaceHandle handle, int corner) const {
  const Node &a = node(face(handle), (corner + 1) % 3), &b = node(face(handle), (corner + 2) % 3);
  return (b.uv - a.uv).norm() / (0.5 * (a.scale + b.scale));
}

Vec3d PlaneDomain::barycentric(const Face& f, const Vec2d& point) const {
  const Vec2d a = node(f, 0).uv - point, b = node(f, 1).uv - point, c = node(f, 2).uv - point;
  const Vec3d areas(cross2(b, c), cross2(c, a), cross2(a, b));
  const double total = cross2(node(f, 1).uv - node(f, 0).uv, node(f, 2).uv - node(f, 0).uv);
  return areas / total;
}

// \param visit called for each face with the ends of the way in it and what of the vector is left at each;
// false stops
template <class Visit>
Reach PlaneDomain::walk_visiting(const SurfacePoint& from, const Vec2d& vector, Visit&& visit) const {
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
    const Vec3d before = at;
    const double left_before = left;
    at = clean(exit < 0 ? end : at + t * (end - at));
    left = exit < 0 ? 0 : left * (1 - t);
    if (!visit(current, before, at, left_before, left) || exit < 0) break;
    at[exit] = 0;
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

Reach PlaneDomain::walk(const SurfacePoint& from, const Vec2d& vector) const {
  return walk_visiting(from, vector, [](int, const Vec3d&, const Vec3d&, double, double) { return true; });
}

Reach PlaneDomain::walk_while(const SurfacePoint& from, const Vec2d& vector,
                              const std::function<bool(const WayPiece&)>& visit) const {
  return walk_visiting(
      from, vector, [&](int face, const Vec3d& begin, const Vec3d& end, double left, double left_after) {
        return visit({face, {begin[1], begin[2]}, {end[1], end[2]}, 1 - left, 1 - left_after});
      });
}

std::vector<Vec2d> PlaneDomain::separatrices(const UmbilicPoint& umbilic, LineKind kind) const {
  return separatrix_directions(field(face(umbilic.point.face)), umbilic, kind, follow(),
                               scale(umbilic.point) * first_step(umbilic, kind));
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

std::unique_ptr<LineIndex> PlaneDomain::make_index(
    const std::function<double(const SurfacePoint&)>& /*reach*/) const {
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
