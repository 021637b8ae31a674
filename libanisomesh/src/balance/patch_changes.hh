// Moves that are taken together: each is judged by what is there before all of them.
#pragma once

#include <array>
#include <set>
#include <vector>

#include "balance/mending.hh"
#include "balance/patch_moves.hh"

namespace anisomesh::detail {

/// Applies moves as long as none concerns polygons that another has changed, and none adds a vertex where one
/// is: sheets that touch may both be far from the vertex of the input that is nearest to both.
class PatchChanges {
 public:
  using Moves = std::set<const PatchMove*>;

  /// \param mesh kept, and changed \param refused moves that are not taken; kept
  explicit PatchChanges(PatchMesh& mesh, const Moves& refused = none());

  bool is_open(const PatchMove& move) const;
  /// \pre is_open(move) \param move kept
  void apply(const PatchMove& move);

  /// Those taken that leave more broken polygons than were in their place, or break one beside them: what is
  /// fair seen along the normal of a patch may still be folded where the surface is a thin sheet.
  /// \param before the mesh when this was made
  Moves breaking(const FaceJudge& judge, const OpenMesh::PolyMesh& before) const;

 private:
  static const Moves& none();
  static std::array<double, 3> key(const Vec3d& p) { return {p[0], p[1], p[2]}; }

  struct Taken {
    const PatchMove* move;
    std::vector<int> polygons;  ///< that were in its place
    int first;                  ///< of its pieces
  };

  PatchMesh& mesh_;
  const Moves& refused_;
  std::vector<char> touched_;
  std::set<std::array<double, 3>> places_;  // of vertices
  std::vector<Taken> taken_;
};

}  // namespace anisomesh::detail
