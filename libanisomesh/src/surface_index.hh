// Lines of one kind on a surface, kept in the faces they cross, and the nearest of them along the surface.
#pragma once

#include "surface_path.hh"

namespace anisomesh::detail {

/// What is nearest is found by unfolding the triangles around a point as far as the nearest line found so
/// far. [Marinov and Kobbelt 2004, section 4, keep samples in the faces; here the segments themselves]
class SurfaceIndex final : public LineIndex {
 public:
  SurfaceIndex(const SurfaceRef& surface, const UnfoldedFaces& faces)
      : faces_(faces), paths_(surface, faces), flood_(faces), first_(faces.size(), -1) {}

  Neighbourhood nearest(const SurfacePoint& at, double bound, int own, double from, double to) override;
  void enter(int line, const std::vector<ArcPoint>& points) override;
  void enter_sample(int id, const SurfacePoint& point) override;

 private:
  struct Piece {
    Vec2d from{0, 0}, to{0, 0};  // in the frame of the face
    double arc_from = 0, arc_to = 0;
    int line = -1;
    int next = -1;  // in the same face
  };
  void add(int face, const Piece& piece);

  const UnfoldedFaces& faces_;
  SurfacePaths paths_;
  SurfaceFlood flood_;
  std::vector<int> first_;  // of each face, into pieces_
  std::vector<Piece> pieces_;
};

}  // namespace anisomesh::detail
