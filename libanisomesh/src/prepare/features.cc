#include "anisomesh/features.hh"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

#include "anisomesh/errors.hh"
#include "anisomesh/properties.hh"
#include "prepare/feature_tolerance.hh"
#include "surface/unfit_mesh.hh"

namespace anisomesh {

namespace {

using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::TriConnectivity;
using OpenMesh::VertexHandle;

constexpr double sharp_degrees = 40, corner_degrees = 45;
constexpr double needle = 0.01;  // twice the area over the squared longest side: no thinner
constexpr int needle_steps = 8;  // from needle to needle
constexpr double pi = 3.14159265358979323846;

Vec3d area_vector(const SurfaceRef& surface, FaceHandle face) {
  const auto corners = surface.corners(face);
  const Vec3d& a = surface.point(corners.vertex[0]);
  return (surface.point(corners.vertex[1]) - a) % (surface.point(corners.vertex[2]) - a);
}

/// The angle between two vectors in degrees; 0 where one of them vanishes, so that a face without area makes
/// no feature.
double angle_between(const Vec3d& a, const Vec3d& b) { return std::atan2((a % b).norm(), a | b) * 180 / pi; }

/// Whether a curve whose two edges leave a vertex so turns there by more than an angle.
bool turns_by_more(const Vec3d& leaving, const Vec3d& other, double degrees) {
  return 180 - angle_between(leaving, other) > degrees;
}

/// The halfedge of a face that is its longest side.
HalfedgeHandle longest_side(const SurfaceRef& surface, FaceHandle face) {
  const auto& mesh = surface.connectivity();
  HalfedgeHandle longest;
  double most = -1;
  for (const auto h : mesh.fh_range(face)) {
    const double length =
        (surface.point(mesh.to_vertex_handle(h)) - surface.point(mesh.from_vertex_handle(h))).sqrnorm();
    if (length <= most) continue;
    most = length;
    longest = h;
  }
  return longest;
}

/// Normal of a face, not of unit length. A needle has none worth the name and lies in the face beyond its
/// longest side, unless that is as thin and both are a strip.
Vec3d normal_of(const SurfaceRef& surface, FaceHandle face) {
  const auto& mesh = surface.connectivity();
  for (int step = 0; step < needle_steps; ++step) {
    const Vec3d area = area_vector(surface, face);
    const HalfedgeHandle side = longest_side(surface, face), beyond = mesh.opposite_halfedge_handle(side);
    const double squared =
        (surface.point(mesh.to_vertex_handle(side)) - surface.point(mesh.from_vertex_handle(side))).sqrnorm();
    if (area.norm() > needle * squared || mesh.is_boundary(beyond)) return area;
    const FaceHandle next = mesh.face_handle(beyond);
    if (longest_side(surface, next) == beyond && area_vector(surface, next).norm() <= needle * squared)
      return area;
    face = next;
  }
  return area_vector(surface, face);
}

/// By how many degrees the surface turns at an edge; 0 on the border.
double turn_at(const SurfaceRef& surface, EdgeHandle edge) {
  const auto& mesh = surface.connectivity();
  const auto h = mesh.halfedge_handle(edge, 0), g = mesh.halfedge_handle(edge, 1);
  if (mesh.is_boundary(h) || mesh.is_boundary(g)) return 0;
  const Vec3d first = normal_of(surface, mesh.face_handle(h)).normalize_cond();
  const Vec3d second = normal_of(surface, mesh.face_handle(g)).normalize_cond();
  return angle_between(first, second);
}

std::vector<EdgeHandle> listed_edges(const TriConnectivity& mesh,
                                     const std::vector<std::pair<int, int>>& pairs) {
  std::vector<EdgeHandle> edges;
  const int count = static_cast<int>(mesh.n_vertices());
  for (const auto& [a, b] : pairs) {
    const std::string name = "feature edge (" + std::to_string(a) + ", " + std::to_string(b) + ")";
    if (a < 0 || b < 0 || a >= count || b >= count)
      throw InvalidInput(name + ": the mesh has vertices 0 to " + std::to_string(count - 1) + " only");
    const auto halfedge = mesh.find_halfedge(VertexHandle(a), VertexHandle(b));
    if (!halfedge.is_valid())
      throw InvalidInput(name +
                         " is no edge of the mesh; check that the indices start at 0 and that the file "
                         "belongs to this mesh");
    edges.push_back(mesh.edge_handle(halfedge));
  }
  return edges;
}

/// The halfedges of the feature graph that leave a vertex.
std::vector<HalfedgeHandle> graph_halfedges(const TriConnectivity& mesh, VertexHandle vertex) {
  std::vector<HalfedgeHandle> result;
  for (const auto h : mesh.voh_range(vertex))
    if (is_feature_or_border(mesh, mesh.edge_handle(h))) result.push_back(h);
  return result;
}

Vec3d direction(const SurfaceRef& surface, HalfedgeHandle halfedge) {
  const auto& mesh = surface.connectivity();
  return surface.point(mesh.to_vertex_handle(halfedge)) - surface.point(mesh.from_vertex_handle(halfedge));
}

class SkeletonBuilder {
 public:
  SkeletonBuilder(const SurfaceRef& surface, double corner_angle_degrees)
      : mesh_(surface.connectivity()), is_corner_(mesh_.n_vertices(), 0), used_(mesh_.n_edges(), 0) {
    for (const auto v : mesh_.vertices()) {
      const auto leaving = graph_halfedges(mesh_, v);
      if (leaving.empty()) continue;
      // Border and crease are different curves even where one runs smoothly into the other.
      const bool corner =
          leaving.size() != 2 || border(leaving[0]) != border(leaving[1]) ||
          turns_by_more(direction(surface, leaving[0]), direction(surface, leaving[1]), corner_angle_degrees);
      if (!corner) continue;
      is_corner_[static_cast<size_t>(v.idx())] = 1;
      skeleton_.corners.push_back(v);
    }
  }

