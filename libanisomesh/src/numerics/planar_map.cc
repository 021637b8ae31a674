#include "numerics/planar_map.hh"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "numerics/tensor2d.hh"

namespace anisomesh::detail {

namespace {

// Twice the area over the square of the longest edge must be above this: far above rounding, far below what a
// proper triangle has.
constexpr double least_thickness = 1e-9;
// Coordinates are rounded to 2^-53 of the map's extent. The longest edge of a triangle must be far above
// that.
constexpr double least_length = 1e-12;

/// Tells invalid triangles of one map.
class Validity {
 public:
  explicit Validity(const std::vector<Vec2d>& map) {
    Vec2d low = map.front(), high = map.front();
    for (const Vec2d& p : map) {
      low.minimize(p);
      high.maximize(p);
    }
    shortest_squared_ = least_length * least_length * (high - low).sqrnorm();
  }

  bool is_invalid(const Patch& patch, const std::vector<Vec2d>& map, size_t t) const {
    const auto& triangle = patch.triangles[t];
    const Vec2d &a = map[static_cast<size_t>(triangle[0])], &b = map[static_cast<size_t>(triangle[1])],
                &c = map[static_cast<size_t>(triangle[2])];
    const Vec2d ab = b - a, ac = c - a, bc = c - b;
    const double longest = std::max({ab.sqrnorm(), ac.sqrnorm(), bc.sqrnorm()});
    return !(cross2(ab, ac) > least_thickness * longest) || !(longest > shortest_squared_);
  }

 private:
  double shortest_squared_;
};

struct Segment {
  Vec2d low, high;  ///< by x
  size_t index;     ///< along the border
};

/// Which side of the line through a and b; 0 where rounding might decide.
int side(const Vec2d& a, const Vec2d& b, const Vec2d& p) {
  const Vec2d ab = b - a, ap = p - a;
  const double margin = 1e-12 * (std::abs(ab[0]) + std::abs(ab[1])) * (std::abs(ap[0]) + std::abs(ap[1]));
  const double value = cross2(ab, ap);
  return value > margin ? 1 : value < -margin ? -1 : 0;
}

bool boxes_meet(const Segment& a, const Segment& b) {
  const auto range_y = [](const Segment& s) { return std::minmax(s.low[1], s.high[1]); };
  const auto [a_low, a_high] = range_y(a);
  const auto [b_low, b_high] = range_y(b);
  return a_low <= b_high && b_low <= a_high && a.low[0] <= b.high[0] && b.low[0] <= a.high[0];
}

bool segments_meet(const Segment& a, const Segment& b) {
  return boxes_meet(a, b) && side(a.low, a.high, b.low) * side(a.low, a.high, b.high) <= 0 &&
         side(b.low, b.high, a.low) * side(b.low, b.high, a.high) <= 0;
}

/// Two neighbouring edges meet in more than their common vertex only if the curve turns back on itself.
bool folds_back(const Vec2d& before, const Vec2d& corner, const Vec2d& after) {
  return side(corner, before, after) == 0 && ((before - corner) | (after - corner)) > 0;
}

/// The triangles around each vertex, as one array with offsets.
struct Stars {
  std::vector<int> offset, triangle;
  explicit Stars(const Patch& patch) : offset(patch.points.size() + 1, 0) {
    for (const auto& t : patch.triangles)
      for (const int v : t) ++offset[static_cast<size_t>(v) + 1];
    std::partial_sum(offset.begin(), offset.end(), offset.begin());
    triangle.resize(static_cast<size_t>(offset.back()));
    auto next = offset;
    for (size_t t = 0; t < patch.triangles.size(); ++t)
      for (const int v : patch.triangles[t])
        triangle[static_cast<size_t>(next[static_cast<size_t>(v)]++)] = static_cast<int>(t);
  }
};

/// Moves vertices towards where their neighbours want them.
class Relaxation {
 public:
  Relaxation(const Patch& patch, const std::vector<TriangleShape>& shapes, std::vector<Vec2d>& map)
      : patch_(patch),
        shapes_(shapes),
        map_(map),
        validity_(map),
        stars_(patch),
        on_border_(patch.points.size(), false) {
    for (const int b : patch.border) on_border_[static_cast<size_t>(b)] = true;
  }

  /// The vertices of the triangles and of `rings` rings around them, ascending.
  std::vector<int> region(const std::vector<int>& triangles, int rings) const {
    std::vector<int> vertices;
    for (const int t : triangles)
      for (const int v : patch_.triangles[static_cast<size_t>(t)]) vertices.push_back(v);
    unique(vertices);
    for (int ring = 0; ring < rings; ++ring) {
      std::vector<int> grown = vertices;
      for (const int v : vertices)
        for_star(v, [&](size_t t, size_t) {
          for (const int w : patch_.triangles[t]) grown.push_back(w);
        });
      unique(grown);
      vertices = std::move(grown);
    }
    return vertices;
  }

  void sweep(const std::vector<int>& vertices, int times) {
    for (int i = 0; i < times; ++i)
      for (const int v : vertices) {
        if (on_border_[static_cast<size_t>(v)])
          move_border_vertex(v);
        else
          map_[static_cast<size_t>(v)] = mean_value(v);
      }
  }

 private:
  static void unique(std::vector<int>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
  }

