// How far each face at least is from something on the surface.
#pragma once

#include <limits>
#include <vector>

#include "surface/unfolded_faces.hh"

namespace anisomesh::detail {

/// Lower bounds of distances along the surface, from any point of a face to the nearest source that reaches
/// it. Searches go by them straight to what is nearest, or end at once.
class SurfaceDistance {
 public:
  explicit SurfaceDistance(const UnfoldedFaces& faces)
      : faces_(faces), bound_(faces.size(), std::numeric_limits<float>::infinity()) {}

  double operator()(int face) const {
    return kSlack * static_cast<double>(bound_[static_cast<size_t>(face)]);
  }

  /// Everything of a face within `radius` of a place in its frame is a source from now on.
  struct Source {
    int face = -1;
    Vec2d place{0, 0};
    double radius = 0;
    double reach = 0;  ///< no farther than this is anyone told, model units
  };
  void add(const std::vector<Source>& sources);

 private:
  // Two ways around a vertex unfold differently: what one of them gives is a bound for the other nearly.
  static constexpr double kSlack = 0.9;

  struct Front {
    float distance = 0;
    int face = -1, entered = -1;
    Vec2d place{0, 0};
    double radius = 0, reach = 0;
    bool operator<(const Front& o) const {  // a heap has the largest on top
      return distance != o.distance ? distance > o.distance : face > o.face;
    }
  };
  void spread(const Front& from);

  const UnfoldedFaces& faces_;
  std::vector<float> bound_;
  std::vector<Front> fronts_;
};

}  // namespace anisomesh::detail
