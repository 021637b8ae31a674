// known_surface SURFACE.om RESULT.om: the unit square with everything that can be seen on a surface at places
// that the tests of the viewer know, and a result of three polygons over it.
#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>
#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <iostream>

#include "anisomesh/features.hh"
#include "anisomesh/io.hh"
#include "anisomesh/lines.hh"
#include "anisomesh/mesher.hh"
#include "anisomesh/properties.hh"

namespace {

using namespace anisomesh;

constexpr int cells = 10;

int vertex_at(int i, int j) { return j * (cells + 1) + i; }

/// The point (x, y) of the square, by arithmetic: cell (i, j) has face 2 (10 j + i) below its diagonal and
/// the next above.
SurfacePoint at(const SurfaceRef& surface, double x, double y) {
  const int i = std::min(static_cast<int>(x * cells), cells - 1),
            j = std::min(static_cast<int>(y * cells), cells - 1);
  const double s = x * cells - i, t = y * cells - j;
  const OpenMesh::FaceHandle face(2 * (cells * j + i) + (t > s ? 1 : 0));
  SurfacePoint point{face, {0, 0, 0}};
  const auto corners = surface.corners(face);
  for (size_t k = 0; k < 3; ++k) {
    const int v = corners.vertex[k].idx();
    if (v == vertex_at(i, j)) point.barycentric[k] = t > s ? 1 - t : 1 - s;
    if (v == vertex_at(i + 1, j + 1)) point.barycentric[k] = t > s ? s : t;
    if (v == vertex_at(i + 1, j)) point.barycentric[k] = s - t;
    if (v == vertex_at(i, j + 1)) point.barycentric[k] = t - s;
  }
  return point;
}

OpenMesh::TriMesh make_square() {
  OpenMesh::TriMesh mesh;
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) mesh.add_vertex({i / double(cells), j / double(cells), 0});
  const auto v = [](int i, int j) { return OpenMesh::VertexHandle(vertex_at(i, j)); };
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      mesh.add_face(v(i, j), v(i + 1, j), v(i + 1, j + 1));
      mesh.add_face(v(i, j), v(i + 1, j + 1), v(i, j + 1));
    }
  return mesh;
}

void add_what_stages_leave(OpenMesh::TriMesh& mesh) {
  const auto k_min = provide_property(mesh, property::k_min), k_max = provide_property(mesh, property::k_max);
  const auto gamma_min = provide_property(mesh, property::gamma_min),
             gamma_max = provide_property(mesh, property::gamma_max);
  const auto uv = provide_property(mesh, property::uv);
  const auto stretch = provide_property(mesh, property::area_stretch);
  const auto tensor = provide_property(mesh, property::tensor2d);
  for (const auto v : mesh.vertices()) {
    const auto p = mesh.point(v);
    mesh.property(k_min, v) = -p[0];
    mesh.property(k_max, v) = 2 + p[0];
    mesh.property(gamma_min, v) = {1, 0, 0};
    mesh.property(gamma_max, v) = {0, 1, 0};
    mesh.property(uv, v) = {2 * p[0], p[1]};  // twice as wide, so that the plane is told from the surface
    mesh.property(stretch, v) = 1 + p[0];
    mesh.property(tensor, v) = {-1, 0, 2};
  }
  const SurfaceRef surface = mesh;
  const auto umbilic = provide_property(mesh, property::umbilic);
  const auto place = provide_property(mesh, property::umbilic_position);
  for (const auto f : mesh.faces()) mesh.property(umbilic, f) = 0;
  const auto put = [&](double x, double y, int sign) {
    const auto point = at(surface, x, y);
    mesh.property(umbilic, point.face) = sign;
    mesh.property(place, point.face) = point.barycentric;
  };
  put(0.75, 0.87, 1);
  put(0.25, 0.87, -1);
  LineNetwork network;
  Line min, max;
  min.kind = LineKind::min;
  max.kind = LineKind::max;
  constexpr int steps = 40;
  for (int k = 0; k <= steps; ++k) {
    min.points.push_back(at(surface, k / double(steps), 0.35));
    max.points.push_back(at(surface, 0.55, k / double(steps)));
  }
  network.lines = {min, max};
  network.isotropic_samples = {at(surface, 0.85, 0.16)};
  write_lines(surface, network);
  FeatureOptions features;
  for (int j = 0; j < cells; ++j) features.edges.emplace_back(vertex_at(2, j), vertex_at(2, j + 1));
  tag_features(surface, features);
}

/// A quad over the left half, with one corner lifted, and two triangles over the right half.
OpenMesh::PolyMesh make_result(const SurfaceRef& surface) {
  OpenMesh::PolyMesh mesh;
  const double places[6][2] = {{0, 0}, {0.5, 0}, {1, 0}, {1, 1}, {0.5, 1}, {0, 1}};
  const auto face = provide_property(mesh, property::source_face);
  const auto barycentric = provide_property(mesh, property::source_barycentric);
  const auto origin = provide_property(mesh, property::origin);
  std::vector<OpenMesh::VertexHandle> v;
  for (const auto& p : places) {
    v.push_back(mesh.add_vertex({p[0], p[1], v.size() == 5 ? 0.1 : 0}));
    const auto source = at(surface, p[0], p[1]);
    mesh.property(face, v.back()) = source.face.idx();
    mesh.property(barycentric, v.back()) = source.barycentric;
    mesh.property(origin, v.back()) =
        static_cast<int>(v.size() == 2 || v.size() == 5 ? Origin::crossing : Origin::corner);
  }
  mesh.add_face({v[0], v[1], v[4], v[5]});
  mesh.add_face({v[1], v[2], v[3]});
  mesh.add_face({v[1], v[3], v[4]});
  const auto kind = provide_property(mesh, property::edge_kind);
  for (const auto e : mesh.edges()) {
    const auto a = mesh.point(mesh.from_vertex_handle(mesh.halfedge_handle(e, 0)));
    const auto b = mesh.point(mesh.to_vertex_handle(mesh.halfedge_handle(e, 0)));
    const bool middle = a[0] == 0.5 && b[0] == 0.5;
    mesh.property(kind, e) = static_cast<int>(middle                ? EdgeKind::max
                                              : mesh.is_boundary(e) ? EdgeKind::border
                                                                    : EdgeKind::conforming);
  }
  return mesh;
}

}  // namespace

int main(int argc, char* argv[]) {
  if (argc != 3) {
    std::cerr << "known_surface SURFACE.om RESULT.om\n";
    return 2;
  }
  auto mesh = make_square();
  add_what_stages_leave(mesh);
  write_mesh(mesh, argv[1]);
  write_mesh(make_result(mesh), argv[2]);
}
