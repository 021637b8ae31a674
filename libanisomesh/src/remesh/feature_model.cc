#include "remesh/feature_model.hh"
#include "numerics/segment.hh"

#include <algorithm>
#include <cmath>
#include <limits>

#include "anisomesh/features.hh"

namespace anisomesh::detail {

namespace {

/// Of each place but the ends: the distance at which the chain is split there, no more than that of the split
/// that makes room for it.
std::vector<double> split_distances(const std::vector<Vec3d>& places) {
  struct Range {
    size_t begin, end;
    double most;
  };
  std::vector<double> result;
  std::vector<Range> ranges{{0, places.size() - 1, std::numeric_limits<double>::infinity()}};
  while (!ranges.empty()) {
    const Range r = ranges.back();
    ranges.pop_back();
    if (r.end - r.begin < 2) continue;
    size_t split = (r.begin + r.end) / 2;
    double farthest = 0;
    for (size_t i = r.begin + 1; i < r.end; ++i) {
      const double d = off_segment(places[i], places[r.begin], places[r.end]).norm();
      if (d > farthest) farthest = d, split = i;
    }
    result.push_back(std::min(farthest, r.most));
    ranges.push_back({r.begin, split, result.back()});
    ranges.push_back({split, r.end, result.back()});
  }
  return result;
}

}  // namespace

FeatureModel::FeatureModel(const SurfaceRef& surface, double corner_angle_degrees) {
  const auto& mesh = surface.connectivity();
  const FeatureSkeleton skeleton = feature_skeleton(surface, corner_angle_degrees);
  bool any = false;
  for (const FeatureCurve& curve : skeleton.curves) {
    if (curve.border) continue;
    any = true;
    std::vector<Vec3d> places{surface.point(mesh.from_vertex_handle(curve.halfedges.front()))};
    for (const auto h : curve.halfedges) places.push_back(surface.point(mesh.to_vertex_handle(h)));
    const std::vector<double> distances = split_distances(places);
    goes_at_.insert(goes_at_.end(), distances.begin(), distances.end());
    corners_ += curve.closed ? 1 : 0;
  }
  if (any) corners_ += skeleton.corners.size();
  std::sort(goes_at_.begin(), goes_at_.end());
}

double FeatureModel::count(double tolerance) const {
  const auto first = std::upper_bound(goes_at_.begin(), goes_at_.end(), tolerance);
  return static_cast<double>(goes_at_.end() - first);
}

}  // namespace anisomesh::detail
