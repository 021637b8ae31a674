#include "surface/canonical_order.hh"

#include <algorithm>
#include <cmath>

#include "surface/intrinsic_order.hh"

namespace anisomesh::detail {

namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

template <class Handle>
size_t at(Handle handle) {
  return static_cast<size_t>(handle.idx());
}

// What telling roots apart may visit altogether, faces, and each of them at least.
constexpr size_t kMostVisited = 500000, kLeastVisited = 100;
constexpr size_t kMostRoots = 2000;

/// A walk over the faces, breadth first and counter-clockwise.
class Walk {
 public:
  explicit Walk(const OpenMesh::TriConnectivity& mesh) : mesh_(mesh), seen_(mesh.n_faces(), 0) {}

  /// Forgets what was visited.
  void restart() { ++round_; }
  bool has_seen(FaceHandle f) const { return seen_[at(f)] == round_; }

  /// Calls visit(side through which a face is entered, number of faces found from there) for each face, as
  /// long as that returns true.
  template <class Visit>
  void run(HalfedgeHandle root, Visit visit) {
    queue_.assign(1, root);
    seen_[at(mesh_.face_handle(root))] = round_;
    for (size_t i = 0; i < queue_.size(); ++i) {
      const size_t before = queue_.size();
      auto side = queue_[i];
      for (int k = 0; k < 3; ++k, side = mesh_.next_halfedge_handle(side)) {
        const auto across = mesh_.opposite_halfedge_handle(side);
        if (mesh_.is_boundary(across) || has_seen(mesh_.face_handle(across))) continue;
        seen_[at(mesh_.face_handle(across))] = round_;
        queue_.push_back(across);
      }
      if (!visit(queue_[i], queue_.size() - before)) return;
    }
  }

 private:
  const OpenMesh::TriConnectivity& mesh_;
  std::vector<int> seen_;
  int round_ = 1;
  std::vector<HalfedgeHandle> queue_;
};

/// What hangs together by edges.
struct Part {
  std::vector<FaceHandle> faces;
  double area = 0;
  Vec3d middle{0, 0, 0};
};

class Numbering {
 public:
  explicit Numbering(const SurfaceRef& surface)
      : surface_(surface),
        mesh_(surface.connectivity()),
        walk_(mesh_),
        area_around_(mesh_.n_vertices(), 0),
        away_(mesh_.n_vertices(), 0) {}

  CanonicalOrder run();

 private:
  void find_parts();
  std::vector<int> order_of_parts() const;
  HalfedgeHandle root_of(const Part& part);
  HalfedgeHandle first_of(const std::vector<HalfedgeHandle>& roots, double size);
  std::vector<double> seen_from(HalfedgeHandle root, size_t most);
  void number(HalfedgeHandle root, CanonicalOrder& order, std::vector<char>& has_vertex,
              std::vector<char>& has_edge);
  void append_loose(CanonicalOrder& order, const std::vector<char>& has_vertex,
                    const std::vector<char>& has_edge) const;
  double length(HalfedgeHandle h) const {
    return (surface_.point(mesh_.to_vertex_handle(h)) - surface_.point(mesh_.from_vertex_handle(h))).norm();
  }

  const SurfaceRef& surface_;
  const OpenMesh::TriConnectivity& mesh_;
  Walk walk_;
  std::vector<Part> parts_;
  Vec3d middle_{0, 0, 0};
  std::vector<double> area_around_, away_;
};

void Numbering::find_parts() {
  for (const auto start : mesh_.all_faces()) {
    if (walk_.has_seen(start)) continue;
    Part part;
    walk_.run(mesh_.halfedge_handle(start), [&](HalfedgeHandle side, size_t) {
      part.faces.push_back(mesh_.face_handle(side));
      const auto corners = surface_.corners(part.faces.back());
      const Vec3d &a = surface_.point(corners.vertex[0]), &b = surface_.point(corners.vertex[1]),
                  &c = surface_.point(corners.vertex[2]);
      const double area = 0.5 * ((b - a) % (c - a)).norm();
      part.area += area;
      part.middle += area / 3 * (a + b + c);
      for (const auto v : corners.vertex) area_around_[at(v)] += area;
      return true;
    });
    parts_.push_back(std::move(part));
  }
  double sum = 0;
  for (Part& part : parts_) {
    middle_ += part.middle;
    sum += part.area;
    part.middle = part.area > 0
                      ? Vec3d(part.middle / part.area)
                      : surface_.point(mesh_.to_vertex_handle(mesh_.halfedge_handle(part.faces.front())));
  }
  middle_ = sum > 0 ? Vec3d(middle_ / sum) : parts_.front().middle;
}

std::vector<int> Numbering::order_of_parts() const {
  std::vector<Measures> measures;
  measures.reserve(parts_.size());
  for (const Part& part : parts_)
    measures.push_back({static_cast<double>(part.faces.size()), part.area, (part.middle - middle_).norm()});
  return intrinsic_order(measures);
}

/// Leaves those with the largest measure.
template <class Measure>
void keep_largest(std::vector<HalfedgeHandle>& sides, Measure measure) {
  std::vector<double> values;
  values.reserve(sides.size());
  for (const auto h : sides) values.push_back(measure(h));
  const double largest = *std::max_element(values.begin(), values.end());
  const double least = largest - kTie * std::abs(largest);
  size_t kept = 0;
  for (size_t i = 0; i < sides.size(); ++i)
    if (values[i] >= least) sides[kept++] = sides[i];
  sides.resize(kept);
}

HalfedgeHandle Numbering::root_of(const Part& part) {
  double size = 0;
  for (const auto f : part.faces)
    for (const auto v : surface_.corners(f).vertex) {
      away_[at(v)] = (surface_.point(v) - part.middle).norm();
      size = std::max(size, away_[at(v)]);
    }
  std::vector<HalfedgeHandle> roots;
  for (const auto f : part.faces) {
    auto side = mesh_.halfedge_handle(f);
    for (int k = 0; k < 3; ++k, side = mesh_.next_halfedge_handle(side))
      if (away_[at(mesh_.from_vertex_handle(side))] >= (1 - kTie) * size) roots.push_back(side);
  }
  keep_largest(roots, [&](HalfedgeHandle h) { return area_around_[at(mesh_.from_vertex_handle(h))]; });
  keep_largest(roots, [&](HalfedgeHandle h) { return length(h); });
  keep_largest(roots, [&](HalfedgeHandle h) { return away_[at(mesh_.to_vertex_handle(h))]; });
  return first_of(roots, size);
}

/// How a walk from there goes on: what it meets, how far from the middle and how long sides are.
std::vector<double> Numbering::seen_from(HalfedgeHandle root, size_t most) {
  std::vector<double> seen;
  walk_.restart();
  walk_.run(root, [&](HalfedgeHandle side, size_t found) {
    seen.push_back(static_cast<double>(found));
    seen.push_back(away_[at(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(side)))]);
    seen.push_back(length(side));
    return seen.size() < 3 * most;
  });
  return seen;
}

