// Synthetic surfaces with known geometry, for tests, demos and first steps.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <functional>
#include <string>
#include <vector>

#include "anisomesh/errors.hh"
#include "anisomesh/surface.hh"

namespace anisomesh {

struct ShapeOptions {
  int vertices = 5000;     ///< about how many vertices; >= 9
  bool irregular = false;  ///< jittered sampling and Delaunay connectivity in the parameter plane instead of
                           ///< a regular grid
  double noise =
      0;  ///< standard deviation of Gaussian noise along the normal, fraction of the diagonal; >= 0
  unsigned seed = 1;      ///< of sampling and noise
  void validate() const;  ///< \throw InvalidOption
};

/// Names that make_shape() knows: the discs, then the closed ones.
std::vector<std::string> shape_names();
/// dome, squeezed-dome, saddle, octa-flower, half-torus, cylinder, ellipsoid-cap, monkey-saddle, wave, plane,
/// hemisphere.
std::vector<std::string> disc_shape_names();
/// sphere, ellipsoid, torus, cube.
std::vector<std::string> closed_shape_names();

/// A surface made by code, with vertex, edge and face status; the creases of octa-flower and cube are tagged
/// as features. docs/shapes.md has the formula of each. \throw InvalidOption
OpenMesh::TriMesh make_shape(const std::string& name, const ShapeOptions& options = {});

/// A surface given by a formula over a rectangle or the unit disc; its normal is x_u cross x_v.
struct ParametricPatch {
  std::function<Vec3d(double u, double v)> position;  ///< of u and v; over the disc, Cartesian
  enum class Domain { rectangle, disc } domain = Domain::rectangle;
  double u_min = 0, u_max = 1, v_min = 0, v_max = 1;  ///< the rectangle; the disc is the unit disc
  /// Disc only: so many rays from the centre, the first along +u, are creases (0 or >= 3).
  int crease_rays = 0;
};

/// Meshes a patch with about so many vertices of about equal spacing; a vertex lies on each crease ray's
/// ends. \param parameters where given, gets (u, v) of each vertex \throw InvalidOption
OpenMesh::TriMesh mesh_patch(const ParametricPatch& patch, const ShapeOptions& options = {},
                             std::vector<Vec2d>* parameters = nullptr);

}  // namespace anisomesh
