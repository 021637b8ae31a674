#include "balance/uncross.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "balance/patch_partition.hh"
#include "numerics/self_intersections.hh"
#include "surface/rounding.hh"

namespace anisomesh::detail {

namespace {

using Polygons = std::vector<std::vector<int>>;
size_t at(int i) { return static_cast<size_t>(i); }

constexpr int max_rounds = 3;
/// Where more pairs cross, and more than this share of the polygons, sheets lie on each other or noise folds
/// them, and what is mended at one place comes up again at the next.
constexpr size_t few_pairs = 20;
constexpr double few_share = 0.05;
/// So many pairs for each triangle are of a surface that is crumpled all over: each is not worth knowing.
constexpr size_t crumpled = 10;

/// Pairs that cross; none are told of where there are too many.
std::vector<std::pair<int, int>> pairs_of(const PolygonSoup& soup) {
  const size_t most = few_pairs + crumpled * soup.triangles.size();
  auto pairs = crossing_triangles(soup, most);
  if (pairs.size() >= most) pairs.clear();
  return pairs;
}

/// Where the surface crosses itself. Looked at where it is asked for, as that is in few places.
class OwnCrossings {
 public:
  explicit OwnCrossings(const TriangleTree& tree) : tree_(tree), known_(tree.triangles().size(), unknown) {}

  /// Whether a triangle that meets what two boxes have in common crosses another.
  bool has_one_at(Box a, const Box& b) {
    a.low.maximize(b.low);
    a.high.minimize(b.high);
    return tree_.any_near(a, [&](int t) { return crosses(t); });
  }

 private:
  enum Known : char { unknown, no, yes };
  bool crosses(int t) {
    char& known = known_[at(t)];
    if (known != unknown) return known == yes;
    const auto corners = tree_.corners_of(t);
    const bool any = tree_.any_near(tree_.box_of(t),
                                    [&](int u) { return u != t && do_cross(corners, tree_.corners_of(u)); });
    known = any ? yes : no;
    return any;
  }

  const TriangleTree& tree_;
  std::vector<char> known_;
};

class Uncrosser {
 public:
  Uncrosser(const SurfaceRef& surface, const FaceJudge& judge, const OpenMesh::PolyMesh& result)
      : surface_(surface), judge_(judge), mesh_(result), of_surface_(judge.reference().tree) {}

  /// \return whether anything has changed
  bool run();
  OpenMesh::PolyMesh mesh() const { return mesh_.mesh(); }

 private:
  PolygonSoup soup_of(const Polygons& polygons) const;
  Box box_of(const std::vector<int>& polygon) const;
  bool is_of_surface(const std::array<int, 2>& pair);
  std::vector<std::array<int, 2>> pairs();
  Polygons at_numbers(const std::vector<int>& numbers) const;
  Polygons beside(const std::vector<int>& numbers, const Polygons& own) const;
  size_t crossings(const Polygons& changed, const Polygons& others) const;
  size_t broken(const Polygons& changed, const Polygons& others) const;
  bool is_taken(const Vec3d& place, const Polygons& others) const;
  bool move_corners(int polygon);
  bool part_anew(int polygon);
  std::vector<Polygons> partitions(const PatchMesh::Patch& patch) const;