HalfedgeHandle Numbering::first_of(const std::vector<HalfedgeHandle>& roots, double size) {
  if (roots.size() == 1) return roots.front();
  const size_t n = std::min(roots.size(), kMostRoots), most = std::max(kMostVisited / n, kLeastVisited);
  auto best = seen_from(roots.front(), most);
  HalfedgeHandle first = roots.front();
  for (size_t i = 1; i < n; ++i) {
    auto seen = seen_from(roots[i], most);
    for (size_t k = 0; k < std::min(seen.size(), best.size()); ++k) {
      const double step = k % 3 == 0 ? 0.5 : kTie * size;  // the first of three is a count
      if (std::abs(seen[k] - best[k]) <= step) continue;
      if (seen[k] > best[k]) {
        best.swap(seen);
        first = roots[i];
      }
      break;
    }
  }
  return first;
}

void Numbering::number(HalfedgeHandle root, CanonicalOrder& order, std::vector<char>& has_vertex,
                       std::vector<char>& has_edge) {
  walk_.run(root, [&](HalfedgeHandle entered, size_t) {
    order.faces.push_back(entered);
    auto side = entered;
    for (int k = 0; k < 3; ++k, side = mesh_.next_halfedge_handle(side)) {
      const auto v = mesh_.from_vertex_handle(side);
      const auto e = mesh_.edge_handle(side);
      if (!has_vertex[at(v)]) order.vertices.push_back(v);
      if (!has_edge[at(e)]) order.edges.push_back(side);
      has_vertex[at(v)] = has_edge[at(e)] = 1;
    }
    return true;
  });
}

// What belongs to no face.
void Numbering::append_loose(CanonicalOrder& order, const std::vector<char>& has_vertex,
                             const std::vector<char>& has_edge) const {
  std::vector<VertexHandle> loose;
  std::vector<Measures> measures;
  for (const auto v : mesh_.all_vertices())
    if (!has_vertex[at(v)]) {
      loose.push_back(v);
      measures.push_back({(surface_.point(v) - middle_).norm(), 0, 0});
    }
  for (const int i : intrinsic_order(measures)) order.vertices.push_back(loose[static_cast<size_t>(i)]);
  for (const auto e : mesh_.all_edges())
    if (!has_edge[at(e)]) order.edges.push_back(mesh_.halfedge_handle(e, 0));
}

CanonicalOrder Numbering::run() {
  find_parts();
  std::vector<HalfedgeHandle> roots;
  for (const int p : order_of_parts()) roots.push_back(root_of(parts_[static_cast<size_t>(p)]));
  CanonicalOrder order;
  order.vertices.reserve(mesh_.n_vertices());
  order.edges.reserve(mesh_.n_edges());
  order.faces.reserve(mesh_.n_faces());
  std::vector<char> has_vertex(mesh_.n_vertices(), 0), has_edge(mesh_.n_edges(), 0);
  walk_.restart();
  for (const auto root : roots) number(root, order, has_vertex, has_edge);
  append_loose(order, has_vertex, has_edge);
  return order;
}

}  // namespace

CanonicalOrder canonical_order(const SurfaceRef& surface) { return Numbering(surface).run(); }

}  // namespace anisomesh::detail
