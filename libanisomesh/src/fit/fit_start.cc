// Where the samples of the input are first looked for: one polygon for each face, and more in large faces.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "fit/fit_matching.hh"
#include "fit/fit_samples.hh"

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

}  // namespace

// Of the polygons at some vertices, on whatever side of features, the one beside a face of the input.
int FitMatching::best_at(const int* begin, const int* end, OpenMesh::FaceHandle face,
                         const FitTriangles& triangles, const std::vector<Vec3d>& points) const {
  const Vec3d centre = centre_of(face);
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (const int* v = begin; v != end; ++v)
    for (int i = mesh_.first_polygon[at(*v)]; i < mesh_.first_polygon[at(*v) + 1]; ++i) {
      const int p = mesh_.polygons[at(i)];
      if (best < 0) best = p;
      for (int t = triangles.first[at(p)]; t < triangles.first[at(p) + 1]; ++t) {
        const double cosine = triangles.normal[at(t)] | input_.normal[at(face.idx())];
        if (!(cosine > 0)) continue;
        const Triangle& c = triangles.corner[at(t)];
        const Vec3d &x = points[at(c[0])], &y = points[at(c[1])], &z = points[at(c[2])];
        const Vec3d w = closest_barycentric(centre, x, y, z);
        // What faces the same way comes first where both are near.
        const double squared = (w[0] * x + w[1] * y + w[2] * z - centre).sqrnorm() / (cosine * cosine);
        if (is_nearer(squared, least, triangles.radius[at(p)])) least = squared, best = p;
      }
    }
  return best;
}

Vec3d FitMatching::centre_of(OpenMesh::FaceHandle face) const {
  const auto c = surface_.corners(face);
  return (surface_.point(c.vertex[0]) + surface_.point(c.vertex[1]) + surface_.point(c.vertex[2])) / 3.0;
}

// Every face gets a polygon to start from, handed on from face to face from those the vertices lie in, the
// nearest match first: what came around the end of a feature to the wrong side of it is far from its faces,
// and comes too late. Across a feature the polygons on the other side of it are looked at.
std::vector<int> FitMatching::flood(const FitTriangles& triangles, const std::vector<Vec3d>& points) const {
  struct Front {
    double key = 0;
    int face = -1, polygon = -1;
    bool operator<(const Front& o) const {  // a heap has the largest on top
      return key != o.key ? key > o.key : face != o.face ? face > o.face : polygon > o.polygon;
    }
  };
  const auto& mesh = surface_.connectivity();
  std::vector<int> polygon(mesh.n_faces(), -1);
  std::vector<char> well(mesh.n_faces(), 0);  // waits with a match that is near for its size
  std::vector<Front> fronts;
  const auto push = [&](OpenMesh::FaceHandle face, int start) {
    if (start < 0 || well[at(face.idx())]) return;
    FitPair pair;
    const Vec3d& normal = input_.normal[at(face.idx())];
    if (!nearest(centre_of(face), normal, triangles, points, start, pair)) return;
    const double cosine = std::max(least_cosine, triangles.normal[at(pair.triangle)] | normal);
    fronts.push_back({pair.distance / cosine, face.idx(), start});
    std::push_heap(fronts.begin(), fronts.end());
    well[at(face.idx())] = pair.distance / cosine < near_match * triangles.radius[at(start)];
  };
  for (int v = 0; v < mesh_.n_vertices; ++v)
    push(sources_[at(v)], best_at(&v, &v + 1, sources_[at(v)], triangles, points));
  while (!fronts.empty()) {
    std::pop_heap(fronts.begin(), fronts.end());
    const Front front = fronts.back();
    fronts.pop_back();
    if (polygon[at(front.face)] >= 0) continue;
    polygon[at(front.face)] = front.polygon;
    for (const auto h : mesh.fh_range(OpenMesh::FaceHandle(front.face))) {
      const auto beside = mesh.face_handle(mesh.opposite_halfedge_handle(h));
      if (!beside.is_valid() || polygon[at(beside.idx())] >= 0) continue;
      const bool wall = mesh.has_edge_status() && mesh.status(mesh.edge_handle(h)).feature();
      push(beside,
           wall ? best_at(mesh_.begin(front.polygon), mesh_.end(front.polygon), beside, triangles, points)
                : front.polygon);
    }
  }
  return polygon;
}

// Where a face holds many samples and polygons, from its one polygon downhill may end at the rim of a hole
// between them: each sample also looks from the nearest vertex that comes from its face.
void FitMatching::start_in_large_faces(const std::vector<int>& first_sample, const FitTriangles& triangles,
                                       const std::vector<Vec3d>& points) {
  std::vector<std::vector<int>> vertices(first_sample.size() - 1);
  for (int v = 0; v < mesh_.n_vertices; ++v)
    if (mesh_.first_polygon[at(v)] < mesh_.first_polygon[at(v) + 1])
      vertices[at(sources_[at(v)].idx())].push_back(v);
  tbb::parallel_for(size_t{0}, vertices.size(), [&](size_t f) {
    if (vertices[f].empty() || first_sample[f + 1] - first_sample[f] < 2) return;
    for (int i = first_sample[f]; i < first_sample[f + 1]; ++i) {
      Sample& sample = samples_[at(i)];
      const int v = *std::min_element(vertices[f].begin(), vertices[f].end(), [&](int a, int b) {
        return is_nearer((points[at(a)] - sample.place).sqrnorm(), (points[at(b)] - sample.place).sqrnorm(),
                         0);
      });
      int other = best_at(&v, &v + 1, OpenMesh::FaceHandle(sample.face), triangles, points);
      FitPair from_face, from_vertex;
      const Vec3d& normal = input_.normal[f];
      const bool known =
          sample.polygon >= 0 && nearest(sample.place, normal, triangles, points, sample.polygon, from_face);
      if (other >= 0 && nearest(sample.place, normal, triangles, points, other, from_vertex) &&
          (!known || is_nearer(from_vertex.distance, from_face.distance, 0)))
        sample.polygon = other;
    }
  });
}

}  // namespace anisomesh::detail
