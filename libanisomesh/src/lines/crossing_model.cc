#include "lines/crossing_model.hh"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "anisomesh/flatten.hh"
#include "anisomesh/properties.hh"
#include "numerics/tensor2d.hh"
#include "numerics/tensor3d.hh"

namespace anisomesh::detail {

namespace {

/// Lines tell the shape where a chord lies nearer to its arc than this fraction of the radius, with which it
/// takes seven to go around, on all but so much of the area.
constexpr double coarsest = 0.1, coarser_there = 0.25;

}  // namespace

double CrossingModel::Patch::curvature() const { return std::max(std::abs(k_min), std::abs(k_max)); }

CrossingModel::CrossingModel(const SurfaceRef& surface, const DensityOptions& options)
    : options_(options), diagonal_(surface.diagonal()), extent_(surface.extent()) {
  const auto& mesh = surface.connectivity();
  patches_.resize(mesh.n_vertices());
  if (is_flattened(surface))
    take_plane_tensors(mesh);
  else
    take_surface_tensors(mesh);
  double total = 0, bent = 0;
  for (const auto f : mesh.faces()) {
    const auto corners = surface.corners(f);
    const Vec3d &a = surface.point(corners.vertex[0]), &b = surface.point(corners.vertex[1]),
                &c = surface.point(corners.vertex[2]);
    const double third = ((b - a) % (c - a)).norm() / 6;
    for (const auto v : corners.vertex) {
      auto& patch = patches_[static_cast<size_t>(v.idx())];
      patch.area += third;
      total += third;
      bent += third * patch.curvature();
    }
  }
  mean_curvature_ = total > 0 ? bent / total : 0;
}

double CrossingModel::coarsest_epsilon() const {
  std::vector<std::pair<double, double>> bent;  // curvature, area
  double left = 0;
  for (const Patch& patch : patches_) {
    bent.emplace_back(patch.curvature(), patch.area);
    left += coarser_there * patch.area;
  }
  std::sort(bent.begin(), bent.end(), std::greater<>());
  for (const auto& [curvature, area] : bent)
    if ((left -= area) <= 0) return coarsest / curvature;
  return std::numeric_limits<double>::infinity();
}

double CrossingModel::count(double epsilon) const {
  DensityOptions options = options_;
  options.epsilon_fraction = epsilon / diagonal_;
  const Density density(options, diagonal_, extent_, mean_curvature_);
  double sum = 0;
  for (const Patch& patch : patches_)
    sum += patch.area / (density.min_line_spacing(patch.k_min, patch.k_max) *
                         density.max_line_spacing(patch.k_min, patch.k_max));
  return sum;
}

void CrossingModel::take_plane_tensors(const OpenMesh::TriConnectivity& mesh) {
  const auto tensor = require_property(mesh, property::tensor2d);
  for (const auto v : mesh.vertices()) {
    auto& patch = patches_[static_cast<size_t>(v.idx())];
    eigenvalues(mesh.property(tensor, v), patch.k_min, patch.k_max);
  }
}

void CrossingModel::take_surface_tensors(const OpenMesh::TriConnectivity& mesh) {
  const auto tensor = require_property(mesh, property::surface_tensor);
  const auto normal = require_property(mesh, property::normal);
  for (const auto v : mesh.vertices()) {
    auto& patch = patches_[static_cast<size_t>(v.idx())];
    const TangentFrame frame(mesh.property(normal, v));
    eigenvalues(in_frame(mesh.property(tensor, v), frame), patch.k_min, patch.k_max);
  }
}

}  // namespace anisomesh::detail