  const SurfaceRef& surface_;
  const FaceJudge& judge_;
  PatchMesh mesh_;
  OwnCrossings of_surface_;
  double limit_ = 0;  // distance that some place has when this begins
};

/// With the vertices of these polygons only.
PolygonSoup Uncrosser::soup_of(const Polygons& polygons) const {
  std::map<int, int> number;
  std::vector<Vec3d> points;
  Polygons faces = polygons;
  for (auto& face : faces)
    for (int& v : face) {
      const auto [found, is_new] = number.try_emplace(v, static_cast<int>(points.size()));
      if (is_new) points.push_back(mesh_.point(v));
      v = found->second;
    }
  return {std::move(points), std::move(faces), FaceDiagonal::shorter};
}

Box Uncrosser::box_of(const std::vector<int>& polygon) const {
  Box box;
  for (const int v : polygon) box.add(mesh_.point(v));
  return box;
}

bool Uncrosser::is_of_surface(const std::array<int, 2>& pair) {
  return of_surface_.has_one_at(box_of(mesh_.polygons()[at(pair[0])]), box_of(mesh_.polygons()[at(pair[1])]));
}

/// Polygons that cross where the surface does not.
std::vector<std::array<int, 2>> Uncrosser::pairs() {
  Polygons polygons;
  std::vector<int> number;
  for (size_t p = 0; p < mesh_.polygons().size(); ++p) {
    if (mesh_.polygons()[p].empty()) continue;
    polygons.push_back(mesh_.polygons()[p]);
    number.push_back(static_cast<int>(p));
  }
  const PolygonSoup soup = soup_of(polygons);
  std::vector<std::array<int, 2>> result;
  for (const auto& [t, u] : pairs_of(soup)) {
    const int p = soup.face_of[at(t)], q = soup.face_of[at(u)];
    result.push_back({number[at(p)], number[at(q)]});
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  result.erase(
      std::remove_if(result.begin(), result.end(), [&](const auto& pair) { return is_of_surface(pair); }),
      result.end());
  return result;
}

Polygons Uncrosser::at_numbers(const std::vector<int>& numbers) const {
  Polygons result;
  for (const int p : numbers) result.push_back(mesh_.polygons()[at(p)]);
  return result;
}

/// All other polygons whose boxes overlap that of these.
Polygons Uncrosser::beside(const std::vector<int>& numbers, const Polygons& own) const {
  Box box;
  for (const auto& polygon : own) box.add(box_of(polygon));
  Polygons result;
  for (size_t p = 0; p < mesh_.polygons().size(); ++p) {
    const auto& polygon = mesh_.polygons()[p];
    if (polygon.empty() || std::find(numbers.begin(), numbers.end(), static_cast<int>(p)) != numbers.end())
      continue;
    if (box.meets(box_of(polygon))) result.push_back(polygon);
  }
  return result;
}

/// How many pairs of triangles cross of which one is of a polygon that is changed.
size_t Uncrosser::crossings(const Polygons& changed, const Polygons& others) const {
  Polygons all = changed;
  all.insert(all.end(), others.begin(), others.end());
  const PolygonSoup soup = soup_of(all);
  size_t count = 0;
  for (const auto& [t, u] : crossing_triangles(soup))
    count += std::min(soup.face_of[at(t)], soup.face_of[at(u)]) < static_cast<int>(changed.size());
  return count;
}

size_t Uncrosser::broken(const Polygons& changed, const Polygons& others) const {
  Polygons all = changed;
  all.insert(all.end(), others.begin(), others.end());
  return count_marked(judge_.broken(soup_of(all)));
}

/// Partitions of a patch, as vertices: with quads, without, and a quad along either diagonal.
std::vector<Polygons> Uncrosser::partitions(const PatchMesh::Patch& patch) const {
  std::vector<Polygons> result;
  const size_t n = patch.ring.size();
  const auto forbidden = mesh_.forbidden_chords(patch);
  std::vector<Vec3d> ring;
  for (const int v : patch.ring) ring.push_back(mesh_.point(v));
  const Vec3d normal = view_normal(judge_.reference(), mesh_, patch);
  PatchCosts costs;
  costs.triangle = 1;
  for (const bool quads : {true, false}) {
    costs.quads = quads;
    const PatchView view(normal, {}, Vec6d(0, 0, 0, 0, 0, 0), costs);
    result.push_back(partition_ring(view, ring, forbidden).pieces);
    for (auto& piece : result.back())
      for (int& i : piece) i = patch.ring[at(i)];
  }
  for (size_t first = 0; n == 4 && first < 2; ++first) {
    const auto corner = [&](size_t i) { return patch.ring[(first + i) % 4]; };
    if (!forbidden[first * n + first + 2])
      result.push_back({{corner(0), corner(1), corner(2)}, {corner(0), corner(2), corner(3)}});
  }
  result.erase(std::remove_if(result.begin(), result.end(), [](const auto& p) { return p.empty(); }),
               result.end());
  return result;
}

/// The partition that takes out most crossings, the first of several, of those that are no farther from the
/// surface than what is there, or than some place of the result is.
bool Uncrosser::part_anew(int polygon) {
  PatchMesh::Patch best;
  Polygons best_pieces;
  long most = 0;
  for (const PatchMesh::Patch& patch : patches_around(mesh_, polygon)) {
    if (patch.ring.size() < 4 || patch.ring.size() > most_corners) continue;
    const Polygons old = at_numbers(patch.polygons), others = beside(patch.polygons, old);
    const auto before = static_cast<long>(crossings(old, others));
    const double far = before > most ? std::max(limit_, judge_.farthest(soup_of(old))) : limit_;
    for (const Polygons& pieces : partitions(patch)) {
      if (before <= most || !mesh_.may_replace(patch, pieces)) continue;
      const long fewer = before - static_cast<long>(crossings(pieces, others));
      if (fewer <= most || broken(pieces, others) > broken(old, others) ||
          judge_.farthest(soup_of(pieces)) > far + kRounding * judge_.reference().diagonal)
        continue;
      most = fewer;
      best = patch;
      best_pieces = pieces;
    }
  }
  if (most > 0) mesh_.replace(best, best_pieces);
  return most > 0;
}

/// Whether a corner is there: in one place with it, polygons would cross no more and share an edge instead.
bool Uncrosser::is_taken(const Vec3d& place, const Polygons& others) const {
  return std::any_of(others.begin(), others.end(), [&](const auto& polygon) {
    return std::any_of(polygon.begin(), polygon.end(), [&](int v) { return mesh_.point(v) == place; });
  });
}

bool Uncrosser::move_corners(int polygon) {
  const std::vector<int> corners = mesh_.polygons()[at(polygon)];
  for (const double share : {0.5, 1.0})
    for (const int v : corners) {
      const auto& vertex = mesh_.vertices()[at(v)];
      const Vec3d here = vertex.point, source = position(surface_, vertex.source);
      if (vertex.on_curve || here == source) continue;
      const Polygons own = at_numbers(vertex.polygons);
      const Vec3d there = here + share * (source - here);
      const Polygons others = beside(vertex.polygons, own);
      const size_t crossed = crossings(own, others), worse = broken(own, others);
      mesh_.move(v, there);
      const Polygons met = beside(vertex.polygons, own);
      if (!is_taken(there, met) && crossings(own, met) < crossed && broken(own, met) <= worse) return true;
      mesh_.move(v, here);
    }
  return false;
}

bool Uncrosser::run() {
  bool any = false;
  auto found = pairs();
  if (static_cast<double>(found.size()) >
      few_pairs + few_share * static_cast<double>(mesh_.polygons().size()))
    return false;
  if (!found.empty()) {
    Polygons polygons = mesh_.polygons();
    polygons.erase(std::remove_if(polygons.begin(), polygons.end(), [](const auto& p) { return p.empty(); }),
                   polygons.end());
    limit_ = judge_.farthest(soup_of(polygons));
  }
  for (int round = 0; round < max_rounds && !found.empty(); ++round) {
    bool changed = false;
    for (const auto& pair : found)
      for (const bool moves : {true, false}) {
        const auto stay = [&](int p) { return !mesh_.polygons()[at(p)].empty(); };
        if (!stay(pair[0]) || !stay(pair[1])) break;
        if (crossings({mesh_.polygons()[at(pair[0])]}, {mesh_.polygons()[at(pair[1])]}) == 0) break;
        const bool done =
            moves ? move_corners(pair[0]) || move_corners(pair[1]) : part_anew(pair[0]) || part_anew(pair[1]);
        changed = changed || done;
      }
    any = any || changed;
    if (!changed) break;
    found = pairs();
  }
  return any;
}

}  // namespace

void uncross(const SurfaceRef& surface, const FaceJudge& judge, OpenMesh::PolyMesh& result) {
  Uncrosser uncrosser(surface, judge, result);
  if (uncrosser.run()) result = uncrosser.mesh();
}

}  // namespace anisomesh::detail
