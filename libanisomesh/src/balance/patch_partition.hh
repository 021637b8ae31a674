// The cheapest partition of one patch into triangles and quads, by the error of the samples on it.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "field/linear_field.hh"
#include "numerics/bvh.hh"
#include "numerics/tensor3d.hh"

namespace anisomesh::detail {

constexpr size_t most_corners = 12;  ///< of a ring: more take too long

/// 64 samples, a bit each; a set has PatchView::set_size() of them.
using SampleSet = std::uint64_t;

struct PatchSample {
  Vec3d place{0, 0, 0};
  double weight = 0;
};

/// What is paid on top of the error.
struct PatchCosts {
  double triangle = 0;  ///< for each triangle
  bool quads = true;    ///< may be made
  double chord = 0;  ///< for a side that lies diagonally to the directions that lines follow, by its length
  Follow follow = Follow::curvature;
  /// No sample may lie farther from its piece, model units.
  double limit = std::numeric_limits<double>::infinity();
};

/// A patch seen along its normal: a polygon's error is that of the samples over it.
class PatchView {
 public:
  /// \param tensor of curvature; zero where it is not known
  PatchView(const Vec3d& normal, std::vector<PatchSample> samples, const Vec6d& tensor,
            const PatchCosts& costs);

  const PatchCosts& costs() const { return costs_; }
  double chord(const Vec3d& a, const Vec3d& b) const;

  /// Sum of weight * distance^2 to the triangle's plane; infinite where it is turned over, thin or steep.
  double triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c) const;
  /// The same, with the samples to the left of each of its sides.
  double triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c, const SampleSet* ab, const SampleSet* bc,
                  const SampleSet* ca) const;
  size_t set_size() const { return (samples_.size() + 63) / 64; }
  /// To either side of a chord, those on it to both. \param left, right are empty
  void part_samples(const Vec3d& from, const Vec3d& to, SampleSet* left, SampleSet* right) const;
  const std::vector<PatchSample>& samples() const { return samples_; }
  /// Moves the middle of a fan around it to where its triangles' error is least, and says what that is.
  Vec3d best_middle(const Vec3d& start, const std::vector<Vec3d>& ring) const;

 private:
  struct Place {
    double x = 0, y = 0;
  };
  Place seen(const Vec3d& p) const { return {p | u_, p | v_}; }
  static double side(const Place& from, const Place& to, const Place& x) {
    return (to.x - from.x) * (x.y - from.y) - (to.y - from.y) * (x.x - from.x);
  }
  /// Twice the area vector of a triangle that may be made; zero of one that is turned over, thin or steep.
  Vec3d fair_area(const Vec3d& a, const Vec3d& b, const Vec3d& c) const;

  Vec3d normal_, u_, v_;
  Orientation lines_;             // what lines follow here
  double cosine_ = 1, sine_ = 0;  // of twice their angle
  PatchCosts costs_;
  std::vector<PatchSample> samples_;
  std::vector<Place> places_;
};

/// Convex, and not bent too far along its shorter diagonal.
bool is_fair_quad(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d);

struct PatchPieces {
  double cost = 0;                       ///< infinite: there is none
  std::vector<std::vector<int>> pieces;  ///< indices into the ring; one past it is the middle
};

/// What the pieces of a ring cost, by the numbers of their corners.
struct RingCosts {
  std::function<double(size_t, size_t, size_t)> triangle;  ///< asked for once each; infinite: not to be made
  std::function<double(size_t, size_t)> chord;             ///< inside the ring
  double each_triangle = 0;
  bool quads = true;
  double most = std::numeric_limits<double>::infinity();  ///< partitions that cost as much are not looked for
};

/// \param forbidden n * n, pairs of the ring that must not be joined
PatchPieces partition_ring(const RingCosts& costs, const std::vector<Vec3d>& ring,
                           const std::vector<char>& forbidden);
PatchPieces partition_ring(const PatchView& view, const std::vector<Vec3d>& ring,
                           const std::vector<char>& forbidden,
                           double most = std::numeric_limits<double>::infinity());

/// Pieces around a vertex in the middle.
PatchPieces partition_around(const PatchView& view, const std::vector<Vec3d>& ring, const Vec3d& middle);

}  // namespace anisomesh::detail
