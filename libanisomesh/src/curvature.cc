#include "anisomesh/curvature.hh"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

#include "anisomesh/errors.hh"
#include "anisomesh/properties.hh"
#include "curvature_measures.hh"
#include "numerics/ball_clip.hh"
#include "numerics/tensor2d.hh"

namespace anisomesh {

namespace {

using detail::CornerNormals;
using detail::CurvatureMeasures;
using detail::Measure;
using detail::SurfaceArrays;
using detail::TangentFrame;

/// A vertex's curvature data, as it is written to the properties in the end.
struct VertexCurvature {
  Vec6d tensor{0, 0, 0, 0, 0, 0};
  double k_min = 0, k_max = 0;
  Vec3d gamma_min, gamma_max;
};

VertexCurvature principal(const Vec3d& tensor, const TangentFrame& frame) {
  VertexCurvature result;
  const auto eigen = detail::eigen_decomposition(tensor);
  result.k_min = eigen.min;
  result.k_max = eigen.max;
  result.gamma_min = (eigen.direction_min[0] * frame.u + eigen.direction_min[1] * frame.v).normalized();
  result.gamma_max = (eigen.direction_max[0] * frame.u + eigen.direction_max[1] * frame.v).normalized();
  result.tensor = eigen.min * detail::outer(result.gamma_min) + eigen.max * detail::outer(result.gamma_max);
  return result;
}

/// Sums measures over the part of the surface in a ball that is connected to where it starts.
class BallFlood {
 public:
  BallFlood(const SurfaceArrays& surface, const CurvatureMeasures& measures)
      : surface_(&surface), measures_(&measures), visited_(static_cast<size_t>(surface.n_faces()), 0) {}

  /// Forgets which faces were visited.
  void reset() { ++stamp_; }
  bool visited(int face) const { return visited_[static_cast<size_t>(face)] == stamp_; }

  Measure sum(int first_face, const Vec3d& centre, double radius) {
    Measure total;
    visit(first_face);
    while (!pending_.empty()) {
      const int face = pending_.back();
      pending_.pop_back();
      Vec3d p[3];
      bool inside[3];
      for (int i = 0; i < 3; ++i) {
        p[i] = surface_->corner_point(face, i) - centre;
        inside[i] = p[i].sqrnorm() <= radius * radius;
      }
      if (inside[0] && inside[1] && inside[2])
        total += measures_->whole(face);
      else
        total += measures_->clipped(face, centre, radius);
      for (size_t i = 0; i < 3; ++i) {
        const int next = surface_->neighbours[static_cast<size_t>(face)][i];
        if (next < 0 || visited(next)) continue;
        if (inside[i] || inside[(i + 1) % 3] || detail::meets_ball(p[i], p[(i + 1) % 3], radius)) visit(next);
      }
    }
    return total;
  }

 private:
  void visit(int face) {
    visited_[static_cast<size_t>(face)] = stamp_;
    pending_.push_back(face);
  }

