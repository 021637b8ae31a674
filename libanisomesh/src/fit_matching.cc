#include "fit_matching.hh"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "anisomesh/properties.hh"

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

constexpr double input_samples = 12, result_samples = 6;  // for each triangle of the result, at least
constexpr double inside = 2.5;  // distances: a foot as far from all sides needs no closer look
constexpr double least_cosine = 0.05, near_match = 0.1;
constexpr int starts = 6;          // places to look from, for a sample of the result
constexpr int max_divisions = 24;  // of the sides of one triangle
constexpr double tiny = 1e-9;      // of the diagonal: nearer than this there is no direction

Vec3d area_vector(const SurfaceRef& surface, OpenMesh::FaceHandle face) {
  const auto c = surface.corners(face);
  const Vec3d& a = surface.point(c.vertex[0]);
  return cross(surface.point(c.vertex[1]) - a, surface.point(c.vertex[2]) - a);
}

/// Calls `visit` with the barycentric coordinates of the centres of n * n equal pieces.
template <class Visit>
void for_each_piece(int n, Visit visit) {
  const double step = 1.0 / n;
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j) {
      const double u = (i + 1.0 / 3) * step, v = (j + 1.0 / 3) * step;
      visit(Vec3d(1 - u - v, u, v));
      if (i + j + 1 >= n) continue;
      const double s = (i + 2.0 / 3) * step, t = (j + 2.0 / 3) * step;
      visit(Vec3d(1 - s - t, s, t));
    }
}

int divisions(double area, double share) {
  return std::clamp(static_cast<int>(std::ceil(std::sqrt(area / share))), 1, max_divisions);
}

// Whether no neighbour can be nearer: the foot is so far inside that only one bent over it would be.
bool is_surely_inside(const FitTriangles& triangles, int t, const Vec3d& barycentric, double squared) {
  const Vec3d& height = triangles.height[at(t)];
  const double margin =
      std::min({barycentric[0] * height[0], barycentric[1] * height[1], barycentric[2] * height[2]});
  return margin * margin > inside * inside * squared;
}

}  // namespace

FitInput::FitInput(const SurfaceRef& surface) : locator(surface) {
  const auto& mesh = surface.connectivity();
  for (const auto f : mesh.faces()) {
    const Vec3d n = area_vector(surface, f);
    const double twice = n.norm();
    normal.push_back(twice > 0 ? n / twice : Vec3d(0, 0, 0));
    area.push_back(0.5 * twice);
  }
  if (has_property(mesh, property::follow))
    follow = static_cast<Follow>(mesh.property(require_property(mesh, property::follow)));
  if (!has_property(mesh, property::tensor)) return;
  const auto of_vertex = require_property(mesh, property::tensor);
  for (const auto f : mesh.faces()) {
    tensor.emplace_back(0.0);
    for (const auto v : surface.corners(f).vertex) tensor.back() += mesh.property(of_vertex, v) / 3.0;
  }
}

FitMatching::FitMatching(const SurfaceRef& surface, const FitInput& input, const FitMesh& mesh,
                         const std::vector<OpenMesh::FaceHandle>& sources, const FitTriangles& triangles,
                         const std::vector<Vec3d>& points)
    : surface_(surface),
      input_(input),
      mesh_(mesh),
      sources_(sources),
      n_triangles_(triangles.corner.size()) {
  place_samples();
  flood(sources, triangles, points);
}

void FitMatching::place_samples() {
  const auto& mesh = surface_.connectivity();
  double total = 0;
  for (const double area : input_.area) total += area;
  const double share = total / (input_samples * static_cast<double>(n_triangles_));
  for (const auto f : mesh.faces()) {
    first_sample_.push_back(static_cast<int>(samples_.size()));
    if (!(input_.area[at(f.idx())] > 0)) continue;
    const auto c = surface_.corners(f);
    const int n = divisions(input_.area[at(f.idx())], share);
    for_each_piece(n, [&](const Vec3d& b) {
      Sample sample;
      for (size_t k = 0; k < 3; ++k) sample.place += b[k] * surface_.point(c.vertex[k]);
      sample.face = f.idx();
      sample.weight = input_.area[at(f.idx())] / (n * n * total);
      samples_.push_back(sample);
    });
  }
  first_sample_.push_back(static_cast<int>(samples_.size()));
}

