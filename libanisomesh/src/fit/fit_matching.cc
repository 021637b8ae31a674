#include "fit/fit_matching.hh"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "anisomesh/features.hh"
#include "anisomesh/properties.hh"
#include "fit/fit_samples.hh"

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

constexpr double input_samples = 8;   // for each triangle of the result
constexpr double least_samples = 24;  // for each polygon, if there are as many
constexpr double inside = 2.5;        // distances: a foot as far from all sides needs no closer look

Vec3d area_vector(const SurfaceRef& surface, OpenMesh::FaceHandle face) {
  const auto c = surface.corners(face);
  const Vec3d& a = surface.point(c.vertex[0]);
  return cross(surface.point(c.vertex[1]) - a, surface.point(c.vertex[2]) - a);
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
                         std::vector<OpenMesh::FaceHandle> sources, const FitTriangles& triangles,
                         const std::vector<Vec3d>& points)
    : surface_(surface), input_(input), mesh_(mesh), sources_(std::move(sources)) {
  start_in_large_faces(place_samples(flood(triangles, points), triangles.corner.size()), triangles, points);
  sort_samples();
}

FitMatching::FitMatching(FitMatching&& earlier, const FitMesh& mesh,
                         std::vector<OpenMesh::FaceHandle> sources, const std::vector<PolygonRange>& heirs,
                         const FitTriangles& triangles, const std::vector<Vec3d>& points)
    : surface_(earlier.surface_),
      input_(earlier.input_),
      mesh_(mesh),
      sources_(std::move(sources)),
      samples_(std::move(earlier.samples_)),
      sample_of_(std::move(earlier.sample_of_)) {
  tbb::parallel_for(size_t{0}, samples_.size(), [&](size_t i) {
    Sample& sample = samples_[i];
    const PolygonRange range = heirs[at(sample.polygon)];
    sample.polygon = range.begin;
    if (range.end - range.begin < 2) return;
    double least = std::numeric_limits<double>::infinity();
    for (int p = range.begin; p < range.end; ++p) {
      FitPair pair;
      int polygon = p;
      if (!nearest(sample.place, input_.normal[at(sample.face)], triangles, points, polygon, pair)) continue;
      if (is_nearer(pair.distance, least, 0)) least = pair.distance, sample.polygon = polygon;
    }
  });
}

namespace {

/// Takes pieces of a polygon's part of the input so that those taken stand for about equal areas.
struct Thinning {
  int pieces = 0;
  double area = 0, step = 0, passed = 0, next = 0;

  void begin(double wanted) {
    wanted = std::ceil(wanted * (1 - kRounding));
    if (pieces > wanted) step = area / wanted;
    next = 0.5 * step;
  }
  /// \return the area that it stands for; 0: it is left out
  double take(double piece) {
    if (!(step > 0)) return piece;
    double weight = 0;
    // Of equal pieces some end where the next one is to be taken.
    for (passed += piece; next < passed - kRounding * area; next += step) weight += step;
    return weight;
  }
};

bool touches_curve(const OpenMesh::TriConnectivity& mesh, OpenMesh::FaceHandle face) {
  for (const auto h : mesh.fh_range(face))
    if (is_feature_or_border(mesh, mesh.edge_handle(h))) return true;
  return false;
}

}  // namespace

