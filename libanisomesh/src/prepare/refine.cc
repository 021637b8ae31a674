#include "anisomesh/refine.hh"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <tuple>

#include "anisomesh/errors.hh"
#include "anisomesh/properties.hh"
#include "surface/canonical_order.hh"
#include "surface/rounding.hh"
#include "surface/unfit_mesh.hh"

namespace anisomesh {

namespace {

using OpenMesh::EdgeHandle, OpenMesh::FaceHandle, OpenMesh::TriMesh, OpenMesh::VertexHandle;

constexpr size_t least_budget = 20000;  // triangles
constexpr double each_round = 0.6;      // of the longest edge: what is as long is halved with it
constexpr double without_area = 1e-9;   // height over length
constexpr double worth_halving = 0.5;   // of its triangle's longest edge

template <class Handle>
size_t at(Handle handle) {
  return static_cast<size_t>(handle.idx());
}

/// The same elements with the same numbers. OpenMesh's own assign_connectivity() takes the handles of the
/// status along, which stand for other properties where the mesh has its own traits or properties.
void copy_connectivity(const OpenMesh::TriConnectivity& from, OpenMesh::TriConnectivity& to) {
  for (size_t v = 0; v < from.n_vertices(); ++v) to.new_vertex();
  for (const auto e : from.all_edges()) {
    const auto h = from.halfedge_handle(e, 0);
    to.new_edge(from.from_vertex_handle(h), from.to_vertex_handle(h));
  }
  for (size_t f = 0; f < from.n_faces(); ++f) to.new_face();
  for (const auto v : from.all_vertices()) to.set_halfedge_handle(v, from.halfedge_handle(v));
  for (const auto f : from.all_faces()) to.set_halfedge_handle(f, from.halfedge_handle(f));
  for (const auto h : from.all_halfedges()) {
    if (from.next_halfedge_handle(h).is_valid()) to.set_next_halfedge_handle(h, from.next_halfedge_handle(h));
    to.set_face_handle(h, from.face_handle(h));
  }
}

class Refiner {
 public:
  Refiner(const SurfaceRef& surface, const RefineOptions& options);

  /// Halves what is among the longest. \return whether there was anything, and room for it
  bool round();

  TriMesh mesh;
  RefineReport report;

 private:
  double longest_to_halve(std::vector<char>& marked) const;
  std::vector<EdgeHandle> in_order(const std::vector<char>& marked);
  void halve(EdgeHandle edge);

  double limit_, aspect_;
  size_t budget_;
  std::vector<int> rank_;  // of each vertex, by the shape of the surface
};

Refiner::Refiner(const SurfaceRef& surface, const RefineOptions& options)
    : limit_(options.max_edge_fraction * surface.extent()),
      aspect_(options.min_aspect),
      budget_(options.max_triangles > 0 ? options.max_triangles
                                        : std::max(least_budget, 2 * surface.connectivity().n_faces())) {
  const auto& given = surface.connectivity();
  copy_connectivity(given, mesh);
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  for (const auto v : given.vertices()) mesh.set_point(v, surface.point(v));
  if (given.has_edge_status())
    for (const auto e : given.edges()) mesh.status(e).set_feature(given.status(e).feature());
  if (has_property(given, property::feature_tolerance))
    mesh.property(provide_property(mesh, property::feature_tolerance)) =
        given.property(require_property(given, property::feature_tolerance));
  for (const auto f : given.faces()) report.parent_of.push_back(f.idx());
}

/// Marks the edges of long, thin triangles that are to be halved at some time. \return the longest's length
double Refiner::longest_to_halve(std::vector<char>& marked) const {
  double longest = 0;
  for (const auto f : mesh.faces()) {
    double most = 0;
    for (const auto e : f.edges()) most = std::max(most, mesh.calc_edge_length(e));
    const double height = most > 0 ? 2 * mesh.calc_face_area(f) / most : 0;
    if (!(height > without_area * most)) continue;  // nothing bends there
    if (!detail::is_surely_less(limit_, most) || !detail::is_surely_less(aspect_ * height, most)) continue;
    for (const auto e : f.edges()) {
      const double length = mesh.calc_edge_length(e);
      if (!detail::is_surely_less(limit_, length) || !detail::is_surely_less(worth_halving * most, length))
        continue;
      marked[at(e)] = 1;
      longest = std::max(longest, length);
    }
  }
  return longest;
}

/// The longest first: which of two sides of a triangle is halved first says how it is divided.
std::vector<EdgeHandle> Refiner::in_order(const std::vector<char>& marked) {
  if (rank_.empty()) {
    rank_.resize(mesh.n_vertices());
    const auto order = detail::canonical_order(mesh).vertices;
    for (size_t i = 0; i < order.size(); ++i) rank_[at(order[i])] = static_cast<int>(i);
  }
  struct Edge {
    double length;
    int low, high;
    EdgeHandle handle;
  };
  std::vector<Edge> edges;
  for (const auto e : mesh.edges())
    if (marked[at(e)]) {
      const int a = rank_[at(e.v0())], b = rank_[at(e.v1())];
      edges.push_back({-mesh.calc_edge_length(e), std::min(a, b), std::max(a, b), e});
    }
  std::vector<double> lengths;
  lengths.reserve(edges.size());
  for (const Edge& e : edges) lengths.push_back(e.length);
  lengths = detail::in_steps(std::move(lengths));
  for (size_t i = 0; i < edges.size(); ++i) edges[i].length = lengths[i];
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.length, a.low, a.high) < std::tie(b.length, b.low, b.high);
  });
  std::vector<EdgeHandle> result;
  result.reserve(edges.size());
  for (const Edge& e : edges) result.push_back(e.handle);
  return result;
}