  FeatureSkeleton build() {
    for (const auto corner : skeleton_.corners)
      for (const auto h : graph_halfedges(mesh_, corner)) follow(h);
    for (const auto e : mesh_.edges())
      if (is_feature_or_border(mesh_, e)) follow(mesh_.halfedge_handle(e, 0));
    return std::move(skeleton_);
  }

 private:
  bool border(HalfedgeHandle halfedge) const { return mesh_.is_boundary(mesh_.edge_handle(halfedge)); }

  /// Takes the chain from `first` to the next corner, or all round, unless it is already taken.
  void follow(HalfedgeHandle first) {
    if (used_[static_cast<size_t>(mesh_.edge_handle(first).idx())]) return;
    FeatureCurve curve;
    curve.border = border(first);
    const auto start = mesh_.from_vertex_handle(first);
    HalfedgeHandle current = first;
    while (true) {
      used_[static_cast<size_t>(mesh_.edge_handle(current).idx())] = 1;
      curve.halfedges.push_back(current);
      const auto tip = mesh_.to_vertex_handle(current);
      if (tip == start) curve.closed = true;
      if (tip == start || is_corner_[static_cast<size_t>(tip.idx())]) break;
      const auto leaving = graph_halfedges(mesh_, tip);
      const bool back = mesh_.edge_handle(leaving[0]) == mesh_.edge_handle(current);
      current = leaving[back ? 1 : 0];
    }
    // A loop that hangs on one corner is a curve from that corner to itself.
    if (is_corner_[static_cast<size_t>(start.idx())]) curve.closed = false;
    skeleton_.curves.push_back(std::move(curve));
  }

