// Where the samples of the result stand on the input.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/fit_matching.hh"
#include "fit/fit_samples.hh"

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

constexpr double result_samples = 4;  // for each triangle, at least
constexpr int starts = 6;             // places to look from

}  // namespace

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
        if (is_nearer(squared, least, (y - x).norm())) least = squared, best = f;
      }
  return best;
}

FitMatching::Foot FitMatching::foot_from(const Vec3d& place, const Vec3d& normal,
                                         OpenMesh::FaceHandle face) const {
  Foot foot;
  foot.point = input_.locator.locate(Vec2d(0, 0), place, face);
  foot.away = input_.locator.position(foot.point) - place;
  const double cosine = input_.normal[at(foot.point.face.idx())] | normal;
  foot.key = foot.away.norm() / std::max(least_cosine, cosine);
  return foot;
}

// The place of the input beside a place of the result, downhill from where it was before or from a sample
// matched with its triangle. Where that is far or faces elsewhere, as when the way leads around the end of a
// feature or only samples across one were matched, all of those samples and the faces that the corners come
// from are looked at.
FitMatching::Foot FitMatching::foot_of(const Vec3d& place, const Vec3d& normal, const Triangle& corner,
                                       int before, const int* begin, const int* end, double near) const {
  const auto nearest_of = [&](std::ptrdiff_t stride) {
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (const int* i = begin; i < end; i += stride) {
      const double far = (samples_[at(*i)].place - place).sqrnorm();
      if (is_nearer(far, least, 0)) least = far, best = samples_[at(*i)].face;
    }
    return OpenMesh::FaceHandle(best);
  };
  Foot best;
  best.key = std::numeric_limits<double>::infinity();
  const auto look = [&](OpenMesh::FaceHandle face) {
    const Foot other = foot_from(place, normal, face);
    if (is_nearer(other.key, best.key, 0)) best = other;
  };
  if (before >= 0) {
    look(OpenMesh::FaceHandle(before));
    if (best.key <= near) return best;
  }
  const std::ptrdiff_t stride = std::max<std::ptrdiff_t>(1, (end - begin) / starts);
  if (begin < end) look(nearest_of(stride));
  if (best.key > near && stride > 1) look(nearest_of(1));
  if (best.key > near) look(start_from_corners(corner, normal, place));
  return best;
}

void FitMatching::match_result(const FitTriangles& triangles, const std::vector<Vec3d>& points,
                               const FitPairs* before, FitPairs& pairs) const {
  const double least = tiny * surface_.extent();
  double total = 0;
  for (const double a : triangles.area) total += a;
  const double share = total / (result_samples * static_cast<double>(triangles.corner.size()));
  auto& first = pairs.first_own;
  first.assign(triangles.corner.size() + 1, 0);
  for (size_t t = 0; t < triangles.corner.size(); ++t) {
    const int n = triangles.area[t] > 0 ? divisions(triangles.area[t], share) : 0;
    first[t + 1] = first[t] + n * n;
  }
  pairs.pair.resize(pairs.n_input + at(first.back()));
  tbb::parallel_for(size_t{0}, triangles.corner.size(), [&](size_t t) {
    const int count = first[t + 1] - first[t];
    if (count == 0) return;
    const Triangle& corner = triangles.corner[t];
    const Vec3d &a = points[at(corner[0])], &b = points[at(corner[1])], &c = points[at(corner[2])];
    const bool known = before && before->first_own[t + 1] - before->first_own[t] == count;
    size_t old = known ? before->n_input + at(before->first_own[t]) : 0, index = pairs.n_input + at(first[t]);
    const int *begin = pairs.of_input.data() + pairs.first[t],
              *end = pairs.of_input.data() + pairs.first[t + 1];
    const double near = near_match * std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    for_each_piece(static_cast<int>(std::lround(std::sqrt(count))), [&](const Vec3d& w) {
      const Vec3d place = w[0] * a + w[1] * b + w[2] * c;
      const int face = known ? before->pair[old++].face : -1;
      const Foot foot = foot_of(place, triangles.normal[t], corner, face, begin, end, near);
      FitPair& pair = pairs.pair[index++];
      pair.triangle = static_cast<int>(t);
      pair.barycentric = w;
      pair.face = foot.point.face.idx();
      pair.distance = foot.away.norm();
      pair.direction = pair.distance > least ? foot.away / pair.distance : input_.normal[at(pair.face)];
      pair.weight = triangles.area[t] / (count * total);
    });
  });
}

}  // namespace anisomesh::detail
