#include "anisomesh/smoothing.hh"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <chrono>
#include <cmath>
#include <numeric>
#include <string>

#include "anisomesh/errors.hh"
#include "anisomesh/properties.hh"
#include "cut_surface.hh"
#include "numerics/tensor2d.hh"

namespace anisomesh {

namespace {

using namespace detail;

/// Samples of a group are this near to its first one, in radii of the support: near enough for the Gaussian
/// to be flat over the group, wide enough that a support never holds more than about 50 groups.
constexpr double group_radius = 0.25;

/// The field to be filtered: one sample a node of the cut surface.
struct Samples {
  CutSurface cut;
  NodeNeighbours neighbours;
  std::vector<Vec2d> place;    ///< in the plane
  std::vector<double> radius;  ///< of the support, in the plane
  std::vector<double> area;    ///< on the surface
};

/// Samples that lie close together, standing for all of them: keeps the cost of a support bounded where the
/// mesh is fine. Where edges are longer than a group's radius every sample is a group of its own.
struct Groups {
  std::vector<int> group_of;  ///< of each sample
  std::vector<Vec2d> place;
  std::vector<double> radius, area;
  NodeNeighbours neighbours;
  size_t size() const { return area.size(); }
};

Samples take_samples(const SurfaceRef& surface, double radius) {
  auto& mesh = surface.connectivity();
  const auto uv = require_property(mesh, property::uv);
  const auto stretch = require_property(mesh, property::area_stretch);
  Samples samples;
  samples.cut = cut_along_features(surface);
  samples.neighbours = node_neighbours(surface, samples.cut);
  samples.area.assign(samples.cut.nodes(), 0.0);
  for (const auto f : mesh.all_faces()) {
    const auto c = surface.corners(f);
    const Vec3d& p = surface.point(c.vertex[0]);
    const double third = ((surface.point(c.vertex[1]) - p) % (surface.point(c.vertex[2]) - p)).norm() / 6;
    for (const int n : samples.cut.corner_node[static_cast<size_t>(f.idx())])
      samples.area[static_cast<size_t>(n)] += third;
  }
  for (const int v : samples.cut.vertex_of_node) {
    samples.place.push_back(mesh.property(uv, OpenMesh::VertexHandle(v)));
    samples.radius.push_back(radius * std::sqrt(mesh.property(stretch, OpenMesh::VertexHandle(v))));
  }
  return samples;
}

/// Neighbours of groups from those of samples, each once.
NodeNeighbours group_neighbours(const Samples& samples, const std::vector<int>& group_of,
                                const std::vector<std::vector<int>>& members) {
  NodeNeighbours result;
  result.offset.push_back(0);
  std::vector<int> last_seen(members.size(), -1);
  for (size_t g = 0; g < members.size(); ++g) {
    for (const int s : members[g])
      for (int k = samples.neighbours.offset[static_cast<size_t>(s)];
           k < samples.neighbours.offset[static_cast<size_t>(s) + 1]; ++k) {
        const int other = group_of[static_cast<size_t>(samples.neighbours.node[static_cast<size_t>(k)])];
        int& seen = last_seen[static_cast<size_t>(other)];
        if (other == static_cast<int>(g) || seen == static_cast<int>(g)) continue;
        seen = static_cast<int>(g);
        result.node.push_back(other);
      }
    result.offset.push_back(static_cast<int>(result.node.size()));
  }
  return result;
}

Groups group_samples(const Samples& samples) {
  const size_t n = samples.place.size();
  Groups groups;
  groups.group_of.assign(n, -1);
  std::vector<std::vector<int>> members;
  for (size_t first = 0; first < n; ++first) {
    if (groups.group_of[first] >= 0) continue;
    const int group = static_cast<int>(members.size());
    const double reach = group_radius * samples.radius[first];
    groups.group_of[first] = group;
    members.push_back({static_cast<int>(first)});
    for (size_t i = 0; i < members.back().size(); ++i) {
      const auto s = static_cast<size_t>(members.back()[i]);
      for (int k = samples.neighbours.offset[s]; k < samples.neighbours.offset[s + 1]; ++k) {
        const auto other = static_cast<size_t>(samples.neighbours.node[static_cast<size_t>(k)]);
        if (groups.group_of[other] >= 0 || !((samples.place[other] - samples.place[first]).norm() < reach))
          continue;
        groups.group_of[other] = group;
        members.back().push_back(static_cast<int>(other));
      }
    }
  }
  for (const auto& group : members) {
    Vec2d place(0, 0);
    double area = 0;
    for (const int s : group) {
      place += samples.area[static_cast<size_t>(s)] * samples.place[static_cast<size_t>(s)];
      area += samples.area[static_cast<size_t>(s)];
    }
    groups.place.push_back(area > 0 ? place / area : samples.place[static_cast<size_t>(group.front())]);
    groups.radius.push_back(samples.radius[static_cast<size_t>(group.front())]);
    groups.area.push_back(area);
  }
  groups.neighbours = group_neighbours(samples, groups.group_of, members);
  return groups;
}

std::vector<Vec3d> group_means(const Samples& samples, const Groups& groups,
                               const std::vector<Vec3d>& values) {
  std::vector<Vec3d> means(groups.size(), Vec3d(0, 0, 0));
  for (size_t s = 0; s < values.size(); ++s)
    means[static_cast<size_t>(groups.group_of[s])] += samples.area[s] * values[s];
  for (size_t g = 0; g < means.size(); ++g)
    if (groups.area[g] > 0) means[g] /= groups.area[g];
  return means;
}

/// Likeness of two tensors in (0, 1], 1 for equal ones: the range weight of a bilateral filter, free of
/// units.
double likeness(const Vec3d& a, const Vec3d& b) {
  const double size = std::pow(frobenius_norm(a), 2) + std::pow(frobenius_norm(b), 2);
  return size > 0 ? std::exp(-4 * std::pow(frobenius_norm(a - b), 2) / size) : 1;
}

/// Finds the groups in the support of a sample, one thread's scratch space.
class Flood {
 public:
  explicit Flood(size_t groups) : seen_(groups, -1) {}

