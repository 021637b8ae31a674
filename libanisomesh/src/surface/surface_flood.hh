// The surroundings of a surface point, unfolded: the discrete exponential map.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include "surface/unfolded_faces.hh"

namespace anisomesh::detail {

/// Visits the faces around a point, the nearest first, each unfolded along the way it was reached by. Fences
/// are not crossed. What is near in space but far along the surface is not reached. Keeps its scratch memory
/// from one run to the next: one thread at a time.
class SurfaceFlood {
 public:
  explicit SurfaceFlood(const UnfoldedFaces& faces) : faces_(faces), seen_(faces.size(), 0) {}

  struct Visit {
    int face = -1;
    Vec2d place{0, 0};    ///< the point that all is seen from, in the frame of the face
    Vec2d turn{1, 0};     ///< takes vectors of the frame of the start to that of the face
    double distance = 0;  ///< to the edge that the face was reached by
    int parent = -1;      ///< into visits()
    int entered = -1;     ///< the corner opposite that edge
  };

  /// \param visit called with each Visit, gives the radius that is still of interest
  template <class OnVisit>
  void run(const SurfacePoint& start, double radius, OnVisit&& visit) {
    search(start, radius, visit, [](int) { return 0.0; });
  }

  /// The same for the sake of something whose distance is known from below: leaves out the faces from which
  /// it is too far. \param beyond the bound for a face, which may ask for the distance it is reached at
  /// \param straight visits first what seems to be on the
  /// way there; a face may then be reached by a way that is not the shortest
  template <class OnVisit, class Beyond>
  void search(const SurfacePoint& start, double radius, OnVisit&& visit, Beyond&& beyond,
              bool straight = false) {
    straight_ = straight;
    if (++run_ == 0) {
      std::fill(seen_.begin(), seen_.end(), 0);
      run_ = 1;
    }
    visits_.clear();
    open_.clear();
    if (!(bound(beyond, start.face.idx(), 0) < radius)) return;
    take({start.face.idx(), faces_.place(start), {1, 0}, 0, -1, -1}, radius, visit, beyond);
    while (!open_.empty()) {
      std::pop_heap(open_.begin(), open_.end());
      const Open next = open_.back();
      open_.pop_back();
      if (!(next.key < (1 + kAside) * radius)) break;
      if (!(next.at_least < radius)) continue;
      const Visit& from = visits_[static_cast<size_t>(next.visit)];
      const int face = faces_.across(from.face, next.edge);
      if (seen_[static_cast<size_t>(face)] == run_) continue;
      take({face, faces_.carried(from.face, next.edge, from.place),
            turned_by(from.turn, faces_.turn(from.face, next.edge)), next.distance, next.visit,
            faces_.twin(from.face, next.edge)},
           radius, visit, beyond);
    }
  }

  const std::vector<Visit>& visits() const { return visits_; }

 private:
  struct Open {
    double key = 0, at_least = 0, distance = 0;
    int visit = 0, edge = 0;
    bool operator<(const Open& o) const {  // a heap has the largest on top
      return key != o.key ? key > o.key : visit > o.visit;
    }
  };

  /// Edges that meet in the vertex nearest to the start are equally far. Which of them is crossed first
  /// decides how what lies behind is unfolded, and must not be left to rounding: that whose middle is nearer.
  static constexpr double kAside = 1e-3;
  double aside(const Visit& visit, int edge, double distance) const {
    const Vec2d middle =
        0.5 * (faces_.corner(visit.face, (edge + 1) % 3) + faces_.corner(visit.face, (edge + 2) % 3));
    const double away = (middle - visit.place).norm();
    return away > distance ? 1 - distance / away : 0;  // in [0, 1]
  }

  template <class Beyond>
  static double bound(Beyond&& beyond, int face, double distance) {
    if constexpr (std::is_invocable_v<Beyond, int, double>)
      return beyond(face, distance);
    else
      return beyond(face);
  }

  template <class OnVisit, class Beyond>
  void take(const Visit& visit, double& radius, OnVisit&& on_visit, Beyond&& beyond) {
    seen_[static_cast<size_t>(visit.face)] = run_;
    visits_.push_back(visit);
    radius = on_visit(visits_.back());
    for (int i = 0; i < 3; ++i) {
      if (i == visit.entered) continue;
      const int next = faces_.across(visit.face, i);
      if (next < 0 || seen_[static_cast<size_t>(next)] == run_) continue;
      double unused = 0;
      const double distance =
          std::max(visit.distance, std::sqrt(faces_.edge_distance2(visit.face, i, visit.place, unused)));
      const double at_least = distance + bound(beyond, next, distance);
      if (!(at_least < radius)) continue;
      open_.push_back({(straight_ ? at_least : distance) * (1 + kAside * aside(visit, i, distance)), at_least,
                       distance, static_cast<int>(visits_.size()) - 1, i});
      std::push_heap(open_.begin(), open_.end());
    }
  }

  const UnfoldedFaces& faces_;
  std::vector<unsigned> seen_;
  unsigned run_ = 0;
  bool straight_ = false;
  std::vector<Visit> visits_;
  std::vector<Open> open_;
};

}  // namespace anisomesh::detail
