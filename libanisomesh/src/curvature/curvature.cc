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
#include "curvature/ball_centres.hh"
#include "curvature/ball_flood.hh"
#include "curvature/curvature_measures.hh"
#include "curvature/noise.hh"
#include "numerics/tensor2d.hh"
#include "surface/canonical_copy.hh"

namespace anisomesh {

namespace {

using detail::BallFlood;
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

/// How many times the longest edge at a vertex its ball has to measure at least, by estimator. Measured:
/// docs/curvature.md.
double ring_factor(CurvatureEstimator estimator) {
  return estimator == CurvatureEstimator::normal_cycle ? 2 : 1.5;
}

/// At a wall half the ball is missing: this much larger it holds about as much surface as elsewhere.
constexpr double wall_factor = 1.4;

/// A centre covers vertices within this fraction of the ball's radius, ...
constexpr double cover_fraction = 0.4;
/// ... and gives its value to vertices within this one, which is larger so that several centres mix.
constexpr double donor_fraction = 0.6;

double longest_edge(const SurfaceArrays& surface, int vertex) {
  double longest = 0;
  for (int i = 0; i < surface.star_size(vertex); ++i) {
    const int face = surface.star_of(vertex)[i], corner = surface.corner_of(face, vertex);
    const Vec3d& p = surface.corner_point(face, corner);
    longest = std::max({longest, (surface.corner_point(face, (corner + 1) % 3) - p).sqrnorm(),
                        (surface.corner_point(face, (corner + 2) % 3) - p).sqrnorm()});
  }
  return std::sqrt(longest);
}

/// Averages measures over balls and turns them into curvatures.
class Estimation {
 public:
  Estimation(const SurfaceRef& surface, const CurvatureOptions& options)
      : arrays_(surface),
        normals_(arrays_, detail::smoothing_passes(
                              arrays_, options.normal_fraction * options.radius_fraction * surface.extent())),
        measures_(arrays_, normals_, options.estimator),
        base_radius_(options.radius_fraction * surface.extent()),
        radii_(static_cast<size_t>(arrays_.n_vertices())),
        result_(radii_.size()),
        donated_(radii_.size()) {
    std::vector<double> reach(radii_.size());
    for (int v = 0; v < arrays_.n_vertices(); ++v) {
      const double ring = ring_factor(options.estimator) * longest_edge(arrays_, v);
      const auto i = static_cast<size_t>(v);
      enlarged_balls_ += ring > base_radius_;
      radii_[i] = std::max(base_radius_, ring);
      if (arrays_.at_wall[i]) radii_[i] *= wall_factor;
      // Where the ball had to be enlarged, faces are large already: leave hardly any vertex out.
      reach[i] = cover_fraction * base_radius_ * (base_radius_ / radii_[i]);
    }
    centres_ = detail::choose_centres(arrays_, reach);
    is_centre_.assign(radii_.size(), 0);
    for (const int c : centres_) is_centre_[static_cast<size_t>(c)] = 1;
  }

  void run(const Progress& progress) {
    tbb::enumerable_thread_specific<BallFlood> floods([&] { return BallFlood(arrays_); });
    std::vector<std::vector<Gift>> gifts(batch_size);
    const size_t count = centres_.size();
    for (size_t begin = 0; begin < count; begin += batch_size) {
      const size_t end = std::min(count, begin + batch_size);
      tbb::parallel_for(tbb::blocked_range<size_t>(begin, end, 64), [&](const auto& range) {
        BallFlood& flood = floods.local();
        for (size_t i = range.begin(); i < range.end(); ++i)
          visit_centre(centres_[i], flood, gifts[i - begin]);
      });
      for (size_t i = begin; i < end;
           ++i)  // in one order, so that the sums are the same for all thread counts
        for (const Gift& gift : gifts[i - begin]) donated_[gift.vertex] += gift.part;
      report_progress(progress, 0.1 + 0.8 * static_cast<double>(end) / static_cast<double>(count));
    }
    tbb::parallel_for(size_t{0}, result_.size(), [&](size_t v) {
      if (is_centre_[v]) return;
      const TangentFrame frame(normals_.of_vertex(static_cast<int>(v)));
      result_[v] = principal(measures_.curvature(donated_[v], frame), frame);
    });
  }

  const CornerNormals& normals() const { return normals_; }
  const std::vector<VertexCurvature>& result() const { return result_; }
  size_t enlarged_balls() const { return enlarged_balls_; }
  size_t degenerate_faces() const { return measures_.degenerate_faces(); }

 private:
  /// What a centre gives to a vertex that is none: its average, as if over an area that is the weight.
  struct Gift {
    size_t vertex;
    Measure part;
  };
  static constexpr size_t batch_size = 4096;

