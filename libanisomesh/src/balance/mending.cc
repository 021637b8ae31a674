#include "balance/mending.hh"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fit/fit_samples.hh"

namespace anisomesh::detail {

namespace {

constexpr int places_in_a_side = 3;  // of a triangle

}  // namespace

size_t count_marked(const std::vector<char>& marks) {
  return static_cast<size_t>(std::count(marks.begin(), marks.end(), 1));
}

FaceJudge::FaceJudge(const ReferenceSurface& reference, const OpenMesh::PolyMesh& before)
    : reference_(reference),
      convex_(count_marked(concave_faces(PolygonSoup(before, FaceDiagonal::shorter))) == 0) {}

std::vector<char> FaceJudge::broken(const PolygonSoup& faces) const {
  std::vector<char> result = folded_faces(reference_, faces);
  const auto add = [&](const std::vector<char>& others) {
    for (size_t f = 0; f < result.size(); ++f) result[f] |= others[f];
  };
  add(degenerate_faces(faces));
  if (convex_) add(concave_faces(faces));
  return result;
}

double FaceJudge::farthest(const PolygonSoup& faces) const {
  double squared = 0;
  for (const Triangle& t : faces.triangles)
    for_each_piece(places_in_a_side, [&](const Vec3d& w) {
      Vec3d place(0, 0, 0);
      for (size_t k = 0; k < 3; ++k)
        place += w[static_cast<int>(k)] * faces.points[static_cast<size_t>(t[k])];
      squared = std::max(squared, reference_.tree.closest(place).squared_distance);
    });
  return std::sqrt(squared);
}

Vec3d view_normal(const ReferenceSurface& reference, const PatchMesh& mesh, const PatchMesh::Patch& patch) {
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

std::vector<PatchMesh::Patch> patches_around(const PatchMesh& mesh, int face) {
  std::vector<PatchMesh::Patch> patches{mesh.join({face})};
  const std::vector<int> first = mesh.around(face);
  for (const int q : first) patches.push_back(mesh.join({face, q}));
  for (size_t i = 0; i < first.size(); ++i)
    for (size_t j = 0; j < i; ++j) patches.push_back(mesh.join({face, first[j], first[i]}));
  for (const int q : first)
    for (const int r : mesh.around(q))
      if (r != face) patches.push_back(mesh.join({face, q, r}));
  std::vector<PatchMesh::Patch> stars;
  for (const int v : mesh.polygons()[static_cast<size_t>(face)])
    if (auto star = mesh.star(v); !star.ring.empty()) stars.push_back(std::move(star));
  patches.insert(patches.end(), stars.begin(), stars.end());
  // What is left of a star may be too thin for a polygon of its own.
  for (const auto& star : stars) {
    std::vector<int> beside;
    for (const int p : star.polygons)
      for (const int q : mesh.around(p))
        if (std::find(star.polygons.begin(), star.polygons.end(), q) == star.polygons.end() &&
            std::find(beside.begin(), beside.end(), q) == beside.end())
          beside.push_back(q);
    for (const int q : beside) {
      std::vector<int> polygons = star.polygons;
      polygons.push_back(q);
      patches.push_back(mesh.join(polygons));
    }
  }
  return patches;
}

}  // namespace anisomesh::detail
