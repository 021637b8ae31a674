// What is wrong with faces of a finished result, and the patches in which that may be mended.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>
#include <vector>

#include "balance/patch_mesh.hh"
#include "compare/compare_parts.hh"

namespace anisomesh::detail {

size_t count_marked(const std::vector<char>& marks);

/// Says which faces are folded or without area, as compare() judges it, or concave.
class FaceJudge {
 public:
  /// \param before whose polygons may be concave where it has such
  /// \param reference kept
  FaceJudge(const ReferenceSurface& reference, const OpenMesh::PolyMesh& before);

  const ReferenceSurface& reference() const { return reference_; }
  std::vector<char> broken(const PolygonSoup& faces) const;
  std::vector<char> broken(const OpenMesh::PolyMesh& mesh) const {
    return broken(PolygonSoup(mesh, FaceDiagonal::shorter));
  }
  /// Largest distance of places in the faces from the surface, model units.
  double farthest(const PolygonSoup& faces) const;

 private:
  const ReferenceSurface& reference_;
  bool convex_;
};

/// Along the reference's normals at the polygons of a patch and at what is around them.
Vec3d view_normal(const ReferenceSurface& reference, const PatchMesh& mesh, const PatchMesh::Patch& patch);

/// A face alone, with one, then two of its neighbours; at last without one of its corners, and this with one
/// polygon beside.
std::vector<PatchMesh::Patch> patches_around(const PatchMesh& mesh, int face);

}  // namespace anisomesh::detail