void Refiner::halve(EdgeHandle edge) {
  const auto h = OpenMesh::make_smart(mesh.halfedge_handle(edge, 0), mesh);
  const VertexHandle from = h.from(), to = h.to();
  const bool feature = mesh.status(edge).feature();
  struct Side {
    VertexHandle opposite;
    int parent = -1;
  } sides[2];
  for (int k = 0; k < 2; ++k) {
    const auto side = k == 0 ? h : h.opp();
    if (!side.is_boundary()) sides[k] = {side.next().to(), report.parent_of[at(side.face())]};
  }
  const size_t before = mesh.n_faces();
  const VertexHandle middle = mesh.add_vertex(0.5 * (mesh.point(from) + mesh.point(to)));
  mesh.split(edge, middle);
  for (const VertexHandle end : {from, to})
    mesh.status(mesh.edge_handle(mesh.find_halfedge(middle, end))).set_feature(feature);
  for (size_t f = before; f < mesh.n_faces(); ++f) {
    bool first = false;
    for (const auto v : mesh.fv_range(FaceHandle(static_cast<int>(f)))) first |= v == sides[0].opposite;
    report.parent_of.push_back(first ? sides[0].parent : sides[1].parent);
  }
  rank_.push_back(static_cast<int>(rank_.size()));
  ++report.divided;
}

bool Refiner::round() {
  std::vector<char> marked(mesh.n_edges(), 0);
  const double longest = longest_to_halve(marked);
  size_t more = 0;
  for (const auto e : mesh.edges()) {
    if (!detail::is_surely_less(each_round * longest, mesh.calc_edge_length(e))) marked[at(e)] = 0;
    if (marked[at(e)]) more += mesh.is_boundary(e) ? 1 : 2;
  }
  if (more == 0 || mesh.n_faces() + more > budget_) return false;
  for (const EdgeHandle e : in_order(marked)) halve(e);
  return true;
}

}  // namespace

void RefineOptions::validate() const {
  if (!(max_edge_fraction >= 0 && max_edge_fraction <= 1))
    throw InvalidOption("max_edge_fraction must be from 0 to 1, but is " + std::to_string(max_edge_fraction));
  if (!(min_aspect >= 1))
    throw InvalidOption("min_aspect must be at least 1, but is " + std::to_string(min_aspect));
}

TriMesh refine(const SurfaceRef& surface, const RefineOptions& options, RefineReport* report) {
  const auto start = std::chrono::steady_clock::now();
  options.validate();
  Refiner refiner(detail::unchanged(surface), options);
  if (options.max_edge_fraction > 0)
    while (refiner.round()) {
    }
  const auto& given = surface.connectivity();
  if (has_property(given, property::chart)) {
    const auto from = require_property(given, property::chart);
    auto to = provide_property(refiner.mesh, property::chart);
    for (const auto f : refiner.mesh.faces())
      refiner.mesh.property(to, f) = given.property(from, FaceHandle(refiner.report.parent_of[at(f)]));
  }
  refiner.report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (report) *report = std::move(refiner.report);
  return std::move(refiner.mesh);
}

}  // namespace anisomesh
