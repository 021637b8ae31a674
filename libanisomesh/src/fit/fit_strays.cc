#include "fit/fit_strays.hh"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

}  // namespace

FitStrays::FitStrays(const FitCurves& curves)
    : curves_(curves), now_(curves.samples_), is_stray_(curves.samples_.size(), 0) {}

bool FitStrays::shares_vertex(int side, int other) const {
  const auto &s = curves_.mesh_.sides[at(side)], &o = curves_.mesh_.sides[at(other)];
  return s.from == o.from || s.from == o.to || s.to == o.from || s.to == o.to;
}

// Those on curves that have moved or touch one that has, since the places tried last.
std::vector<char> FitStrays::moved_sides(const std::vector<Vec3d>& points) const {
  const auto& sides = curves_.mesh_.sides;
  std::vector<char> moved(points.size(), 1), result(sides.size(), 0);
  if (!points_.empty())
    for (size_t v = 0; v < points.size(); ++v) moved[v] = points[v] != points_[v];
  for (size_t v = 0; v < points.size(); ++v)
    for (const int s : curves_.sides_at(static_cast<int>(v)))
      if (moved[at(sides[at(s)].from)] || moved[at(sides[at(s)].to)])
        for (const int other : curves_.sides_at(static_cast<int>(v))) result[at(other)] = 1;
  return result;
}

void FitStrays::mark(const std::vector<Vec3d>& points, std::vector<char>& marked) {
  const auto& samples = curves_.samples_;
  const std::vector<char> moved = moved_sides(points);
  std::vector<char> anew(samples.size(), 0);
  tbb::parallel_for(size_t{0}, samples.size(), [&](size_t i) {
    const int side = samples[i].side;
    anew[i] = moved[at(side)] || moved[at(now_[i].side)] || !shares_vertex(side, now_[i].side);
    if (anew[i]) now_[i] = curves_.nearest(samples[i], points);
  });
  tbb::parallel_for(size_t{0}, samples.size(), [&](size_t i) {
    const size_t from = samples[i].follows ? i - 1 : i;
    if (anew[i] || anew[from])
      is_stray_[i] = curves_.farthest_between(now_[from], now_[i], points) >
                     std::max(curves_.tolerance_, samples[i].farthest);
  });
  points_ = points;
  for (size_t i = 0; i < samples.size(); ++i) {
    if (!is_stray_[i]) continue;
    const size_t from = samples[i].follows ? i - 1 : i;
    for (const int s : {samples[i].side, now_[i].side, now_[from].side})
      for (const int v : {curves_.mesh_.sides[at(s)].from, curves_.mesh_.sides[at(s)].to}) marked[at(v)] = 1;
  }
}

}  // namespace anisomesh::detail
