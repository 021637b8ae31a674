#include "field/tensor_filter.hh"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "field/surface_field.hh"
#include "numerics/tensor2d.hh"
#include "surface/intrinsic_order.hh"

namespace anisomesh::detail {

namespace {

/// Samples of a group are this near to its first one, in radii of the support: near enough for the Gaussian
/// to be flat over the group, wide enough that a support never holds more than about 50 groups.
constexpr double group_radius = 0.22;

/// Samples that lie close together, standing for all of them: keeps the cost of a support bounded where the
/// mesh is fine. Where edges are longer than a group's radius every sample is a group of its own.
struct Groups {
  std::vector<int> group_of;  ///< of each sample
  std::vector<Vec3d> place, normal;
  std::vector<double> radius, area;
  NodeNeighbours neighbours;
  size_t size() const { return area.size(); }
};

/// Neighbours of groups from those of samples, each once.
NodeNeighbours group_neighbours(const FilterSamples& samples, const std::vector<int>& group_of,
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

/// Area, the largest first, and how far the neighbours are in radii of the support. Groups that start at the
/// smallest areas smooth more: mannequin-devil then has three times as many isotropic samples, and 3 % fewer
/// quads.
std::vector<Measures> measures_of(const FilterSamples& samples) {
  const auto from_middle = distances_from_middle(samples.place, samples.area);
  std::vector<Measures> measures;
  measures.reserve(samples.place.size());
  for (size_t s = 0; s < samples.place.size(); ++s) {
    double away = 0;
    for (int k = samples.neighbours.offset[s]; k < samples.neighbours.offset[s + 1]; ++k) {
      const auto other = static_cast<size_t>(samples.neighbours.node[static_cast<size_t>(k)]);
      away += (samples.place[other] - samples.place[s]).sqrnorm() / (samples.radius[s] * samples.radius[s]);
    }
    measures.push_back({-samples.area[s], away, from_middle[s]});
  }
  return measures;
}

/// The samples of each group, its first one in front. Groups start in an order that follows the shape, and
/// are numbered as the mesh is: what lies close together on the surface then lies close together in memory,
/// which is most of the time of a pass over a large scan.
std::vector<std::vector<int>> members_of_groups(const FilterSamples& samples) {
  std::vector<std::vector<int>> members;
  std::vector<char> taken(samples.place.size(), 0);
  for (const int started : intrinsic_order(measures_of(samples))) {
    const auto first = static_cast<size_t>(started);
    if (taken[first]) continue;
    const double reach = group_radius * samples.radius[first];
    taken[first] = 1;
    members.push_back({started});
    for (size_t i = 0; i < members.back().size(); ++i) {
      const auto s = static_cast<size_t>(members.back()[i]);
      for (int k = samples.neighbours.offset[s]; k < samples.neighbours.offset[s + 1]; ++k) {
        const auto other = static_cast<size_t>(samples.neighbours.node[static_cast<size_t>(k)]);
        if (taken[other] || !((samples.place[other] - samples.place[first]).norm() < reach)) continue;
        taken[other] = 1;
        members.back().push_back(static_cast<int>(other));
      }
    }
  }
  std::sort(members.begin(), members.end(),
            [](const auto& a, const auto& b) { return a.front() < b.front(); });
  return members;
}

Groups group_samples(const FilterSamples& samples) {
  Groups groups;
  groups.group_of.assign(samples.place.size(), -1);
  const auto members = members_of_groups(samples);
  for (const auto& group : members) {
    for (const int s : group) groups.group_of[static_cast<size_t>(s)] = static_cast<int>(groups.size());
    Vec3d place(0, 0, 0), normal(0, 0, 0);
    double area = 0;
    for (const int s : group) {
      place += samples.area[static_cast<size_t>(s)] * samples.place[static_cast<size_t>(s)];
      area += samples.area[static_cast<size_t>(s)];
      if (!samples.normal.empty())
        normal += samples.area[static_cast<size_t>(s)] * samples.normal[static_cast<size_t>(s)];
    }
    const auto first = static_cast<size_t>(group.front());
    if (!samples.normal.empty())
      groups.normal.push_back(normal.norm() > 0 ? normal.normalized() : samples.normal[first]);
    groups.place.push_back(area > 0 ? place / area : samples.place[first]);
    groups.radius.push_back(samples.radius[first]);
    groups.area.push_back(area);
  }
  groups.neighbours = group_neighbours(samples, groups.group_of, members);
  return groups;
}

/// A tensor of one of these carried to the frame of another; in the plane there is one frame for all.
Vec3d carried(const Vec3d& tensor, const std::vector<Vec3d>& from, size_t i, const std::vector<Vec3d>& to,
              size_t j) {
  return from.empty() ? tensor : rotated(tensor, transport(from[i], to[j]));
}

/// On the other side of something thin.
bool faces_away(const std::vector<Vec3d>& from, size_t i, const std::vector<Vec3d>& to, size_t j) {
  return !from.empty() && (from[i] | to[j]) < 0;
}

std::vector<Vec3d> group_means(const FilterSamples& samples, const Groups& groups,
                               const std::vector<Vec3d>& values) {
  std::vector<Vec3d> means(groups.size(), Vec3d(0, 0, 0));
  for (size_t s = 0; s < values.size(); ++s) {
    const auto g = static_cast<size_t>(groups.group_of[s]);
    means[g] += samples.area[s] * carried(values[s], samples.normal, s, groups.normal, g);
  }
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
  void run(const Groups& groups, int sample, int start, const Vec3d& centre, double radius, Visit&& visit) {
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
  const std::vector<Vec3d>& place;
  const std::vector<Vec3d>& normal;
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
          const Vec3d own_mean = carried(means[static_cast<size_t>(own)], groups.normal,
                                         static_cast<size_t>(own), targets.normal, i);
          Vec3d sum(0, 0, 0);
          double weights = 0;
          flood.run(groups, static_cast<int>(i), own, targets.place[i], targets.radius[i],
                    [&](size_t g, double q) {
                      // A Gaussian whose standard deviation is half the radius, lowered to end at 0.
                      double weight = groups.area[g] * std::max(std::exp(-2 * q) - at_edge, 0.0);
                      if (faces_away(groups.normal, g, targets.normal, i)) return;
                      const Vec3d mean = carried(means[g], groups.normal, g, targets.normal, i);
                      if (anisotropic) weight *= likeness(own_mean, mean);
                      sum += weight * mean;
                      weights += weight;
                    });
          result[i] = weights > 0 ? sum / weights : own_mean;
        }
      });
  return result;
}

}  // namespace

// All passes: over the groups, the last one over the samples. A group is much smaller than the support, so
// that its mean stands for its samples between two passes.
std::vector<Vec3d> filter_repeatedly(const FilterSamples& samples, std::vector<Vec3d> values, int iterations,
                                     bool anisotropic, const Progress& progress) {
  if (iterations == 0) return values;
  const auto groups = group_samples(samples);
  auto means = group_means(samples, groups, values);
  std::vector<int> identity(groups.size());
  std::iota(identity.begin(), identity.end(), 0);
  for (int i = 1; i < iterations; ++i) {
    report_progress(progress, static_cast<double>(i) / (iterations + 1));
    means = filter(groups, means, {groups.place, groups.normal, groups.radius, identity}, anisotropic);
  }
  return filter(groups, means, {samples.place, samples.normal, samples.radius, groups.group_of}, anisotropic);
}

}  // namespace anisomesh::detail
