// The moves that balance a result: each is judged by the error of the samples it concerns, before and after.
#pragma once

#include <array>
#include <set>
#include <vector>

#include "anisomesh/balance.hh"
#include "balance/patch_mesh.hh"
#include "balance/patch_partition.hh"
#include "fit/fit_state.hh"

namespace anisomesh::detail {

struct PatchMove {
  PatchMesh::Patch patch;
  std::vector<std::vector<int>> pieces;  ///< vertices; -1 is the added one
  double gain = 0;                       ///< error before less error after, and triangles saved
  bool adds = false;
  Vec3d place{0, 0, 0};  ///< of the added vertex
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
  /// Vertices to add, best first. \param lacking are vertices: other polygons than the worst are tried too
  std::vector<PatchMove> additions(const PatchMesh& mesh, bool lacking) const;
  /// Vertices to add where a sample is farther than this, best first.
  std::vector<PatchMove> additions_beyond(const PatchMesh& mesh, double distance) const;

  double mean_error() const { return mean_error_; }

 private:
  struct Situation;
  struct Sample;
  Sample sample_of(int pair) const;
  void sort_samples(const std::vector<int>& polygon_of);
  Situation look_at(const PatchMesh& mesh, const PatchMesh::Patch& patch) const;
  Vec3d normal_of(const std::vector<int>& polygons, const std::vector<Vec3d>& ring) const;
  Vec6d tensor_of(const std::vector<int>& polygons) const;
  double guess(const PatchMesh& mesh, const PatchMesh::Patch& star, int vertex) const;
  PatchMove partition(const PatchMesh& mesh, const PatchMesh::Patch& patch, bool keeps_vertices) const;
  bool is_across(const PatchMesh& mesh, const PatchMesh::Patch& patch) const;
  std::vector<PatchMove> partitions(const PatchMesh& mesh, const std::vector<std::vector<int>>& groups) const;
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
};

/// Applies moves as long as none concerns polygons that another has changed, and none adds a vertex where one
/// is: sheets that touch may both be far from the vertex of the input that is nearest to both.
class PatchChanges {
 public:
  explicit PatchChanges(PatchMesh& mesh) : mesh_(mesh), touched_(mesh.polygons().size(), 0) {
    for (const auto& vertex : mesh.vertices())
      if (!vertex.polygons.empty()) taken_.insert(key(vertex.point));
  }

  bool is_open(const PatchMove& move) const {
    for (const int p : move.patch.polygons)
      if (touched_[static_cast<size_t>(p)]) return false;
    if (move.adds && taken_.count(key(move.place)) > 0) return false;
    return mesh_.may_replace(move.patch, move.pieces);
  }
  void apply(const PatchMove& move) {
    auto pieces = move.pieces;
    if (move.adds) {
      taken_.insert(key(move.place));
      const int middle = mesh_.add_vertex(move.place, move.source);
      for (auto& piece : pieces)
        for (int& v : piece)
          if (v < 0) v = middle;
    }
    for (const int p : move.patch.polygons) touched_[static_cast<size_t>(p)] = 1;
    mesh_.replace(move.patch, pieces);
    touched_.resize(mesh_.polygons().size(), 1);
  }

 private:
  static std::array<double, 3> key(const Vec3d& p) { return {p[0], p[1], p[2]}; }

  PatchMesh& mesh_;
  std::vector<char> touched_;
  std::set<std::array<double, 3>> taken_;
};

}  // namespace anisomesh::detail
