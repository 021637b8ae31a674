#include "numerics/hole_triangulation.hh"

#include <algorithm>
#include <cmath>
#include <limits>

namespace anisomesh::detail {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

struct Weight {
  double bend = 0;  // the sharpest, radians
  double area = 0;
  bool operator<(const Weight& o) const { return bend != o.bend ? bend < o.bend : area < o.area; }
};

class HoleTriangulation {
 public:
  HoleTriangulation(const HoleRim& rim, double most_bend, const std::function<bool(int, int)>& forbidden)
      : rim_(rim), size_(static_cast<int>(rim.corner.size())), most_bend_(most_bend), forbidden_(forbidden) {}

  std::vector<std::array<int, 3>> run() {
    const auto n = static_cast<size_t>(size_);
    weight_.assign(n * n, {});
    apex_.assign(n * n, -1);
    for (int span = 2; span < size_; ++span)
      for (int i = 0; i + span < size_; ++i) choose_apex(i, i + span);
    std::vector<std::array<int, 3>> triangles;
    if (apex_[at(0, size_ - 1)] >= 0) collect(0, size_ - 1, triangles);
    return triangles;
  }

 private:
  size_t at(int i, int k) const {
    return static_cast<size_t>(i) * static_cast<size_t>(size_) + static_cast<size_t>(k);
  }
  const Vec3d& corner(int i) const { return rim_.corner[static_cast<size_t>(i)]; }

  // The best triangle at the chord from i to k, over what is best on its other two sides.
  void choose_apex(int i, int k) {
    Weight best{kNever, kNever};
    const bool closing = i == 0 && k == size_ - 1;
    if (closing || !forbidden_(i, k))
      for (int m = i + 1; m < k; ++m) {
        const Weight& left = weight_[at(i, m)];
        const Weight& right = weight_[at(m, k)];
        if (left.bend == kNever || right.bend == kNever) continue;
        const Vec3d normal = (corner(m) - corner(i)) % (corner(k) - corner(i));
        const double longest2 =
            std::max({(corner(m) - corner(i)).sqrnorm(), (corner(k) - corner(m)).sqrnorm(),
                      (corner(i) - corner(k)).sqrnorm()});
        if (!(normal.norm() > 1e-9 * longest2)) continue;
        double bend = std::max({left.bend, right.bend, bend_across(i, m, normal), bend_across(m, k, normal)});
        if (closing) bend = std::max(bend, angle(normal, normal_beyond(size_ - 1)));
        if (bend > most_bend_) continue;
        const Weight weight{bend, left.area + right.area + normal.norm()};
        if (weight < best) {
          best = weight;
          apex_[at(i, k)] = m;
        }
      }
    weight_[at(i, k)] = best;
  }

  static double angle(const Vec3d& a, const Vec3d& b) {
    if (a.sqrnorm() == 0 || b.sqrnorm() == 0) return 0;  // a face without area bends nothing
    return std::atan2((a % b).norm(), a | b);
  }
  Vec3d normal_beyond(int i) const {
    const Vec3d &a = corner((i + 1) % size_), &b = corner(i);
    return (b - a) % (rim_.beyond[static_cast<size_t>(i)] - a);
  }
  // Between a triangle and what lies across its side from i to k.
  double bend_across(int i, int k, const Vec3d& normal) const {
    if (k == i + 1) return angle(normal, normal_beyond(i));
    const int m = apex_[at(i, k)];
    return angle(normal, (corner(m) - corner(i)) % (corner(k) - corner(i)));
  }

  void collect(int i, int k, std::vector<std::array<int, 3>>& triangles) const {
    if (k == i + 1) return;
    const int m = apex_[at(i, k)];
    triangles.push_back({i, m, k});
    collect(i, m, triangles);
    collect(m, k, triangles);
  }

  const HoleRim& rim_;
  int size_;
  double most_bend_;
  const std::function<bool(int, int)>& forbidden_;
  std::vector<Weight> weight_;  // of the loop from corner i to corner k and straight back
  std::vector<int> apex_;       // of the triangle at its chord
};

}  // namespace

std::vector<std::array<int, 3>> triangulate_hole(const HoleRim& rim, double most_degrees,
                                                 const std::function<bool(int, int)>& forbidden) {
  return HoleTriangulation(rim, most_degrees * 3.14159265358979323846 / 180, forbidden).run();
}

}  // namespace anisomesh::detail