  /// Visits the groups reached from `start` without leaving the disc: (group, squared distance over squared
  /// radius).
  template <class Visit>
  void run(const Groups& groups, int sample, int start, const Vec2d& centre, double radius, Visit&& visit) {
    queue_.assign(1, start);
    seen_[static_cast<size_t>(start)] = sample;
    for (size_t i = 0; i < queue_.size(); ++i) {
      const auto g = static_cast<size_t>(queue_[i]);
      const double q = (groups.place[g] - centre).sqrnorm() / (radius * radius);
      if (i > 0 && !(q < 1)) continue;
      visit(g, q);
      for (int k = groups.neighbours.offset[g]; k < groups.neighbours.offset[g + 1]; ++k) {
        const int other = groups.neighbours.node[static_cast<size_t>(k)];
        if (seen_[static_cast<size_t>(other)] == sample) continue;
        seen_[static_cast<size_t>(other)] = sample;
        queue_.push_back(other);
      }
    }
  }

 private:
  std::vector<int> seen_, queue_;
};

/// Where the filter is to be evaluated.
struct Targets {
  const std::vector<Vec2d>& place;
  const std::vector<double>& radius;
  const std::vector<int>& group;  ///< the group each one lies in
};

/// The weighted mean of the groups in the support of each target. Range weights compare with the target's own
/// group.
std::vector<Vec3d> filter(const Groups& groups, const std::vector<Vec3d>& means, const Targets& targets,
                          bool anisotropic) {
  std::vector<Vec3d> result(targets.place.size());
  tbb::enumerable_thread_specific<Flood> floods([&] { return Flood(groups.size()); });
  const double at_edge = std::exp(-2.0);
  tbb::parallel_for(
      tbb::blocked_range<size_t>(0, result.size()), [&](const tbb::blocked_range<size_t>& range) {
        Flood& flood = floods.local();
        for (size_t i = range.begin(); i < range.end(); ++i) {
          const int own = targets.group[i];
          Vec3d sum(0, 0, 0);
          double weights = 0;
          flood.run(groups, static_cast<int>(i), own, targets.place[i], targets.radius[i],
                    [&](size_t g, double q) {
                      // A Gaussian whose standard deviation is half the radius, lowered to end at 0.
                      double weight = groups.area[g] * std::max(std::exp(-2 * q) - at_edge, 0.0);
                      if (anisotropic) weight *= likeness(means[static_cast<size_t>(own)], means[g]);
                      sum += weight * means[g];
                      weights += weight;
                    });
          result[i] = weights > 0 ? sum / weights : means[static_cast<size_t>(own)];
        }
      });
  return result;
}

/// All passes: over the groups, the last one over the samples. A group is much smaller than the support, so
/// that its mean stands for its samples between two passes.
std::vector<Vec3d> filter_repeatedly(const Samples& samples, std::vector<Vec3d> values, int iterations,
                                     bool anisotropic, const Progress& progress) {
  if (iterations == 0) return values;
  const auto groups = group_samples(samples);
  auto means = group_means(samples, groups, values);
  std::vector<int> identity(groups.size());
  std::iota(identity.begin(), identity.end(), 0);
  for (int i = 1; i < iterations; ++i) {
    report_progress(progress, static_cast<double>(i) / (iterations + 1));
    means = filter(groups, means, {groups.place, groups.radius, identity}, anisotropic);
  }
  return filter(groups, means, {samples.place, samples.radius, groups.group_of}, anisotropic);
}

std::vector<Vec3d> read_tensors(const OpenMesh::TriConnectivity& mesh) {
  const auto tensor2d = require_property(mesh, property::tensor2d);
  std::vector<Vec3d> tensors;
  tensors.reserve(mesh.n_vertices());
  for (const auto v : mesh.all_vertices()) tensors.push_back(mesh.property(tensor2d, v));
  return tensors;
}

/// A vertex on a feature keeps the mean of its sides, weighed by area.
std::vector<Vec3d> vertex_values(const Samples& samples, const std::vector<Vec3d>& at_nodes,
                                 size_t vertices) {
  std::vector<Vec3d> result(vertices, Vec3d(0, 0, 0));
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
  const auto start = std::chrono::steady_clock::now();
  options.validate();
  auto& mesh = surface.connectivity();
  const auto before = read_tensors(mesh);
  const auto samples = take_samples(surface, options.radius_fraction * surface.diagonal());
  report_progress(progress, 0);
  const auto one_sided = one_sided_values(samples.cut, samples.neighbours, before);
  const auto filtered =
      filter_repeatedly(samples, one_sided, options.iterations, options.anisotropic, progress);
  const auto values = options.iterations > 0 ? vertex_values(samples, filtered, before.size()) : before;
  report_progress(progress, 1);

  SmoothingReport report;
  double change = 0, size = 0;
  for (size_t v = 0; v < values.size(); ++v) {
    change += frobenius_norm(values[v] - before[v]);
    size += frobenius_norm(before[v]);
  }
  report.mean_change = size > 0 ? change / size : 0;
  const auto tensor2d = provide_property(mesh, property::tensor2d);
  for (const auto v : mesh.all_vertices()) mesh.property(tensor2d, v) = values[static_cast<size_t>(v.idx())];
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
