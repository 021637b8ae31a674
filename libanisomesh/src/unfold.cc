#include "unfold.hh"

#include <algorithm>

#include "anisomesh/properties.hh"
#include "compare_parts.hh"

namespace anisomesh::detail {

namespace {

constexpr int max_rounds = 4;

size_t count(const std::vector<char>& folded) {
  return static_cast<size_t>(std::count(folded.begin(), folded.end(), 1));
}

/// The corners of folded faces, half way back to where they were built from. Not the whole way: two vertices
/// may have been built from one place.
OpenMesh::PolyMesh with_corners_back(const SurfaceRef& surface, const OpenMesh::PolyMesh& mesh,
                                     const std::vector<char>& folded) {
  const auto face = require_property(mesh, property::source_face);
  const auto barycentric = require_property(mesh, property::source_barycentric);
  OpenMesh::PolyMesh result = mesh;
  for (const auto f : result.faces()) {
    if (!folded[static_cast<size_t>(f.idx())]) continue;
    for (const auto v : f.vertices()) {
      const SurfacePoint source{OpenMesh::FaceHandle(mesh.property(face, v)), mesh.property(barycentric, v)};
      result.set_point(v, 0.5 * (mesh.point(v) + position(surface, source)));
    }
  }
  return result;
}

std::vector<char> folds_of(const ReferenceSurface& reference, const OpenMesh::PolyMesh& mesh) {
  return folded_faces(reference, PolygonSoup(mesh, FaceDiagonal::shorter));
}

/// \return how many folds are left
size_t unfold(const SurfaceRef& surface, const ReferenceSurface& reference, OpenMesh::PolyMesh& mesh) {
  auto folded = folds_of(reference, mesh);
  for (int round = 0; round < max_rounds && count(folded) > 0; ++round) {
    auto moved = with_corners_back(surface, mesh, folded);
    auto after = folds_of(reference, moved);
    if (count(after) > count(folded)) break;
    mesh = std::move(moved);
    folded = std::move(after);
  }
  return count(folded);
}

}  // namespace

int choose_unfolded(const SurfaceRef& surface, const OpenMesh::PolyMesh& before,
                    std::vector<OpenMesh::PolyMesh>& candidates) {
  const ReferenceSurface reference(surface);
  const auto allowed = [&] { return count(folds_of(reference, before)); };
  for (int i = static_cast<int>(candidates.size()) - 1; i >= 0; --i) {
    const size_t folds = unfold(surface, reference, candidates[static_cast<size_t>(i)]);
    if (folds == 0 || folds <= allowed()) return i;
  }
  return -1;
}

}  // namespace anisomesh::detail
