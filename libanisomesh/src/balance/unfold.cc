#include "balance/unfold.hh"

#include <algorithm>
#include <limits>

#include "anisomesh/properties.hh"
#include "balance/border_twins.hh"
#include "balance/mending.hh"
#include "balance/patch_partition.hh"
#include "balance/uncross.hh"

namespace anisomesh::detail {

namespace {

constexpr int max_rounds = 4;

/// The corners of broken faces, half way back to where they were built from. Not the whole way: two vertices
/// may have been built from one place.
OpenMesh::PolyMesh with_corners_back(const SurfaceRef& surface, const OpenMesh::PolyMesh& mesh,
                                     const std::vector<char>& broken) {
  const auto face = require_property(mesh, property::source_face);
  const auto barycentric = require_property(mesh, property::source_barycentric);
  OpenMesh::PolyMesh result = mesh;
  for (const auto f : result.faces()) {
    if (!broken[static_cast<size_t>(f.idx())]) continue;
    for (const auto v : f.vertices()) {
      const SurfacePoint source{OpenMesh::FaceHandle(mesh.property(face, v)), mesh.property(barycentric, v)};
      result.set_point(v, 0.5 * (mesh.point(v) + position(surface, source)));
    }
  }
  for (const auto& group : border_twins(mesh)) {
    const auto moved = std::find_if(group.begin(), group.end(), [&](int v) {
      return result.point(OpenMesh::VertexHandle(v)) != mesh.point(OpenMesh::VertexHandle(v));
    });
    if (moved == group.end()) continue;
    const Vec3d to = result.point(OpenMesh::VertexHandle(*moved));
    for (const int v : group) result.set_point(OpenMesh::VertexHandle(v), to);
  }
  return result;
}

bool is_broken(const FaceJudge& judge, const std::vector<Vec3d>& ring,
               const std::vector<std::vector<int>>& pieces) {
  OpenMesh::PolyMesh mesh;
  for (const Vec3d& p : ring) mesh.add_vertex(p);
  for (const auto& piece : pieces) {
    std::vector<OpenMesh::VertexHandle> corners;
    corners.reserve(piece.size());
    for (const int i : piece) corners.emplace_back(i);
    mesh.add_face(corners);
  }
  return mesh.n_faces() != pieces.size() || count_marked(judge.broken(mesh)) > 0;
}

/// Parts a patch into as few triangles as can be, so that none of the pieces is broken.
bool part_anew(const FaceJudge& judge, const PatchMesh::Patch& patch, PatchMesh& mesh) {
  const size_t n = patch.ring.size();
  if (n < 3 || n > most_corners) return false;
  std::vector<Vec3d> ring;
  for (const int v : patch.ring) ring.push_back(mesh.point(v));
  PatchCosts costs;
  costs.triangle = 1;
  const PatchView view(view_normal(judge.reference(), mesh, patch), {}, Vec6d(0, 0, 0, 0, 0, 0), costs);
  PatchPieces found = partition_ring(view, ring, mesh.forbidden_chords(patch));
  if (found.pieces.empty() || is_broken(judge, ring, found.pieces)) return false;
  for (auto& piece : found.pieces)
    for (int& i : piece) i = patch.ring[static_cast<size_t>(i)];
  if (!mesh.may_replace(patch, found.pieces)) return false;
  mesh.replace(patch, found.pieces);
  return true;
}

/// Faces that stay broken wherever their corners go: polygons that were put together wrongly.
OpenMesh::PolyMesh parted_anew(const FaceJudge& judge, const OpenMesh::PolyMesh& result,
                               const std::vector<char>& broken) {
  PatchMesh mesh(result);
  for (size_t f = 0; f < broken.size(); ++f) {
    if (!broken[f] || mesh.polygons()[f].empty()) continue;
    for (const PatchMesh::Patch& patch : patches_around(mesh, static_cast<int>(f)))
      if (part_anew(judge, patch, mesh)) break;
  }
  return mesh.mesh();
}

/// \return how many broken faces are left
size_t mend(const SurfaceRef& surface, const FaceJudge& judge, OpenMesh::PolyMesh& mesh) {
  auto broken = judge.broken(mesh);
  const auto take = [&](OpenMesh::PolyMesh&& other, bool or_as_many) {
    auto after = judge.broken(other);
    if (count_marked(after) + (or_as_many ? 0 : 1) > count_marked(broken)) return false;
    mesh = std::move(other);
    broken = std::move(after);
    return true;
  };
  for (int round = 0; round < max_rounds && count_marked(broken) > 0; ++round)
    if (!take(with_corners_back(surface, mesh, broken), true)) break;
  while (count_marked(broken) > 0 && take(parted_anew(judge, mesh, broken), false)) {
  }
  return count_marked(broken);
}

}  // namespace

int choose_unfolded(const SurfaceRef& surface, const ReferenceSurface& reference,
                    std::vector<OpenMesh::PolyMesh>& candidates) {
  const FaceJudge judge(reference, candidates.front());
  int best = -1;
  size_t least = std::numeric_limits<size_t>::max();
  for (int i = static_cast<int>(candidates.size()) - 1; i >= 0 && least > 0; --i) {
    const size_t left = mend(surface, judge, candidates[static_cast<size_t>(i)]);
    if (left < least) best = i, least = left;
  }
  uncross(surface, judge, candidates[static_cast<size_t>(best)]);
  return best;
}

}  // namespace anisomesh::detail
