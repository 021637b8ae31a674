#include "unfold.hh"

#include <algorithm>

#include "anisomesh/properties.hh"
#include "compare_parts.hh"
#include "patch_mesh.hh"
#include "patch_partition.hh"

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

/// Seen along the reference's normals at the polygons and at what is around them.
Vec3d normal_of(const ReferenceSurface& reference, const PatchMesh& mesh, const PatchMesh::Patch& patch) {
  Vec3d sum(0, 0, 0);
  const auto add = [&](const Vec3d& p) {
    sum += reference.normals[static_cast<size_t>(reference.tree.closest(p).triangle)];
  };
  for (const int v : patch.ring) add(mesh.point(v));
  for (const int p : patch.polygons) {
    const auto& polygon = mesh.polygons()[static_cast<size_t>(p)];
    Vec3d middle(0, 0, 0);
    for (const int v : polygon) middle += mesh.point(v) / static_cast<double>(polygon.size());
    add(middle);
  }
  const double length = sum.norm();
  return length > 0 ? sum / length : sum;
}

bool is_folded(const ReferenceSurface& reference, const std::vector<Vec3d>& ring,
               const std::vector<std::vector<int>>& pieces) {
  OpenMesh::PolyMesh mesh;
  for (const Vec3d& p : ring) mesh.add_vertex(p);
  for (const auto& piece : pieces) {
    std::vector<OpenMesh::VertexHandle> corners;
    for (const int i : piece) corners.emplace_back(i);
    mesh.add_face(corners);
  }
  return mesh.n_faces() != pieces.size() || count(folds_of(reference, mesh)) > 0;
}

/// Parts a patch into as few triangles as can be, so that none of the pieces is folded.
bool part_anew(const ReferenceSurface& reference, const PatchMesh::Patch& patch, PatchMesh& mesh) {
  const size_t n = patch.ring.size();
  if (n < 3 || n > most_corners) return false;
  std::vector<Vec3d> ring;
  for (const int v : patch.ring) ring.push_back(mesh.point(v));
  PatchCosts costs;
  costs.triangle = 1;
  const PatchView view(normal_of(reference, mesh, patch), {}, Vec6d(0, 0, 0, 0, 0, 0), costs);
  PatchPieces found = partition_ring(view, ring, mesh.forbidden_chords(patch));
  if (found.pieces.empty() || is_folded(reference, ring, found.pieces)) return false;
  for (auto& piece : found.pieces)
    for (int& i : piece) i = patch.ring[static_cast<size_t>(i)];
  if (!mesh.may_replace(patch, found.pieces)) return false;
  mesh.replace(patch, found.pieces);
  return true;
}

/// A folded face with one, then two of its neighbours; at last without one of its corners.
std::vector<PatchMesh::Patch> patches_around(const PatchMesh& mesh, int face) {
  std::vector<PatchMesh::Patch> patches;
  const std::vector<int> first = mesh.around(face);
  for (const int q : first) patches.push_back(mesh.join({face, q}));
  for (size_t i = 0; i < first.size(); ++i)
    for (size_t j = 0; j < i; ++j) patches.push_back(mesh.join({face, first[j], first[i]}));
  for (const int q : first)
    for (const int r : mesh.around(q))
      if (r != face) patches.push_back(mesh.join({face, q, r}));
  for (const int v : mesh.polygons()[static_cast<size_t>(face)]) patches.push_back(mesh.star(v));
  return patches;
}

/// Folds that stay wherever their corners go: polygons that were put together wrongly.
OpenMesh::PolyMesh parted_anew(const ReferenceSurface& reference, const OpenMesh::PolyMesh& result,
                               const std::vector<char>& folded) {
  PatchMesh mesh(result);
  for (size_t f = 0; f < folded.size(); ++f) {
    if (!folded[f] || mesh.polygons()[f].empty()) continue;
    for (const PatchMesh::Patch& patch : patches_around(mesh, static_cast<int>(f)))
      if (part_anew(reference, patch, mesh)) break;
  }
  return mesh.mesh();
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
  if (count(folded) == 0) return 0;
  auto parted = parted_anew(reference, mesh, folded);
  const size_t left = count(folds_of(reference, parted));
  if (left >= count(folded)) return count(folded);
  mesh = std::move(parted);
  return left;
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