// As many as the polygons need: where the input's faces are far smaller, some are left out, evenly by area,
// but for those beside features and borders.
std::vector<int> FitMatching::place_samples(const std::vector<int>& polygon, size_t n_triangles) {
  const auto& mesh = surface_.connectivity();
  double total = 0;
  for (const double area : input_.area) total += area;
  const double share = total / (input_samples * static_cast<double>(n_triangles));
  std::vector<Thinning> thinning(at(mesh_.n_polygons()));
  std::vector<int> parts(mesh.n_faces(), 0);
  std::vector<char> whole(parts.size(), 0);
  for (size_t f = 0; f < parts.size(); ++f) {
    if (!(input_.area[f] > 0) || polygon[f] < 0) continue;
    parts[f] = divisions(input_.area[f], share);
    whole[f] = touches_curve(mesh, OpenMesh::FaceHandle(static_cast<int>(f)));
    if (whole[f]) continue;
    thinning[at(polygon[f])].pieces += parts[f] * parts[f];
    thinning[at(polygon[f])].area += input_.area[f];
  }
  std::vector<int> first_sample;
  for (Thinning& t : thinning) t.begin(std::max(least_samples, t.area / share));
  for (const auto f : mesh.faces()) {
    first_sample.push_back(static_cast<int>(samples_.size()));
    const int n = parts[at(f.idx())];
    if (n == 0) continue;
    const auto c = surface_.corners(f);
    const double piece = input_.area[at(f.idx())] / (n * n);
    Sample sample;
    sample.face = f.idx();
    sample.polygon = polygon[at(f.idx())];
    for_each_piece(n, [&](const Vec3d& b) {
      const double area = whole[at(f.idx())] ? piece : thinning[at(sample.polygon)].take(piece);
      if (!(area > 0)) return;
      sample.weight = area / total;
      sample.place = b[0] * surface_.point(c.vertex[0]) + b[1] * surface_.point(c.vertex[1]) +
                     b[2] * surface_.point(c.vertex[2]);
      samples_.push_back(sample);
    });
  }
  first_sample.push_back(static_cast<int>(samples_.size()));
  return first_sample;
}

// Goes from polygon to polygon as long as there is a nearer one that faces the same way.
bool FitMatching::nearest(const Vec3d& place, const Vec3d& normal, const FitTriangles& triangles,
                          const std::vector<Vec3d>& points, int& polygon, FitPair& pair) const {
  double best = std::numeric_limits<double>::infinity(), reach = best;
  int found = polygon;
  const auto look = [&](int p, bool any_side) {
    const double within = reach + triangles.radius[at(p)];
    if ((place - triangles.centre[at(p)]).sqrnorm() >= within * within) return;
    for (int t = triangles.first[at(p)]; t < triangles.first[at(p) + 1]; ++t) {
      if (!(triangles.box[at(t)].squared_distance(place) < best)) continue;
      if (!any_side && !((triangles.normal[at(t)] | normal) > 0)) continue;
      const Triangle& corner = triangles.corner[at(t)];
      const Vec3d &a = points[at(corner[0])], &b = points[at(corner[1])], &c = points[at(corner[2])];
      const Vec3d w = closest_barycentric(place, a, b, c);
      const double squared = (w[0] * a + w[1] * b + w[2] * c - place).sqrnorm();
      if (!is_nearer(squared, best, triangles.radius[at(p)])) continue;
      best = squared;
      reach = std::sqrt(best);
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

// By polygon, so that what is looked at one after the other lies together in memory, too.
void FitMatching::sort_samples() {
  std::vector<int> first(at(mesh_.n_polygons()) + 1, 0);
  for (const Sample& sample : samples_) ++first[at(sample.polygon) + 1];
  for (size_t p = 0; p + 1 < first.size(); ++p) first[p + 1] += first[p];
  std::vector<Sample> sorted(samples_.size());
  sample_of_.assign(input_.area.size(), -1);
  for (const Sample& sample : samples_) {
    const int i = first[at(sample.polygon)]++;
    sorted[at(i)] = sample;
    if (sample_of_[at(sample.face)] < 0) sample_of_[at(sample.face)] = i;
  }
  samples_ = std::move(sorted);
}

int FitMatching::polygon_of(int face) const {
  const int sample = sample_of_[at(face)];
  return sample < 0 ? -1 : samples_[at(sample)].polygon;
}

void FitMatching::match(const FitTriangles& triangles, const std::vector<Vec3d>& points,
                        const FitPairs* before, FitPairs& pairs) {
  const double least = tiny * surface_.extent();
  pairs.n_input = samples_.size();
  if (pairs.pair.size() < pairs.n_input) pairs.pair.resize(pairs.n_input);
  tbb::parallel_for(tbb::blocked_range<size_t>(0, samples_.size(), 512), [&](const auto& range) {
    for (size_t i = range.begin(); i != range.end(); ++i) {
      Sample& sample = samples_[i];
      FitPair& pair = pairs.pair[i] = FitPair();
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
  pairs.sort_input(triangles.corner.size());
  match_result(triangles, points, before, pairs);
  pairs.add_up();
}

}  // namespace anisomesh::detail
