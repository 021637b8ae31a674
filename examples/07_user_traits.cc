// A mesh of your own making: Eigen vectors as points, your own data at the vertices, before and after.
// Eigen's vectors as points: this header wants the first one in front and the meshes behind it.
#include <OpenMesh/Core/Utils/vector_traits.hh>
//
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>
//
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <anisomesh/properties.hh>
#include <anisomesh/remesh.hh>
#include <cmath>
#include <cstdio>

struct MyTraits : OpenMesh::DefaultTraits {
  using Point = Eigen::Vector3d;
  using Normal = Eigen::Vector3d;
  VertexTraits { float temperature = 20; };
};
using MyTriMesh = OpenMesh::TriMesh_ArrayKernelT<MyTraits>;
using MyPolyMesh = OpenMesh::PolyMesh_ArrayKernelT<MyTraits>;

// A corrugated sheet of n x n vertices.
MyTriMesh make_sheet(int n) {
  MyTriMesh mesh;
  const auto vertex = [n](int i, int j) { return OpenMesh::VertexHandle(i * n + j); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = 4.0 * i / (n - 1), y = 3.0 * j / (n - 1);
      mesh.add_vertex({x, y, 0.3 * std::sin(2 * x) + 0.1 * y * y});
    }
  for (int i = 0; i + 1 < n; ++i)
    for (int j = 0; j + 1 < n; ++j) {
      mesh.add_face(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
      mesh.add_face(vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
  return mesh;
}

int main() {
  MyTriMesh mesh = make_sheet(60);
  for (const auto v : mesh.vertices()) mesh.data(v).temperature = 20 + static_cast<float>(mesh.point(v)[0]);

  anisomesh::RemeshOptions options;
  options.fit.enabled = false;
  const OpenMesh::PolyMesh result = anisomesh::remesh(mesh, options);

  // Without the fit every vertex of the result is a point of the input: what you know at its vertices, you
  // know there.
  const auto source_face = anisomesh::require_property(result, anisomesh::property::source_face);
  const auto source_barycentric =
      anisomesh::require_property(result, anisomesh::property::source_barycentric);
  const anisomesh::SurfaceRef surface = mesh;
  MyPolyMesh mine;
  for (const auto v : result.vertices()) {
    const auto& p = result.point(v);
    const auto copy = mine.add_vertex({p[0], p[1], p[2]});
    const auto corners = surface.corners(OpenMesh::FaceHandle(result.property(source_face, v)));
    double temperature = 0;
    for (int k = 0; k < 3; ++k)
      temperature += result.property(source_barycentric, v)[k] * mesh.data(corners.vertex[k]).temperature;
    mine.data(copy).temperature = static_cast<float>(temperature);
  }
  for (const auto f : result.faces()) {
    std::vector<OpenMesh::VertexHandle> corners;
    for (const auto v : f.vertices()) corners.push_back(v);
    mine.add_face(corners);
  }
  std::printf("%zu triangles became %zu polygons\n", mesh.n_faces(), mine.n_faces());

  double worst = 0;
  for (const auto v : mine.vertices())
    worst = std::max(worst, std::abs(mine.data(v).temperature - 20 - mine.point(v)[0]));
  return mine.n_faces() > 0 && worst < 1e-4 ? 0 : 1;
}
