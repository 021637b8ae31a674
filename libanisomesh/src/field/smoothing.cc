#include "anisomesh/smoothing.hh"

#include <chrono>
#include <cmath>
#include <string>

#include "anisomesh/errors.hh"
#include "anisomesh/flatten.hh"
#include "anisomesh/properties.hh"
#include "field/surface_field.hh"
#include "field/tensor_filter.hh"
#include "numerics/tensor2d.hh"
#include "numerics/tensor3d.hh"
#include "surface/canonical_copy.hh"

namespace anisomesh {

namespace {

using namespace detail;

/// What plane and surface have in common.
FilterSamples take_samples(const SurfaceRef& surface) {
  FilterSamples samples;
  samples.cut = cut_along_features(surface);
  samples.neighbours = node_neighbours(surface, samples.cut);
  samples.area.assign(samples.cut.nodes(), 0.0);
  for (const auto f : surface.connectivity().all_faces()) {
    const auto c = surface.corners(f);
    const Vec3d& p = surface.point(c.vertex[0]);
    const double third = ((surface.point(c.vertex[1]) - p) % (surface.point(c.vertex[2]) - p)).norm() / 6;
    for (const int n : samples.cut.corner_node[static_cast<size_t>(f.idx())])
      samples.area[static_cast<size_t>(n)] += third;
  }
  return samples;
}

FilterSamples samples_in_plane(const SurfaceRef& surface, double radius) {
  auto& mesh = surface.connectivity();
  const auto uv = require_property(mesh, property::uv);
  const auto stretch = require_property(mesh, property::area_stretch);
  FilterSamples samples = take_samples(surface);
  for (const int v : samples.cut.vertex_of_node) {
    const Vec2d& place = mesh.property(uv, OpenMesh::VertexHandle(v));
    samples.place.emplace_back(place[0], place[1], 0.0);
    samples.radius.push_back(radius * std::sqrt(mesh.property(stretch, OpenMesh::VertexHandle(v))));
  }
  return samples;
}

FilterSamples samples_on_surface(const SurfaceRef& surface, const SurfaceField& field, double radius) {
  FilterSamples samples = take_samples(surface);
  samples.normal = field.normal;
  samples.radius.assign(samples.cut.nodes(), radius);
  for (const int v : samples.cut.vertex_of_node)
    samples.place.push_back(surface.point(OpenMesh::VertexHandle(v)));
  return samples;
}

std::vector<Vec3d> read_tensors(const OpenMesh::TriConnectivity& mesh) {
  const auto tensor2d = require_property(mesh, property::tensor2d);
  std::vector<Vec3d> tensors;
  tensors.reserve(mesh.n_vertices());
  for (const auto v : mesh.all_vertices()) tensors.push_back(mesh.property(tensor2d, v));
  return tensors;
}

/// A vertex on a feature keeps the mean of its sides, weighed by area.
template <class Tensor>
std::vector<Tensor> vertex_values(const FilterSamples& samples, const std::vector<Tensor>& at_nodes,
                                  size_t vertices) {
  std::vector<Tensor> result(vertices);
  for (Tensor& tensor : result) tensor.vectorize(0);
  std::vector<double> area(vertices, 0.0);
  for (size_t n = 0; n < at_nodes.size(); ++n) {
    const auto v = static_cast<size_t>(samples.cut.vertex_of_node[n]);
    if (!samples.cut.on_feature[v]) {
      result[v] = at_nodes[n];
      area[v] = 1;
    } else {
      result[v] += samples.area[n] * at_nodes[n];
      area[v] += samples.area[n];
    }
  }
  for (size_t v = 0; v < vertices; ++v)
    if (area[v] > 0) result[v] /= area[v];
  return result;
}

/// Mean Frobenius norm of the change over the mean norm.
template <class Tensor, class Norm>
double mean_change(const std::vector<Tensor>& before, const std::vector<Tensor>& after, Norm&& norm) {
  double change = 0, size = 0;
  for (size_t v = 0; v < after.size(); ++v) {
    change += norm(after[v] - before[v]);
    size += norm(before[v]);
  }
  return size > 0 ? change / size : 0;
}

double norm_in_space(const Vec6d& t) {
  return std::sqrt(t[0] * t[0] + t[3] * t[3] + t[5] * t[5] + 2 * (t[1] * t[1] + t[2] * t[2] + t[4] * t[4]));
}

SmoothingReport smooth_in_plane(const SurfaceRef& surface, const SmoothingOptions& options,
                                const Progress& progress) {
  auto& mesh = surface.connectivity();
  const auto before = read_tensors(mesh);
  const auto samples = samples_in_plane(surface, options.radius_fraction * surface.extent());
  report_progress(progress, 0);
  const auto one_sided = one_sided_values(samples.cut, samples.neighbours, before);
  const auto filtered =
      filter_repeatedly(samples, one_sided, options.iterations, options.anisotropic, progress);
  const auto values = options.iterations > 0 ? vertex_values(samples, filtered, before.size()) : before;
  report_progress(progress, 1);

  SmoothingReport report;
  report.mean_change = mean_change(before, values, frobenius_norm);
  const auto tensor2d = provide_property(mesh, property::tensor2d);
  for (const auto v : mesh.all_vertices()) mesh.property(tensor2d, v) = values[static_cast<size_t>(v.idx())];
  return report;
}

SmoothingReport smooth_on_surface(const SurfaceRef& surface, const SmoothingOptions& options,
                                  const Progress& progress) {
  auto& mesh = surface.connectivity();
  const auto tensor = require_property(mesh, property::tensor);
  const auto normal = require_property(mesh, property::normal);
  std::vector<Vec6d> before;
  before.reserve(mesh.n_vertices());
  for (const auto v : mesh.all_vertices()) before.push_back(mesh.property(tensor, v));
  report_progress(progress, 0);
  std::vector<Vec6d> values = before;
  if (options.iterations > 0) {
    SurfaceField field = surface_field(surface, before);
    const auto samples = samples_on_surface(surface, field, options.radius_fraction * surface.extent());
    const auto filtered = filter_repeatedly(samples, std::move(field.tensor), options.iterations,
                                            options.anisotropic, progress);
    std::vector<Vec6d> at_nodes;
    at_nodes.reserve(filtered.size());
    for (size_t n = 0; n < filtered.size(); ++n) {
      const Vec3d& of_vertex = mesh.property(normal, OpenMesh::VertexHandle(samples.cut.vertex_of_node[n]));
      const Vec3d& end = of_vertex.sqrnorm() > 0.5 ? of_vertex : samples.normal[n];
      at_nodes.push_back(
          in_space(rotated(filtered[n], transport(samples.normal[n], end)), TangentFrame(end)));
    }
    values = vertex_values(samples, at_nodes, before.size());
  }
  report_progress(progress, 1);

  SmoothingReport report;
  report.mean_change = mean_change(before, values, norm_in_space);
  const auto smoothed = provide_property(mesh, property::surface_tensor);
  for (const auto v : mesh.all_vertices()) mesh.property(smoothed, v) = values[static_cast<size_t>(v.idx())];
  return report;
}

}  // namespace

void SmoothingOptions::validate() const {
  if (iterations < 0)
    throw InvalidOption("smoothing iterations are " + std::to_string(iterations) + ", must be at least 0");
  if (!(radius_fraction > 0) || !std::isfinite(radius_fraction))
    throw InvalidOption("smoothing radius_fraction is " + std::to_string(radius_fraction) +
                        ", must be finite and above 0");
}

SmoothingReport smooth_tensors(const SurfaceRef& surface, const SmoothingOptions& options,
                               const Progress& progress) {
  if (!surface.canonical_copy())
    return detail::in_canonical_order(
        surface, [&](const SurfaceRef& ordered) { return smooth_tensors(ordered, options, progress); });
  const auto start = std::chrono::steady_clock::now();
  options.validate();
  SmoothingReport report = is_flattened(surface) ? smooth_in_plane(surface, options, progress)
                                                 : smooth_on_surface(surface, options, progress);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

std::vector<std::array<Vec3d, 3>> corner_tensors(const SurfaceRef& surface) {
  const auto cut = cut_along_features(surface);
  const auto values =
      one_sided_values(cut, node_neighbours(surface, cut), read_tensors(surface.connectivity()));
  std::vector<std::array<Vec3d, 3>> corners(cut.corner_node.size());
  for (size_t f = 0; f < corners.size(); ++f)
    for (size_t i = 0; i < 3; ++i) corners[f][i] = values[static_cast<size_t>(cut.corner_node[f][i])];
  return corners;
}

}  // namespace anisomesh