  const TriConnectivity& mesh_;
  std::vector<char> is_corner_, used_;
  FeatureSkeleton skeleton_;
};

}  // namespace

void FeatureOptions::validate() const {
  if (!(angle_degrees >= 0 && angle_degrees < 180))
    throw InvalidOption("angle_degrees is " + std::to_string(angle_degrees) + ", must be in [0, 180)");
}

namespace {

/// Turns of all edges, degrees; fills in what the report says of them.
std::vector<double> measure_turns(const SurfaceRef& surface, FeatureReport& report) {
  const auto& mesh = surface.connectivity();
  double length = 0;
  std::vector<double> turns(mesh.n_edges(), 0);
  std::vector<std::vector<Vec3d>> sharp(mesh.n_vertices());  // directions of sharp edges
  for (const auto e : mesh.edges()) {
    if (mesh.is_boundary(e)) continue;
    const double turn = turns[static_cast<size_t>(e.idx())] = turn_at(surface, e);
    const HalfedgeHandle h = mesh.halfedge_handle(e, 0);
    const Vec3d along = direction(surface, h);
    length += along.norm();
    if (turn > sharp_degrees) {
      report.sharp += along.norm();
      sharp[static_cast<size_t>(mesh.from_vertex_handle(h).idx())].push_back(along);
      sharp[static_cast<size_t>(mesh.to_vertex_handle(h).idx())].push_back(-along);
    } else if (turn > sharp_degrees / 2) {
      report.rounded += along.norm();
    }
  }
  if (length > 0) {
    report.sharp /= length;
    report.rounded /= length;
  }
  report.vertices = mesh.n_vertices();
  for (const auto& leaving : sharp)
    report.corners +=
        !leaving.empty() && (leaving.size() != 2 || turns_by_more(leaving[0], leaving[1], corner_degrees));
  return turns;
}

}  // namespace

FeatureReport tag_features(const SurfaceRef& surface, const FeatureOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  options.validate();
  auto& mesh = detail::unchanged(surface).connectivity();
  FeatureReport report;
  std::vector<char> tagged(mesh.n_edges(), 0);
  if (options.keep_existing && mesh.has_edge_status())
    for (const auto e : mesh.edges()) tagged[static_cast<size_t>(e.idx())] = mesh.status(e).feature();
  for (const auto e : listed_edges(mesh, options.edges)) tagged[static_cast<size_t>(e.idx())] |= 2;
  const std::vector<double> turns = measure_turns(surface, report);
  const bool told = options.angle_degrees > 0 ||
                    std::any_of(tagged.begin(), tagged.end(), [](char tag) { return tag != 0; });
  report.automatic = options.automatic && !told && report.is_mechanical();
  report.angle_degrees = report.automatic ? sharp_degrees : options.angle_degrees;
  if (report.angle_degrees > 0)
    for (size_t e = 0; e < turns.size(); ++e)
      if (turns[e] > report.angle_degrees) tagged[e] |= 4;
  if (!mesh.has_edge_status()) mesh.request_edge_status();
  for (const auto e : mesh.edges()) {
    const char tag = tagged[static_cast<size_t>(e.idx())];
    mesh.status(e).set_feature(tag != 0);
    if (mesh.is_boundary(e)) continue;
    report.feature_edges += tag != 0;
    report.by_list += (tag & 2) != 0;
    report.by_angle += (tag & 4) != 0;
  }
  // Tags that the mesh brings along keep what was recorded of them.
  if (report.automatic || report.by_angle + report.by_list > 0)
    mesh.property(provide_property(mesh, property::feature_tolerance)) =
        report.automatic ? detail::found_feature_tolerance : detail::asked_feature_tolerance;
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

FeatureSkeleton feature_skeleton(const SurfaceRef& surface, double corner_angle_degrees) {
  return SkeletonBuilder(surface, corner_angle_degrees).build();
}

bool is_feature_or_border(const TriConnectivity& mesh, EdgeHandle edge) {
  return mesh.is_boundary(edge) || (mesh.has_edge_status() && mesh.status(edge).feature());
}

}  // namespace anisomesh
