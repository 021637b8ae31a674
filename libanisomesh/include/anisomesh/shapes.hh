// Synthetic surfaces with known geometry, for tests, demos and first steps.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <string>
#include <vector>

#include "anisomesh/errors.hh"

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

/// Names that make_shape() knows: dome, squeezed-dome, saddle, octa-flower, half-torus, cylinder,
/// ellipsoid-cap, monkey-saddle, wave, plane, hemisphere.
std::vector<std::string> shape_names();

/// A disc-like surface made by code; creases of piecewise smooth shapes are tagged as features. \throw
/// InvalidOption
OpenMesh::TriMesh make_shape(const std::string& name, const ShapeOptions& options = {});

}  // namespace anisomesh