// Goes from polygon to polygon as long as there is a nearer one that faces the same way.
bool FitMatching::nearest(const Vec3d& place, const Vec3d& normal, const FitTriangles& triangles,
                          const std::vector<Vec3d>& points, int& polygon, FitPair& pair) const {
  double best = std::numeric_limits<double>::infinity();
  int found = polygon;
  const auto look = [&](int p, bool any_side) {
    const double away = (place - triangles.centre[at(p)]).norm() - triangles.radius[at(p)];
    if (away > 0 && away * away >= best) return;
    for (int t = triangles.first[at(p)]; t < triangles.first[at(p) + 1]; ++t) {
      if (!any_side && !((triangles.normal[at(t)] | normal) > 0)) continue;
      const Triangle& corner = triangles.corner[at(t)];
      const Vec3d &a = points[at(corner[0])], &b = points[at(corner[1])], &c = points[at(corner[2])];
      const Vec3d w = closest_barycentric(place, a, b, c);
      const double squared = (w[0] * a + w[1] * b + w[2] * c - place).sqrnorm();
      if (!(squared < best)) continue;
      best = squared;
      found = p;
      pair.triangle = t;
      pair.barycentric = w;
    }
  };
  look(polygon, false);
  if (pair.triangle >= 0 && is_surely_inside(triangles, pair.triangle, pair.barycentric, best)) {
    pair.distance = std::sqrt(best);
    return true;
  }
  for (int current = -1; current != found;) {
    current = found;
    for (int i = mesh_.first_around[at(current)]; i < mesh_.first_around[at(current) + 1]; ++i)
      look(mesh_.around[at(i)], false);
  }
  if (pair.triangle < 0) look(polygon, true);  // all around face the other way
  polygon = found;
  if (pair.triangle < 0) return false;
  pair.distance = std::sqrt(best);
  return true;
}

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
        if (squared < least) least = squared, best = p;
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
void FitMatching::flood(const std::vector<OpenMesh::FaceHandle>& sources, const FitTriangles& triangles,
                        const std::vector<Vec3d>& points) {
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
    push(sources[at(v)], best_at(&v, &v + 1, sources[at(v)], triangles, points));
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
  for (Sample& sample : samples_) sample.polygon = polygon[at(sample.face)];
  start_in_large_faces(sources, triangles, points);
}

// Where a face holds many samples and polygons, from its one polygon downhill may end at the rim of a hole
// between them: each sample also looks from the nearest vertex that comes from its face.
void FitMatching::start_in_large_faces(const std::vector<OpenMesh::FaceHandle>& sources,
                                       const FitTriangles& triangles, const std::vector<Vec3d>& points) {
  std::vector<std::vector<int>> vertices(first_sample_.size() - 1);
  for (int v = 0; v < mesh_.n_vertices; ++v)
    if (mesh_.first_polygon[at(v)] < mesh_.first_polygon[at(v) + 1])
      vertices[at(sources[at(v)].idx())].push_back(v);
  tbb::parallel_for(size_t{0}, vertices.size(), [&](size_t f) {
    if (vertices[f].empty() || first_sample_[f + 1] - first_sample_[f] < 2) return;
    for (int i = first_sample_[f]; i < first_sample_[f + 1]; ++i) {
      Sample& sample = samples_[at(i)];
      const int v = *std::min_element(vertices[f].begin(), vertices[f].end(), [&](int a, int b) {
        return (points[at(a)] - sample.place).sqrnorm() < (points[at(b)] - sample.place).sqrnorm();
      });
      int other = best_at(&v, &v + 1, OpenMesh::FaceHandle(sample.face), triangles, points);
      FitPair from_face, from_vertex;
      const Vec3d& normal = input_.normal[f];
      const bool known =
          sample.polygon >= 0 && nearest(sample.place, normal, triangles, points, sample.polygon, from_face);
      if (other >= 0 && nearest(sample.place, normal, triangles, points, other, from_vertex) &&
          (!known || from_vertex.distance < from_face.distance))
        sample.polygon = other;
    }
  });
}

int FitMatching::polygon_of(int face) const {
  const int first = first_sample_[at(face)];
  return first < first_sample_[at(face) + 1] ? samples_[at(first)].polygon : -1;
}

const std::vector<FitPair>& FitMatching::match(const FitTriangles& triangles,
                                               const std::vector<Vec3d>& points) {
  const double least = tiny * surface_.diagonal();
  pairs_.assign(samples_.size(), FitPair());
  tbb::parallel_for(tbb::blocked_range<size_t>(0, samples_.size(), 512), [&](const auto& range) {
    for (size_t i = range.begin(); i != range.end(); ++i) {
      Sample& sample = samples_[i];
      FitPair& pair = pairs_[i];
      if (sample.polygon < 0) continue;
      pair.face = sample.face;
      if (!nearest(sample.place, input_.normal[at(sample.face)], triangles, points, sample.polygon, pair))
        continue;
      pair.weight = sample.weight;
      const Triangle& corner = triangles.corner[at(pair.triangle)];
      Vec3d away = sample.place;
      for (int k = 0; k < 3; ++k) away -= pair.barycentric[k] * points[at(corner[at(k)])];
      pair.direction = pair.distance > least ? away / pair.distance : triangles.normal[at(pair.triangle)];
    }
  });
  match_result(triangles, points);
  return pairs_;
}

