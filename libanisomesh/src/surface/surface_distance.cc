#include "surface/surface_distance.hh"

#include <algorithm>
#include <cmath>

namespace anisomesh::detail {

void SurfaceDistance::add(const std::vector<Source>& sources) {
  fronts_.clear();
  for (const Source& source : sources) bound_[static_cast<size_t>(source.face)] = 0;
  for (const Source& source : sources)
    spread({0, source.face, -1, source.place, source.radius, source.reach});
  while (!fronts_.empty()) {
    std::pop_heap(fronts_.begin(), fronts_.end());
    const Front next = fronts_.back();
    fronts_.pop_back();
    float& bound = bound_[static_cast<size_t>(next.face)];
    if (!(next.distance < bound)) continue;
    bound = next.distance;
    spread(next);
  }
}

void SurfaceDistance::spread(const Front& from) {
  for (int i = 0; i < 3; ++i) {
    if (i == from.entered) continue;
    const int next = faces_.across(from.face, i);
    if (next < 0) continue;
    double unused = 0;
    const double away = std::sqrt(faces_.edge_distance2(from.face, i, from.place, unused)) - from.radius;
    const float distance = std::max(from.distance, static_cast<float>(away));
    if (!(distance < bound_[static_cast<size_t>(next)] && distance < static_cast<float>(from.reach)))
      continue;
    fronts_.push_back({distance, next, faces_.twin(from.face, i), faces_.carried(from.face, i, from.place),
                       from.radius, from.reach});
    std::push_heap(fronts_.begin(), fronts_.end());
  }
}

}  // namespace anisomesh::detail
