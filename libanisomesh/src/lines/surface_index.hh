// Lines of one kind on a surface, kept in the faces they cross, and the nearest of them along the surface.
#pragma once

#include "surface/surface_distance.hh"
#include "surface/surface_path.hh"

namespace anisomesh::detail {

/// What is nearest is found by unfolding the triangles around a point as far as the nearest line found so
/// far. [Marinov and Kobbelt 2004, section 4, keep samples in the faces; here the segments themselves]
class SurfaceIndex final : public LineIndex {
 public:
  /// \param fences bounds of the distance to them; may be none \param reach how far what is entered at a
  /// place is seen
  SurfaceIndex(const SurfaceRef& surface, const UnfoldedFaces& faces, const SurfaceDistance* fences,
               std::function<double(const SurfacePoint&)> reach)
      : surface_(surface),
        faces_(faces),
        paths_(surface, faces),
        flood_(faces),
        first_(faces.size(), -1),
        distance_(faces),
        fences_(fences),
        reach_(std::move(reach)) {}

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
  // An end of a segment that is in its faces, but not spread yet.
  struct Pending {
    Vec3d position{0, 0, 0};
    double arc = 0, length = 0;
  };
  void add(int face, const Piece& piece, double reach);
  void spread_pending();
  bool pending_near(const SurfacePoint& at, double bound, double from, double to) const;
  template <class Beyond>
  double nearest_line(const SurfacePoint& at, double bound, int own, double from, double to, Neighbour& best,
                      const Beyond& beyond);
  void nearest_fence(const SurfacePoint& at, double bound, Neighbour& best);

  const SurfaceRef& surface_;
  const UnfoldedFaces& faces_;
  SurfacePaths paths_;
  SurfaceFlood flood_;
  std::vector<int> first_;  // of each face, into pieces_
  std::vector<Piece> pieces_;
  SurfaceDistance distance_;  // to the lines, but for those pending
  std::vector<SurfaceDistance::Source> pending_;
  std::vector<Pending> pending_points_;
  int pending_line_ = -1;
  double pending_arc_ = 0;
  const SurfaceDistance* fences_;
  std::function<double(const SurfacePoint&)> reach_;
};

}  // namespace anisomesh::detail
