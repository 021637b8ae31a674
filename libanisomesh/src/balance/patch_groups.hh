// Which polygons are parted anew together.
#pragma once

#include <array>
#include <limits>
#include <set>
#include <vector>

#include "balance/patch_mesh.hh"

namespace anisomesh::detail {

class PatchGroups {
 public:
  explicit PatchGroups(const PatchMesh& mesh) : mesh_(mesh) {}

  const std::vector<std::vector<int>>& all() const { return groups_; }
  /// Of all(), those from here on are only for quads of triangles that others part.
  size_t first_for_pairs() const { return first_for_pairs_; }
  void add(const std::vector<int>& polygons) { groups_.push_back(polygons); }
  /// Once, in whatever order.
  void add_three(int p, int q, int r);
  /// The polygon with each two of its neighbours.
  void add_around(int polygon);
  /// Two triangles and the quad or two between them: as many corners make one polygon less, all of them
  /// quads. \param pairs neighbours
  void add_between_triangles(const std::vector<std::vector<int>>& pairs);

 private:
  const PatchMesh& mesh_;
  std::vector<std::vector<int>> groups_;
  size_t first_for_pairs_ = std::numeric_limits<size_t>::max();
  std::set<std::array<int, 3>> threes_;
};

}  // namespace anisomesh::detail
