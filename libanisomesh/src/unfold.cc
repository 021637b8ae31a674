#include "unfold.hh"

#include <algorithm>
#include <limits>

#include "anisomesh/properties.hh"
#include "compare_parts.hh"
#include "patch_mesh.hh"
#include "patch_partition.hh"

namespace anisomesh::detail {

namespace {

constexpr int max_rounds = 4;

size_t count(const std::vector<char>& marked) {
  return static_cast<size_t>(std::count(marked.begin(), marked.end(), 1));
}

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
  return result;
}

std::vector<char> concave_faces_of(const OpenMesh::PolyMesh& mesh) {
  return concave_faces(PolygonSoup(mesh, FaceDiagonal::shorter));
}

/// Says which faces are folded or without area, as compare() judges it, or concave.
class FaceJudge {
 public:
  /// \param before whose polygons may be concave where it has such
  FaceJudge(const ReferenceSurface& reference, const OpenMesh::PolyMesh& before)
      : reference_(reference), convex_(count(concave_faces_of(before)) == 0) {}

  const ReferenceSurface& reference() const { return reference_; }
  std::vector<char> broken(const OpenMesh::PolyMesh& mesh) const {
    const PolygonSoup soup(mesh, FaceDiagonal::shorter);
    std::vector<char> result = folded_faces(reference_, soup);
    const auto add = [&](const std::vector<char>& others) {
      for (size_t f = 0; f < result.size(); ++f) result[f] |= others[f];
    };
    add(degenerate_faces(soup));
    if (convex_) add(concave_faces(soup));
    return result;
  }

 private:
  const ReferenceSurface& reference_;
  bool convex_;
};

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

bool is_broken(const FaceJudge& judge, const std::vector<Vec3d>& ring,
               const std::vector<std::vector<int>>& pieces) {
  OpenMesh::PolyMesh mesh;
  for (const Vec3d& p : ring) mesh.add_vertex(p);
  for (const auto& piece : pieces) {
    std::vector<OpenMesh::VertexHandle> corners;
    for (const int i : piece) corners.emplace_back(i);
    mesh.add_face(corners);
  }
  return mesh.n_faces() != pieces.size() || count(judge.broken(mesh)) > 0;
}

/// Parts a patch into as few triangles as can be, so that none of the pieces is broken.
bool part_anew(const FaceJudge& judge, const PatchMesh::Patch& patch, PatchMesh& mesh) {
  const size_t n = patch.ring.size();
  if (n < 3 || n > most_corners) return false;
  std::vector<Vec3d> ring;
  for (const int v : patch.ring) ring.push_back(mesh.point(v));
  PatchCosts costs;
  costs.triangle = 1;
  const PatchView view(normal_of(judge.reference(), mesh, patch), {}, Vec6d(0, 0, 0, 0, 0, 0), costs);
  PatchPieces found = partition_ring(view, ring, mesh.forbidden_chords(patch));
  if (found.pieces.empty() || is_broken(judge, ring, found.pieces)) return false;
  for (auto& piece : found.pieces)
    for (int& i : piece) i = patch.ring[static_cast<size_t>(i)];
  if (!mesh.may_replace(patch, found.pieces)) return false;
  mesh.replace(patch, found.pieces);
  return true;
}

/// A broken face alone, with one, then two of its neighbours; at last without one of its corners.
std::vector<PatchMesh::Patch> patches_around(const PatchMesh& mesh, int face) {
  std::vector<PatchMesh::Patch> patches{mesh.join({face})};
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
    if (count(after) + (or_as_many ? 0 : 1) > count(broken)) return false;
    mesh = std::move(other);
    broken = std::move(after);
    return true;
  };
  for (int round = 0; round < max_rounds && count(broken) > 0; ++round)
    if (!take(with_corners_back(surface, mesh, broken), true)) break;
  while (count(broken) > 0 && take(parted_anew(judge, mesh, broken), false)) {
  }
  return count(broken);
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
  return best;
}

}  // namespace anisomesh::detail
