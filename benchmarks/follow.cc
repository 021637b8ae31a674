// Lines along the direction of minimum absolute curvature against lines of curvature.
//
//   follow [VERTICES]
//
// With ANISOMESH_DATA=FOLDER (see data.hh) scans too. Each result is measured twice: its quads split along
// the shorter diagonal, as the ruler takes them, and as the bilinear patches that [D'Azevedo 2000] speaks of.
#include <string>
#include <vector>

#include "anisomesh/remesh.hh"
#include "anisomesh/shapes.hh"
#include "bench.hh"
#include "hyperboloid.hh"

using namespace anisomesh;

namespace {

constexpr int pieces = 8;  // of the sides of a quad, where it is a bilinear patch

/// The quads as bilinear patches, in triangles; all other polygons as they are.
OpenMesh::PolyMesh bilinear(const OpenMesh::PolyMesh& mesh) {
  OpenMesh::PolyMesh fine;
  for (const auto f : mesh.faces()) {
    std::vector<Vec3d> p;
    for (const auto v : f.vertices()) p.push_back(mesh.point(v));
    if (p.size() != 4) {
      std::vector<OpenMesh::VertexHandle> corners;
      for (const Vec3d& x : p) corners.push_back(fine.add_vertex(x));
      fine.add_face(corners);
      continue;
    }
    std::vector<OpenMesh::VertexHandle> grid;
    for (int j = 0; j <= pieces; ++j)
      for (int i = 0; i <= pieces; ++i) {
        const double s = static_cast<double>(i) / pieces, t = static_cast<double>(j) / pieces;
        grid.push_back(
            fine.add_vertex((1 - t) * ((1 - s) * p[0] + s * p[1]) + t * ((1 - s) * p[3] + s * p[2])));
      }
    const auto at = [&](int i, int j) { return grid[static_cast<size_t>(j * (pieces + 1) + i)]; };
    for (int j = 0; j < pieces; ++j)
      for (int i = 0; i < pieces; ++i) {
        fine.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
        fine.add_face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
      }
  }
  return fine;
}

void compare_both(const std::string& name, const OpenMesh::TriMesh& input, size_t vertices) {
  bench::Ruler ruler(input);
  for (const bool fitted : {false, true})
    for (const Follow follow : {Follow::curvature, Follow::min_abs}) {
      OpenMesh::TriMesh mesh = input;
      RemeshOptions options;
      options.target_vertices = vertices;
      options.trace.follow = follow;
      options.fit.enabled = fitted;
      auto result = remesh(mesh, options);
      const Comparison c = ruler(result);
      auto patches = bilinear(result);
      const Comparison as_patches = ruler(patches);
      std::printf(
          "| %s | %s%s | %zu | %.4f | %.4f | %.3f | %.2f | %.1f | %zu |\n", name.c_str(),
          follow == Follow::min_abs ? "min-abs" : "curvature", fitted ? ", fit" : "", c.vertices,
          100 * c.two_sided.rms, 100 * as_patches.two_sided.rms, 100 * c.two_sided.hausdorff,
          c.mean_normal_deviation_degrees, 100 * c.quad_fraction,
          c.folded_faces + c.concave_faces + c.non_manifold_edges + c.non_manifold_vertices + c.t_junctions);
      std::fflush(stdout);
    }
}

}  // namespace

int main(int argc, char** argv) {
  const auto vertices = static_cast<size_t>(argc > 1 ? std::stoul(argv[1]) : 1000);
  ShapeOptions shape;
  shape.vertices = 20000;
  std::printf(
      "| input | lines | vertices | rms %% | rms %% as bilinear patches | hausdorff %% | normal | quads %% | "
      "folded, "
      "concave, not manifold |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const char* name : {"saddle", "wave", "torus"}) compare_both(name, make_shape(name, shape), vertices);
  compare_both("hyperboloid", mesh_patch(half_hyperboloid(), shape), vertices);
  for (const char* name : {"lion-head", "bunny00"})
    if (const auto path = demo_mesh(std::string(name) + ".off"))
      compare_both(name, read_surface(*path), 2 * vertices);
}
