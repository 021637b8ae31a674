// Seams that a file leaves open because it has their vertices twice, as at the seams of textures, between
// patches of a parametric surface, or around every face.
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

#include "io/sides.hh"
#include "io/soup.hh"
#include "numerics/disjoint_sets.hh"
#include "numerics/enclosing_sphere.hh"

namespace anisomesh::detail {

namespace {

/// Fraction of the extent within which coordinates that were meant to be the same may have been rounded
/// apart.
constexpr double rounded = 1e-6;

/// Cubes as wide as the distance asked for: what is as near lies in the same one or in one beside it.
struct Cube {
  long long x, y, z;
  bool operator==(const Cube& other) const { return x == other.x && y == other.y && z == other.z; }
};
struct CubeHash {
  size_t operator()(const Cube& c) const {
    const auto mixed = static_cast<unsigned long long>(c.x) * 0x9e3779b97f4a7c15u ^
                       static_cast<unsigned long long>(c.y) * 0xc2b2ae3d27d4eb4fu ^
                       static_cast<unsigned long long>(c.z) * 0x165667b19e3779f9u;
    return static_cast<size_t>(mixed ^ (mixed >> 29));
  }
};

/// Vertices that chains of steps of up to `distance` lead to from one another.
DisjointSets near_ones(const Soup& soup, const std::vector<size_t>& vertices, double distance) {
  DisjointSets near(soup.points.size());
  std::unordered_map<Cube, std::vector<size_t>, CubeHash> cubes;
  const auto cube_of = [&](const Vec3d& p) {
    const auto along = [&](int i) { return std::llround((p[i] - soup.points[vertices[0]][i]) / distance); };
    return Cube{along(0), along(1), along(2)};
  };
  for (const size_t v : vertices) {
    const Cube own = cube_of(soup.points[v]);
    for (long long x = own.x - 1; x <= own.x + 1; ++x)
      for (long long y = own.y - 1; y <= own.y + 1; ++y)
        for (long long z = own.z - 1; z <= own.z + 1; ++z) {
          const auto found = cubes.find({x, y, z});
          if (found == cubes.end()) continue;
          for (const size_t w : found->second)
            if ((soup.points[v] - soup.points[w]).norm() <= distance) near.join(v, w);
        }
    cubes[own].push_back(v);
  }
  return near;
}

/// The border edges that lie on one another, where these are no more than two.
struct Seams {
  size_t edges = 0;
  std::vector<std::pair<size_t, size_t>> ends;  ///< vertices that would be one
};

Seams find_seams(const Soup& soup, double fraction) {
  const Sides sides(soup);
  std::vector<char> inner(soup.corners.size(), 0), is_border(soup.points.size(), 0);
  sides.for_each_pair(soup, [&](size_t a, size_t b) { inner[a] = inner[b] = 1; });
  const auto ends_of = [&](size_t side) {
    return std::array<size_t, 2>{static_cast<size_t>(sides.from(soup, side)),
                                 static_cast<size_t>(sides.to(soup, side))};
  };
  std::vector<size_t> border;
  for (size_t i = 0; i < inner.size(); ++i) {
    if (inner[i]) continue;
    for (const size_t v : ends_of(i))
      if (!std::exchange(is_border[v], 1)) border.push_back(v);
  }
  if (border.empty()) return {};
  const double distance = fraction * enclosing_diameter(soup.points);
  if (!(distance > 0)) return {};
  DisjointSets near = near_ones(soup, border, distance);
  std::map<std::pair<size_t, size_t>, std::vector<size_t>> edges;
  for (size_t i = 0; i < inner.size(); ++i) {
    if (inner[i]) continue;
    const auto [from, to] = ends_of(i);
    const size_t a = near.root(from), b = near.root(to);
    if (a != b) edges[std::minmax(a, b)].push_back(i);
  }
  Seams seams;
  for (const auto& [key, members] : edges) {
    if (members.size() != 2) continue;
    ++seams.edges;
    for (const size_t v : ends_of(members[0]))
      for (const size_t w : ends_of(members[1]))
        if (near.root(v) == near.root(w)) seams.ends.emplace_back(v, w);
  }
  return seams;
}

}  // namespace

// Edge by edge: vertices that are merely in one place, as where two sheets touch, stay apart.
void weld(const Soup& soup, double fraction, DisjointSets& places, ReadReport& report) {
  const Seams seams = find_seams(soup, fraction > 0 ? fraction : rounded);
  if (fraction > 0)
    for (const auto& [v, w] : seams.ends) report.welded_vertices += places.join(v, w);
  else
    report.coincident_edges = seams.edges;
}

}  // namespace anisomesh::detail
