// How good a polygon is in space: convex, not folded, well shaped, near the surface.
#pragma once

#include <algorithm>
#include <array>
#include <initializer_list>
#include <map>
#include <vector>

#include "mesher/line_directions.hh"
#include "network/network_graph.hh"

namespace anisomesh::detail {

/// The corners of one region, as the partition sees them.
struct RegionCorners {
  std::vector<int> node;  ///< of the network graph, counter-clockwise in (u, v)
  std::vector<Vec2d> uv;
  std::vector<Vec3d> position;
  std::vector<OpenMesh::FaceHandle> face;  ///< of the surface point; beside features one in the region
  std::vector<Vec3d> corner_normal;        ///< of the surface there; zero on a feature, where it has none
  size_t loop = 0;                         ///< so many of them, the first, go around it
  Vec3d normal{0, 0, 0};                   ///< unit, of the surface inside the region
  bool on_surface = false;                 ///< there is no parameter plane but this region's own
  /// Pairs of corners, the lower first, that have an edge outside the region and must not get another.
  std::vector<std::array<int, 2>> forbidden;
  size_t size() const { return node.size(); }
  void add(const NetworkGraph& network, int n);
  /// Finds the face of a corner on a feature, given the nodes beside it along the border of the region.
  void set_face(const NetworkGraph& network, int before, int corner, int after);
  void forbid(int a, int b) { forbidden.push_back({std::min(a, b), std::max(a, b)}); }
  bool is_forbidden(int a, int b) const {
    return std::find(forbidden.begin(), forbidden.end(),
                     std::array<int, 2>{std::min(a, b), std::max(a, b)}) != forbidden.end();
  }
  /// Whether a chord that bounds the polygon, given by corners, has its edge elsewhere.
  bool has_forbidden(const std::vector<int>& polygon) const {
    for (size_t i = 0; i < polygon.size() && !forbidden.empty(); ++i) {
      const int a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      if (!is_side(a, b) && !is_side(b, a) && is_forbidden(a, b)) return true;
    }
    return false;
  }
  /// Gives corners on features the normals of the pieces at them, which are on one side: the surface has none
  /// there, and a cell that goes around a hole has none as a whole. \param pieces lists of corners, by index
  template <class Pieces>
  void take_normals_of(const Pieces& pieces);
  /// Whether b follows a on the border of the region.
  bool is_side(int a, int b) const {
    const int n = static_cast<int>(loop);
    return a < n && b < n && (a + 1) % n == b;
  }
};

struct JudgeOptions {
  double epsilon = 0;           ///< model units; 0 or infinite: not known, no cost for the error
  double max_error_ratio = 10;  ///< in epsilons: a chord farther from the surface costs no more
  double max_bend_degrees = 0;  ///< a quad bent more along a diagonal is split; 180: never
  double alignment_weight = 1;  ///< of an edge in the middle between two principal directions
};

/// What the chords of one region cost, by their ends in order: to find the middle of one takes time.
using ChordCosts = std::map<std::array<int, 2>, double>;

/// Costs are sums over polygons: about 1 for a square, more for what one would rather not have.
class PolygonJudge {
 public:
  PolygonJudge(const SurfaceRef& surface, const SurfaceLocator& locator, const SurfaceNormals& normals,
               const JudgeOptions& options);

  /// \param known chords of this region that were met before, and those of this triangle then
  double triangle_cost(const RegionCorners& region, int a, int b, int c, ChordCosts* known = nullptr) const;
  double quad_cost(const RegionCorners& region, const std::array<int, 4>& quad) const;
  /// Sum over polygons given as indices of corners; one of more than four corners counts as one square.
  double cost(const RegionCorners& region, const std::vector<std::vector<int>>& polygons) const;
  /// Whether the triangle faces away from the surface at its corners.
  static bool is_folded(const RegionCorners& region, int a, int b, int c);
  /// Distance of the middle of a chord from the surface along the normal, model units.
  double chord_error(const RegionCorners& region, int a, int b) const;
  /// Convex in its plane of best fit, up to a tolerance below the 5 degrees that the result is held to.
  static bool is_convex(const std::vector<Vec3d>& corners);
  /// Whether a corner lies on a side that it is no end of, as where two sides leave a corner the same way: no
  /// turn shows that.
  static bool touches_itself(const std::vector<Vec3d>& corners);
  /// Normal of the surface near a place, see SurfaceLocator.
  Vec3d surface_normal(const Vec2d& uv, const Vec3d& place, OpenMesh::FaceHandle start) const;

 private:
  /// Of an inner side of a polygon, which is a side of two.
  double chord_cost(const RegionCorners& region, int a, int b) const;
  double error_cost(double error) const;
  /// Where the surface is below the middle of a chord; false if beyond its border.
  bool middle_of(const RegionCorners& region, int a, int b, Vec3d& place, SurfacePoint& below) const;
  double error_at(const RegionCorners& region, const Vec3d& place, const SurfacePoint& below) const;
  static int against(const RegionCorners& region, std::initializer_list<int> corners, const Vec3d& area);
  static Vec3d reference_normal(const RegionCorners& region, std::initializer_list<int> corners);

  const SurfaceRef& surface_;
  const SurfaceLocator& locator_;
  const SurfaceNormals& normals_;
  LineDirections directions_;
  JudgeOptions options_;
};

template <class Pieces>
void RegionCorners::take_normals_of(const Pieces& pieces) {
  const auto place = [this](int i) { return position[static_cast<size_t>(i)]; };
  std::vector<Vec3d> sums(size(), Vec3d(0, 0, 0));
  for (const auto& piece : pieces) {
    Vec3d area(0, 0, 0);
    for (size_t i = 1; i + 1 < piece.size(); ++i)
      area += cross(place(piece[i]) - place(piece[0]), place(piece[i + 1]) - place(piece[0]));
    for (const int i : piece) sums[static_cast<size_t>(i)] += area;
  }
  for (size_t i = 0; i < size(); ++i)
    if (corner_normal[i].sqrnorm() == 0 && sums[i].norm() > 0) corner_normal[i] = sums[i].normalized();
}

}  // namespace anisomesh::detail
