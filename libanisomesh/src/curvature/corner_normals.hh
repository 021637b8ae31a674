// Normals at the corners of faces: one for each vertex, or for each side where features part its star.
#pragma once

#include <array>
#include <vector>

#include "surface/surface_arrays.hh"

namespace anisomesh::detail {

/// Twice the area of a face along its normal; zero if the face has no area to speak of.
Vec3d area_vector(const SurfaceArrays& surface, int face);

/// Normals of the corners of faces. The faces around a vertex fall into sectors between its walls; all
/// corners in a sector share one normal.
class CornerNormals {
 public:
  /// \param passes of averaging with the corners around, on the same side of walls. With them normals at
  /// walls stay those of the faces on their side: what would correct them leans on single edges, which noise
  /// has tilted.
  explicit CornerNormals(const SurfaceArrays& surface, int passes = 0);

  /// Unit, or (0, 0, 0) if no face of the sector has an area.
  const Vec3d& at(int face, int corner) const {
    return normals_[static_cast<size_t>(sector_[static_cast<size_t>(face)][static_cast<size_t>(corner)])];
  }
  /// Unit; the mean over the sectors, (0, 0, 1) where there is none.
  const Vec3d& of_vertex(int vertex) const { return vertex_normals_[static_cast<size_t>(vertex)]; }

 private:
  void find_sectors();
  void average_faces();
  void smooth(int passes);
  void correct_walls();
  void average_sectors();
  /// The faces of a sector.
  const int* faces_of(size_t sector) const { return faces_.data() + first_face_[sector]; }
  size_t n_faces_of(size_t sector) const { return first_face_[sector + 1] - first_face_[sector]; }
  Vec3d corrected(size_t sector) const;

  const SurfaceArrays& surface_;
  std::vector<std::array<int, 3>> sector_;  ///< of each face's corners
  std::vector<int> vertex_;                 ///< of each sector; sectors of a vertex follow one another
  std::vector<size_t> first_face_;          ///< of each sector, into faces_; one more than there are sectors
  std::vector<int> faces_;
  std::vector<Vec3d> normals_;  ///< of each sector
  std::vector<Vec3d> vertex_normals_;
};

}  // namespace anisomesh::detail
