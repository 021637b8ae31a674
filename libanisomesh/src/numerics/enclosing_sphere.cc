// Farthest first [Gaertner 1999]: the sphere of a few points grows by the one that is farthest outside, until
// none is. It strictly grows, so that it ends, after ten to twenty looks at all points on most surfaces.
#include "numerics/enclosing_sphere.hh"

#include <algorithm>
#include <cmath>
#include <limits>

namespace anisomesh::detail {

namespace {

using OpenMesh::Vec3d;

constexpr double kRounding = 1e-15;  // of the radius
constexpr int kMostSteps = 1000;     // never needed but where rounding would let it go round

struct Sphere {
  Vec3d centre{0, 0, 0};
  double radius = std::numeric_limits<double>::infinity();
};

/// Coordinates that are exact multiples by a power of two: of the size of 1, so that nothing underflows.
class Frame {
 public:
  explicit Frame(const std::vector<Vec3d>& points) : low_(points.front()) {
    Vec3d high = low_;
    for (const Vec3d& p : points) {
      low_.minimize(p);
      high.maximize(p);
    }
    const Vec3d extent = high - low_;
    exponent_ = std::ilogb(std::max({extent[0], extent[1], extent[2]}));
    unit_ = std::ldexp(1.0, -exponent_);
    middle_ = 0.5 * unit_ * extent;
  }
  Vec3d place(const Vec3d& point) const { return unit_ * (point - low_); }
  const Vec3d& middle() const { return middle_; }
  double length(double here) const { return std::ldexp(here, exponent_); }

 private:
  Vec3d low_, middle_;
  int exponent_ = 0;
  double unit_ = 1;
};

bool comes_before(const Vec3d& a, const Vec3d& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// The point farthest from a place; of several the first by its coordinates, not by its number.
Vec3d farthest(const std::vector<Vec3d>& points, const Frame& frame, const Vec3d& from) {
  Vec3d best = from;
  double most = -1;
  for (const Vec3d& point : points) {
    const Vec3d p = frame.place(point);
    const double squared = (p - from).sqrnorm();
    if (squared < most || (squared == most && !comes_before(p, best))) continue;
    most = squared;
    best = p;
  }
  return best;
}

/// The centre of the smallest sphere through two to four points; not finite where they have none.
Vec3d centre_through(const std::vector<Vec3d>& points) {
  const Vec3d &o = points[0], a = points[1] - o;
  if (points.size() == 2) return o + 0.5 * a;
  const Vec3d b = points[2] - o, n = a % b;
  if (points.size() == 3) return o + (a.sqrnorm() * (b % n) + b.sqrnorm() * (n % a)) / (2 * n.sqrnorm());
  const Vec3d c = points[3] - o;
  return o + (a.sqrnorm() * (b % c) + b.sqrnorm() * (c % a) + c.sqrnorm() * n) / (2 * (a | (b % c)));
}

/// The smallest sphere around a basis of up to four points and one outside, which lies on it: through that
/// one and some of the others, which are the next basis. No tolerance decides who lies inside: each candidate
/// grows until all do.
Sphere around(std::vector<Vec3d>& basis, const Vec3d& outside) {
  Sphere best;
  std::vector<Vec3d> best_basis, chosen;
  for (unsigned set = 1; set < 1u << basis.size(); ++set) {
    chosen.assign(1, outside);
    for (size_t i = 0; i < basis.size(); ++i)
      if (set >> i & 1) chosen.push_back(basis[i]);
    if (chosen.size() > 4) continue;
    const Vec3d centre = centre_through(chosen);
    double radius = (outside - centre).norm();
    for (const Vec3d& p : basis) radius = std::max(radius, (p - centre).norm());
    if (!(radius < best.radius)) continue;  // nor where it is not a number
    best = {centre, radius};
    best_basis = chosen;
  }
  basis = std::move(best_basis);
  return best;
}

}  // namespace

double enclosing_diameter(const std::vector<Vec3d>& points) {
  const Frame frame(points);
  std::vector<Vec3d> basis{farthest(points, frame, frame.middle())};
  Sphere sphere{basis.front(), 0};
  double enough = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kMostSteps; ++step) {
    const Vec3d next = farthest(points, frame, sphere.centre);
    const double needed = (next - sphere.centre).norm(), before = sphere.radius;
    enough = std::min(enough, needed);
    if (needed <= before * (1 + kRounding)) break;
    sphere = around(basis, next);
    if (!(sphere.radius > before) || basis.empty()) break;
  }
  return frame.length(2 * enough);
}

}  // namespace anisomesh::detail