  const SurfaceArrays* surface_;
  const CurvatureMeasures* measures_;
  std::vector<unsigned> visited_;
  unsigned stamp_ = 0;
  std::vector<int> pending_;
};

/// The radius that holds the 1-ring with room to spare.
double ring_radius(const SurfaceArrays& surface, int vertex, double factor) {
  double longest = 0;
  for (int i = 0; i < surface.star_size(vertex); ++i) {
    const int face = surface.star_of(vertex)[i], corner = surface.corner_of(face, vertex);
    const Vec3d& p = surface.corner_point(face, corner);
    longest = std::max({longest, (surface.corner_point(face, (corner + 1) % 3) - p).sqrnorm(),
                        (surface.corner_point(face, (corner + 2) % 3) - p).sqrnorm()});
  }
  return factor * std::sqrt(longest);
}

/// The estimate at a vertex; where walls part its star, the mean of the parts, each turned into the common
/// tangent plane. [ACDLD03, section 2.5]
VertexCurvature estimate_vertex(const SurfaceArrays& surface, const CornerNormals& normals,
                                const CurvatureMeasures& measures, BallFlood& flood, int vertex,
                                double radius) {
  const Vec3d& normal = normals.of_vertex(vertex);
  const TangentFrame frame(normal);
  const Vec3d& centre = surface.points[static_cast<size_t>(vertex)];
  flood.reset();
  Vec6d sum(0, 0, 0, 0, 0, 0);
  double area = 0;
  for (int i = 0; i < surface.star_size(vertex); ++i) {
    const int face = surface.star_of(vertex)[i];
    if (flood.visited(face)) continue;
    const Measure part = flood.sum(face, centre, radius);
    const Vec3d& side = normals.at(face, surface.corner_of(face, vertex));
    if (!(part.area > 0) || !(side.sqrnorm() > 0.5)) continue;
    const TangentFrame side_frame(side);
    const Vec3d tensor = measures.curvature(part, side_frame);
    sum += part.area * detail::in_space(tensor, detail::turned(side_frame, side, normal));
    area += part.area;
  }
  if (area > 0) sum /= area;
  return principal(detail::in_frame(sum, frame), frame);
}

void write_properties(OpenMesh::TriConnectivity& mesh, const CornerNormals& normals,
                      const std::vector<VertexCurvature>& result) {
  const auto normal = provide_property(mesh, property::normal),
             gamma_min = provide_property(mesh, property::gamma_min),
             gamma_max = provide_property(mesh, property::gamma_max);
  const auto tensor = provide_property(mesh, property::tensor);
  const auto k_min = provide_property(mesh, property::k_min), k_max = provide_property(mesh, property::k_max);
  for (size_t i = 0; i < result.size(); ++i) {
    const OpenMesh::VertexHandle v(static_cast<int>(i));
    mesh.property(normal, v) = normals.of_vertex(static_cast<int>(i));
    mesh.property(tensor, v) = result[i].tensor;
    mesh.property(k_min, v) = result[i].k_min;
    mesh.property(k_max, v) = result[i].k_max;
    mesh.property(gamma_min, v) = result[i].gamma_min;
    mesh.property(gamma_max, v) = result[i].gamma_max;
  }
}

}  // namespace

void CurvatureOptions::validate() const {
  if (!(radius_fraction > 0) || !std::isfinite(radius_fraction))
    throw InvalidOption("radius_fraction is " + std::to_string(radius_fraction) +
                        ", must be finite and above 0");
}

CurvatureReport estimate_curvature(const SurfaceRef& surface, const CurvatureOptions& options,
                                   const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  options.validate();
  report_progress(progress, 0);
  const SurfaceArrays arrays(surface);
  const CornerNormals normals(arrays);
  const CurvatureMeasures measures(arrays, normals, options.estimator);
  CurvatureReport report;
  report.radius = options.radius_fraction * surface.diagonal();
  report.degenerate_faces = measures.degenerate_faces();

  std::vector<VertexCurvature> result(static_cast<size_t>(arrays.n_vertices()));
  std::vector<double> radii(result.size());
  for (int v = 0; v < arrays.n_vertices(); ++v) {
    const double ring = ring_radius(arrays, v, getenv("FACTOR") ? atof(getenv("FACTOR")) : 1.0);
    radii[static_cast<size_t>(v)] = std::max(report.radius, ring);
    report.enlarged_balls += ring > report.radius;
  }
  tbb::enumerable_thread_specific<BallFlood> floods([&] { return BallFlood(arrays, measures); });
  const int batches = progress ? 20 : 1, count = arrays.n_vertices();
  for (int batch = 0; batch < batches; ++batch) {
    const auto bound = [&](int b) { return static_cast<int>(static_cast<long long>(count) * b / batches); };
    tbb::parallel_for(tbb::blocked_range<int>(bound(batch), bound(batch + 1), 256), [&](const auto& range) {
      BallFlood& flood = floods.local();
      for (int v = range.begin(); v < range.end(); ++v)
        result[static_cast<size_t>(v)] =
            estimate_vertex(arrays, normals, measures, flood, v, radii[static_cast<size_t>(v)]);
    });
    report_progress(progress, static_cast<double>(batch + 1) / batches);
  }
  write_properties(surface.connectivity(), normals, result);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace anisomesh
