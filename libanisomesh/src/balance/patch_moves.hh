// The moves that balance a result: each is judged by the error of the samples it concerns, before and after.
#pragma once

#include <array>
#include <vector>

#include "anisomesh/balance.hh"
#include "balance/patch_groups.hh"
#include "balance/patch_mesh.hh"
#include "balance/patch_partition.hh"
#include "fit/fit_state.hh"

namespace anisomesh::detail {

struct PatchMove {
  PatchMesh::Patch patch;
  std::vector<std::vector<int>> pieces;  ///< vertices; -1 is the added one
  size_t on_first_side = 0;  ///< so many of the pieces, if the patch lies on both sides of a curve
  double gain = 0;           ///< error before less error after, and triangles saved
  bool adds = false;
  Vec3d place{0, 0, 0};                ///< of the added vertex
  std::array<int, 2> between{-1, -1};  ///< ... if it lies on a curve: the two beside it there
  SurfacePoint source;
};

class PatchMoves {
 public:
  PatchMoves(const SurfaceRef& surface, const FitInput& input, const FitState& fit,
             const BalanceOptions& options);

  /// From now on no move may bring a sample farther than this from its polygon, model units, but for those
  /// that are farther already and additions.
  void set_limit(double limit) { costs_.limit = limit; }

  /// Moves that keep all vertices, best first.
  std::vector<PatchMove> repartitions(const PatchMesh& mesh) const;
  /// Vertices whose removal costs least, that first. \param of_all tries every one, not only those that seem
  /// cheapest
  std::vector<PatchMove> removals(const PatchMesh& mesh, bool of_all = false) const;
  /// Vertices to add, best first. \param lacking are vertices: other polygons than the worst are tried too,
  /// \param at_any_cost then also what gains nothing
  std::vector<PatchMove> additions(const PatchMesh& mesh, bool lacking, bool at_any_cost) const;
  /// Vertices to add where a sample is farther than this, best first.
  std::vector<PatchMove> additions_beyond(const PatchMesh& mesh, double distance) const;

  double mean_error() const { return mean_error_; }

 private:
  struct Situation;
  struct Sample;
  Sample sample_of(int pair) const;
  void sort_samples(const std::vector<int>& polygon_of);
  Situation look_at(const PatchMesh& mesh, const PatchMesh::Patch& patch, const Vec3d& place = {}) const;
  Vec3d normal_of(const std::vector<int>& polygons, const std::vector<Vec3d>& ring) const;
  Vec6d tensor_of(const std::vector<int>& polygons) const;
  SurfacePoint source_at(OpenMesh::FaceHandle face, const Vec3d& place) const;
  static bool may_be_made(const PatchMesh& mesh, const PatchMove& move);
  double guess(const PatchMesh& mesh, const PatchMesh::Patch& star, int vertex) const;
  PatchMove curve_removal(const PatchMesh& mesh, int vertex) const;
  PatchMove curve_addition(const PatchMesh& mesh, int side) const;
  bool part_sides(const PatchMesh& mesh, const PatchMesh::CurveStar& star, PatchMove& move) const;
  double curve_cost(int vertex, const std::array<int, 2>& bridge) const;
  void sort_curves();
  enum class Aim { removal, repartition, quads_of_pairs };  // the last: PatchGroups::first_for_pairs()
  PatchMove best_partition(const PatchMesh& mesh, const PatchMesh::Patch& patch, Aim aim,
                           const Vec3d& place = {}) const;
  PatchMove partition(const PatchMesh& mesh, const PatchMesh::Patch& patch, Aim aim) const;
  bool is_across(const PatchMesh& mesh, const PatchMesh::Patch& patch) const;
  /// Vertices that go from features and borders, in no order.
  std::vector<PatchMove> curve_removals(const PatchMesh& mesh) const;
  /// \param wanted polygons \return vertices that come to features and borders beside them, in no order
  std::vector<PatchMove> curve_additions(const PatchMesh& mesh, const std::vector<char>& wanted) const;
  std::vector<PatchMove> partitions(const PatchMesh& mesh, const PatchGroups& groups) const;
  std::vector<PatchMove> additions_to(const PatchMesh& mesh, const std::vector<char>& wanted,
                                      double least_gain) const;
  PatchMove addition(const PatchMesh& mesh, const PatchMesh::Patch& patch) const;

  const SurfaceRef& surface_;
  const FitInput& input_;
  const FitState& fit_;
  PatchCosts costs_;
  double mean_error_ = 0;
  std::vector<double> worst_;  // largest distance of a sample on each polygon
  std::vector<double> error_;  // of each polygon
  std::vector<char> hangs_;    // in the air
  // What stands beside each polygon: indices of pairs, and where on the input that is.
  std::vector<int> first_sample_, sample_;
  std::vector<PatchSample> placed_;
  std::vector<Vec3d> normal_;  // sums by weight
  std::vector<Vec6d> tensor_;  // empty where none is known
  // What stands beside each side on a curve, and how much a squared distance from it counts.
  std::vector<std::vector<const FitCurves::Sample*>> on_side_;
  double curve_weight_ = 0, farthest_from_curve_ = 0;
};

}  // namespace anisomesh::detail