  template <class F>
  void for_star(int vertex, F&& visit) const {
    for (int k = stars_.offset[static_cast<size_t>(vertex)];
         k < stars_.offset[static_cast<size_t>(vertex) + 1]; ++k) {
      const auto t = static_cast<size_t>(stars_.triangle[static_cast<size_t>(k)]);
      for (size_t i = 0; i < 3; ++i)
        if (patch_.triangles[t][i] == vertex) visit(t, i);
    }
  }

  /// Floater's mean value coordinates of the vertex among its neighbours on the surface: positive, so it
  /// stays inside their hull. [Floater, Mean value coordinates, 2003]
  Vec2d mean_value(int vertex) const {
    Vec2d sum(0, 0);
    double weights = 0;
    for_star(vertex, [&](size_t t, size_t i) {
      const double half = std::tan(0.5 * shapes_[t].angle[i]);
      for (const size_t k : {(i + 1) % 3, (i + 2) % 3}) {
        const auto other = static_cast<size_t>(patch_.triangles[t][k]);
        const double length = (patch_.points[other] - patch_.points[static_cast<size_t>(vertex)]).norm();
        const double weight = half / std::max(length, 1e-9 * std::sqrt(shapes_[t].area));
        sum += weight * map_[other];
        weights += weight;
      }
    });
    return weights > 0 ? sum / weights : map_[static_cast<size_t>(vertex)];
  }

  /// A border vertex of an invalid triangle goes where its triangles, similar to those of the surface, would
  /// have it over their opposite edges.
  void move_border_vertex(int vertex) {
    bool wrong = false;
    Vec2d sum(0, 0);
    double weights = 0;
    for_star(vertex, [&](size_t t, size_t i) {
      wrong = wrong || validity_.is_invalid(patch_, map_, t);
      const Vec2d& a = map_[static_cast<size_t>(patch_.triangles[t][(i + 1) % 3])];
      const Vec2d& b = map_[static_cast<size_t>(patch_.triangles[t][(i + 2) % 3])];
      const double cot_a = shapes_[t].cotangent[(i + 1) % 3], cot_b = shapes_[t].cotangent[(i + 2) % 3];
      const double height = 1 / (cot_a + cot_b);  // over the edge's length
      const Vec2d along = b - a;
      sum += a + along * (cot_a * height) + Vec2d(-along[1], along[0]) * height;
      weights += 1;
    });
    if (wrong) map_[static_cast<size_t>(vertex)] = sum / weights;
  }

  const Patch& patch_;
  const std::vector<TriangleShape>& shapes_;
  std::vector<Vec2d>& map_;
  Validity validity_;
  Stars stars_;
  std::vector<bool> on_border_;
};

}  // namespace

double signed_area(const Patch& patch, const std::vector<Vec2d>& map, size_t triangle) {
  const auto& t = patch.triangles[triangle];
  const Vec2d &a = map[static_cast<size_t>(t[0])], &b = map[static_cast<size_t>(t[1])],
              &c = map[static_cast<size_t>(t[2])];
  return 0.5 * cross2(b - a, c - a);
}

std::vector<int> invalid_triangles(const Patch& patch, const std::vector<Vec2d>& map) {
  const Validity validity(map);
  std::vector<int> invalid;
  for (size_t t = 0; t < patch.triangles.size(); ++t)
    if (validity.is_invalid(patch, map, t)) invalid.push_back(static_cast<int>(t));
  return invalid;
}

bool border_is_simple(const Patch& patch, const std::vector<Vec2d>& map) {
  const size_t n = patch.border.size();
  const auto place = [&](size_t i) -> const Vec2d& { return map[static_cast<size_t>(patch.border[i % n])]; };
  std::vector<Segment> segments;
  for (size_t i = 0; i < n; ++i) {
    if (folds_back(place(i), place(i + 1), place(i + 2))) return false;
    Segment s{place(i), place(i + 1), i};
    if (s.low[0] > s.high[0]) std::swap(s.low, s.high);
    segments.push_back(s);
  }
  std::sort(segments.begin(), segments.end(),
            [](const Segment& a, const Segment& b) { return a.low[0] < b.low[0]; });
  std::vector<const Segment*> open;  // those the sweep line has entered and not yet left
  for (const Segment& s : segments) {
    open.erase(
        std::remove_if(open.begin(), open.end(), [&](const Segment* o) { return o->high[0] < s.low[0]; }),
        open.end());
    for (const Segment* o : open) {
      const size_t gap = (s.index + n - o->index) % n;
      if (gap != 1 && gap != n - 1 && segments_meet(s, *o)) return false;
    }
    open.push_back(&s);
  }
  return true;
}

bool repair(const Patch& patch, const std::vector<TriangleShape>& shapes, std::vector<Vec2d>& map) {
  auto invalid = invalid_triangles(patch, map);
  if (invalid.empty()) return true;
  Relaxation relaxation(patch, shapes, map);
  for (const int rings : {0, 0, 1, 1, 2, 2, 3, 4, 6, 8, 12, 16}) {
    relaxation.sweep(relaxation.region(invalid, rings), 20 + 4 * rings);
    invalid = invalid_triangles(patch, map);
    if (invalid.empty()) return true;
  }
  return false;
}

}  // namespace anisomesh::detail
