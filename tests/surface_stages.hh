// The stages before tracing, on the surface itself.
#pragma once

#include <string>

#include "anisomesh/curvature.hh"
#include "anisomesh/shapes.hh"
#include "anisomesh/smoothing.hh"
#include "anisomesh/umbilics.hh"

namespace on_surface {

using namespace anisomesh;

inline void prepare(OpenMesh::TriMesh& mesh) {
  estimate_curvature(mesh);
  smooth_tensors(mesh);
  find_umbilics(mesh);
}

inline OpenMesh::TriMesh shape(const std::string& name, int vertices, bool irregular = true) {
  ShapeOptions options;
  options.vertices = vertices;
  options.irregular = irregular;
  auto mesh = make_shape(name, options);
  prepare(mesh);
  return mesh;
}

inline long euler(const OpenMesh::TriMesh& mesh) {
  return static_cast<long>(mesh.n_vertices()) - static_cast<long>(mesh.n_edges()) +
         static_cast<long>(mesh.n_faces());
}

}  // namespace on_surface