// Of the faces that the corners come from and those around them, on whatever side of features. A sliver may
// be turned over: what faces the other way counts as much farther, but counts.
OpenMesh::FaceHandle FitMatching::start_from_corners(const Triangle& corner, const Vec3d& normal,
                                                     const Vec3d& place) const {
  OpenMesh::FaceHandle best = sources_[at(corner[0])];
  double least = std::numeric_limits<double>::infinity();
  for (const int v : corner)
    for (const auto u : surface_.corners(sources_[at(v)]).vertex)
      for (const auto f : surface_.connectivity().vf_range(u)) {
        const double cosine = std::max(least_cosine, input_.normal[at(f.idx())] | normal);
        const auto c = surface_.corners(f);
        const Vec3d &x = surface_.point(c.vertex[0]), &y = surface_.point(c.vertex[1]),
                    &z = surface_.point(c.vertex[2]);
        const Vec3d w = closest_barycentric(place, x, y, z);
        const double squared = (w[0] * x + w[1] * y + w[2] * z - place).sqrnorm() / (cosine * cosine);
        if (squared < least) least = squared, best = f;
      }
  return best;
}

// The place of the input beside a place of the result, downhill from a sample matched with its triangle.
// Where that is far or faces elsewhere, as when the way leads around the end of a feature or only samples
// across one were matched, all of those samples and the faces that the corners come from are looked at.
FitMatching::Foot FitMatching::foot_of(const Vec3d& place, const Vec3d& normal, const Triangle& corner,
                                       const std::vector<int>& matched, double near) const {
  const auto from = [&](OpenMesh::FaceHandle face) {
    Foot foot;
    foot.point = input_.locator.locate(Vec2d(0, 0), place, face);
    foot.away = position(surface_, foot.point) - place;
    const double cosine = input_.normal[at(foot.point.face.idx())] | normal;
    foot.key = foot.away.norm() / std::max(least_cosine, cosine);
    return foot;
  };
  const auto nearest_of = [&](size_t stride) {
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < matched.size(); i += stride) {
      const double far = (samples_[at(matched[i])].place - place).sqrnorm();
      if (far < least) least = far, best = samples_[at(matched[i])].face;
    }
    return OpenMesh::FaceHandle(best);
  };
  Foot best;
  best.key = std::numeric_limits<double>::infinity();
  const size_t stride = std::max<size_t>(1, matched.size() / starts);
  if (!matched.empty()) best = from(nearest_of(stride));
  if (best.key > near && stride > 1) {
    const Foot other = from(nearest_of(1));
    if (other.key < best.key) best = other;
  }
  if (best.key > near) {
    const Foot other = from(start_from_corners(corner, normal, place));
    if (other.key < best.key) best = other;
  }
  return best;
}

void FitMatching::match_result(const FitTriangles& triangles, const std::vector<Vec3d>& points) {
  const size_t n_input = samples_.size();
  const double least = tiny * surface_.diagonal();
  double total = 0;
  for (const double a : triangles.area) total += a;
  const double share = total / (result_samples * static_cast<double>(triangles.corner.size()));
  // The samples of the input matched with each triangle: where to look from.
  std::vector<int> first(triangles.corner.size() + 1, 0), matched(n_input);
  for (size_t i = 0; i < n_input; ++i)
    if (pairs_[i].triangle >= 0) ++first[at(pairs_[i].triangle) + 1];
  for (size_t t = 0; t + 1 < first.size(); ++t) first[t + 1] += first[t];
  std::vector<int> next(first.begin(), first.end() - 1);
  for (size_t i = 0; i < n_input; ++i)
    if (pairs_[i].triangle >= 0) matched[at(next[at(pairs_[i].triangle)]++)] = static_cast<int>(i);
  std::vector<int> begin(triangles.corner.size() + 1, 0);
  for (size_t t = 0; t < triangles.corner.size(); ++t) {
    const int n = triangles.area[t] > 0 ? divisions(triangles.area[t], share) : 0;
    begin[t + 1] = begin[t] + n * n;
  }
  pairs_.resize(n_input + at(begin.back()));
  tbb::parallel_for(size_t{0}, triangles.corner.size(), [&](size_t t) {
    if (begin[t] == begin[t + 1]) return;
    const Triangle& corner = triangles.corner[t];
    const Vec3d &a = points[at(corner[0])], &b = points[at(corner[1])], &c = points[at(corner[2])];
    const int n = static_cast<int>(std::lround(std::sqrt(begin[t + 1] - begin[t])));
    size_t index = n_input + at(begin[t]);
    const std::vector<int> here(matched.begin() + first[t], matched.begin() + first[t + 1]);
    const double near = near_match * std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    for_each_piece(n, [&](const Vec3d& w) {
      const Vec3d place = w[0] * a + w[1] * b + w[2] * c;
      const Foot foot = foot_of(place, triangles.normal[t], corner, here, near);
      FitPair& pair = pairs_[index++];
      pair.triangle = static_cast<int>(t);
      pair.barycentric = w;
      pair.face = foot.point.face.idx();
      pair.distance = foot.away.norm();
      pair.direction = pair.distance > least ? foot.away / pair.distance : input_.normal[at(pair.face)];
      pair.weight = triangles.area[t] / (n * n * total);
    });
  });
}

}  // namespace anisomesh::detail