  Measure sum(int face, int centre, BallFlood& flood) const {
    Measure total;
    const Vec3d& point = arrays_.points[static_cast<size_t>(centre)];
    const double radius = radii_[static_cast<size_t>(centre)];
    flood.walk(face, point, radius, [&](int f, bool whole) {
      total += whole ? measures_.whole(f) : measures_.clipped(f, point, radius);
    });
    return total;
  }

  void visit_centre(int centre, BallFlood& flood, std::vector<Gift>& gifts) {
    gifts.clear();
    const auto c = static_cast<size_t>(centre);
    if (arrays_.at_wall[c] || arrays_.star_size(centre) == 0) {
      result_[c] = estimate_at_wall(centre, flood);
      return;
    }
    flood.reset();
    const Measure total = sum(arrays_.star_of(centre)[0], centre, flood);
    const TangentFrame frame(normals_.of_vertex(centre));
    result_[c] = principal(measures_.curvature(total, frame), frame);
    if (total.area > 0) give(centre, total, flood, gifts);
  }

  /// Collects gifts to the vertices near a centre among those of the last walk.
  void give(int centre, const Measure& total, const BallFlood& flood, std::vector<Gift>& gifts) const {
    const auto c = static_cast<size_t>(centre);
    const double radius = donor_fraction * radii_[c];
    for (const int face : flood.faces())
      for (const int corner : arrays_.corners[static_cast<size_t>(face)]) {
        const auto v = static_cast<size_t>(corner);
        if (is_centre_[v]) continue;
        // Every face around the vertex comes by: only the first of its star speaks for it.
        if (arrays_.star_of(corner)[0] != face) continue;
        const double t = (arrays_.points[v] - arrays_.points[c]).sqrnorm() / (radius * radius);
        if (t >= 1) continue;
        Gift gift{v, total};
        gift.part.area = (1 - t) * (1 - t);
        gift.part.tensor *= gift.part.area / total.area;
        gifts.push_back(gift);
      }
  }

  /// The estimate where walls may part the star: the mean of the parts, each turned into the common tangent
  /// plane. [ACDLD03, section 2.5]
  VertexCurvature estimate_at_wall(int vertex, BallFlood& flood) const {
    const Vec3d& normal = normals_.of_vertex(vertex);
    const TangentFrame frame(normal);
    flood.reset();
    Vec6d mean(0, 0, 0, 0, 0, 0);
    double area = 0;
    for (int i = 0; i < arrays_.star_size(vertex); ++i) {
      const int face = arrays_.star_of(vertex)[i];
      if (flood.visited(face)) continue;
      const Measure part = sum(face, vertex, flood);
      const Vec3d& side = normals_.at(face, arrays_.corner_of(face, vertex));
      if (!(part.area > 0) || !(side.sqrnorm() > 0.5)) continue;
      const TangentFrame side_frame(side);
      mean += part.area * detail::in_space(measures_.curvature(part, side_frame),
                                           detail::turned(side_frame, side, normal));
      area += part.area;
    }
    if (area > 0) mean /= area;
    return principal(detail::in_frame(mean, frame), frame);
  }

  SurfaceArrays arrays_;
  CornerNormals normals_;
  CurvatureMeasures measures_;
  double base_radius_;
  std::vector<double> radii_;
  std::vector<int> centres_;
  std::vector<char> is_centre_;
  std::vector<VertexCurvature> result_;
  std::vector<Measure> donated_;
  size_t enlarged_balls_ = 0;
};

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
  if (!(radius_fraction >= 0) || !std::isfinite(radius_fraction))
    throw InvalidOption("radius_fraction is " + std::to_string(radius_fraction) +
                        ", must be finite and above 0, or 0 to choose it by the noise");
  if (!(normal_fraction >= 0 && normal_fraction <= 1))
    throw InvalidOption("normal_fraction is " + std::to_string(normal_fraction) + ", must be in [0, 1]");
}

CurvatureReport estimate_curvature(const SurfaceRef& surface, const CurvatureOptions& given,
                                   const Progress& progress) {
  if (!surface.canonical_copy())
    return detail::in_canonical_order(
        surface, [&](const SurfaceRef& ordered) { return estimate_curvature(ordered, given, progress); });
  const auto start = std::chrono::steady_clock::now();
  given.validate();
  report_progress(progress, 0);
  CurvatureOptions options = given;
  CurvatureReport report;
  if (given.radius_fraction == 0) {
    const auto choice = detail::choose_by_noise(surface);
    options.radius_fraction = choice.radius_fraction;
    options.normal_fraction = choice.normal_fraction;
    report.noise = choice.noise;
  }
  Estimation estimation(surface, options);
  report_progress(progress, 0.1);
  estimation.run(progress);
  write_properties(surface.connectivity(), estimation.normals(), estimation.result());
  report.normal_fraction = options.normal_fraction;
  report.radius = options.radius_fraction * surface.extent();
  report.enlarged_balls = estimation.enlarged_balls();
  report.degenerate_faces = estimation.degenerate_faces();
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace anisomesh
