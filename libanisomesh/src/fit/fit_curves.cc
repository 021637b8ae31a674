#include "fit/fit_curves.hh"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "anisomesh/features.hh"
#include "fit/fit_samples.hh"
#include "numerics/segment.hh"
#include "prepare/feature_tolerance.hh"

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

constexpr int pieces = 2;  // samples on an edge of the input, beside those that are only watched
constexpr double watched = 8, most_watched = 64;  // places for each side of the result, and at all

}  // namespace

FitCurves::FitCurves(const SurfaceRef& surface, const FitMesh& mesh, const FitMatching& matching,
                     const std::vector<Vec3d>& points)
    : mesh_(mesh), tolerance_(asked_feature_tolerance * surface.extent()), sides_at_(at(mesh.n_vertices)) {
  for (size_t s = 0; s < mesh.sides.size(); ++s)
    if (mesh.sides[s].on_curve)
      for (const int v : {mesh.sides[s].from, mesh.sides[s].to})
        sides_at_[at(v)].push_back(static_cast<int>(s));
  const auto& input = surface.connectivity();
  for (const auto e : input.edges()) {
    if (!is_feature_or_border(input, e)) continue;
    const Vec3d &a = surface.point(e.v0()), &b = surface.point(e.v1());
    Sample sample;
    sample.edge = e.idx();
    const double length = (b - a).norm();
    std::vector<int> candidates;
    for (const int k : {0, 1}) {
      const auto face = input.face_handle(input.halfedge_handle(e, static_cast<unsigned>(k)));
      const int p = face.is_valid() ? matching.polygon_of(face.idx()) : -1;
      if (p < 0) continue;
      for (const int* v = mesh.begin(p); v != mesh.end(p); ++v)
        candidates.insert(candidates.end(), sides_at(*v).begin(), sides_at(*v).end());
    }
    const auto add = [&](double parameter, double stands_for) {
      sample.place = a + parameter * (b - a);
      sample.length = stands_for;
      sample.side = -1;
      sample.distance = std::numeric_limits<double>::infinity();
      for (const int s : candidates) look(sample.place, s, points, sample);
      sample.follows = stands_for == 0 && parameter > 0;
      if (sample.side >= 0) samples_.push_back(sample);
    };
    for (int i = 0; i < pieces; ++i) add((i + 0.5) / pieces, length / pieces);
    // The ends, which are farthest from a chord, weigh nothing and are only watched; so are places between,
    // as many as tell where a vertex between two sides goes that is in the middle of the edge.
    double shortest = length;
    for (const int s : candidates)
      shortest =
          std::min(shortest, (points[at(mesh.sides[at(s)].to)] - points[at(mesh.sides[at(s)].from)]).norm());
    const double wanted = watched * (length - shortest) / std::max(shortest, length / most_watched);
    const int n = 1 + static_cast<int>(std::lround(std::clamp(wanted, 0.0, most_watched)));
    for (int i = 0; i <= n; ++i) add(static_cast<double>(i) / n, 0);
  }
  match(points);
}

void FitCurves::look(const Vec3d& place, int side, const std::vector<Vec3d>& points, Sample& best) const {
  const Vec3d &a = points[at(mesh_.sides[at(side)].from)], &b = points[at(mesh_.sides[at(side)].to)];
  const double squared = (b - a).sqrnorm();
  const double t = nearest_parameter(place, a, b);
  const double distance = (place - a - t * (b - a)).norm();
  // Beside a vertex that two sides share the first keeps it.
  if (!is_nearer(distance * distance, best.distance * best.distance, std::sqrt(squared))) return;
  best.side = side;
  best.parameter = t;
  best.distance = distance;
}

// From side to side along the curve, as long as there is a nearer one.
FitCurves::Sample FitCurves::nearest(const Sample& sample, const std::vector<Vec3d>& points) const {
  Sample best = sample;
  best.distance = std::numeric_limits<double>::infinity();
  look(sample.place, sample.side, points, best);
  for (int current = -1; current != best.side;) {
    current = best.side;
    for (const int v : {mesh_.sides[at(current)].from, mesh_.sides[at(current)].to})
      for (const int s : sides_at(v)) look(sample.place, s, points, best);
  }
  return best;
}

// Between two places the distance from each side is convex, so that the farthest is where the nearest side
// changes: before the vertex that the sides share, or twice where a short side lies between.
double FitCurves::farthest_between(Sample from, Sample to, const std::vector<Vec3d>& points,
                                   int halvings) const {
  for (; halvings > 0 && from.side != to.side; --halvings) {
    Sample middle = from;
    middle.place = 0.5 * (from.place + to.place);
    middle = nearest(middle, points);
    if (middle.side != from.side && middle.side != to.side)
      return std::max(farthest_between(from, middle, points, halvings - 1),
                      farthest_between(middle, to, points, halvings - 1));
    (middle.side == from.side ? from : to) = middle;
  }
  return std::max(from.distance, to.distance);
}

void FitCurves::match(const std::vector<Vec3d>& points) {
  tbb::parallel_for(size_t{0}, samples_.size(),
                    [&](size_t i) { samples_[i] = nearest(samples_[i], points); });
  std::vector<double> farthest(samples_.size());
  tbb::parallel_for(size_t{0}, samples_.size(), [&](size_t i) {
    const Sample& sample = samples_[i];
    farthest[i] = sample.follows ? farthest_between(samples_[i - 1], sample, points) : sample.distance;
  });
  for (size_t i = 0; i < samples_.size(); ++i) samples_[i].farthest = farthest[i];
}

void FitCurves::add_terms(const std::vector<Vec3d>& points, double width, double total_area,
                          FitSystem& system) const {
  for (const Sample& sample : samples_) {
    if (!(sample.length > 0)) continue;
    const auto& side = mesh_.sides[at(sample.side)];
    const Vec3d &a = points[at(side.from)], &b = points[at(side.to)];
    const Vec3d along = b - a, away = sample.place - a - sample.parameter * along;
    const double weight = sample.length * width / total_area, length = along.norm();
    if (!(length > 0)) continue;
    const int v[2] = {side.from, side.to};
    const double factor[2] = {1 - sample.parameter, sample.parameter};
    const TangentFrame across(along / length);
    system.add_row(v, factor, across.u, away | across.u, weight);
    system.add_row(v, factor, across.v, away | across.v, weight);
  }
}

}  // namespace anisomesh::detail
