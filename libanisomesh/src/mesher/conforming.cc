#include "mesher/conforming.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "numerics/convex_partition.hh"
#include "surface/rounding.hh"

namespace anisomesh::detail {

namespace {

using Piece = std::vector<int>;
size_t at(int i) { return static_cast<size_t>(i); }

// Up to so many corners all partitions are tried (n^4 / 24 quads); beyond, the region is cut up first.
constexpr size_t search_limit = 20;
// A choice that is better only by rounding is no better than the one found first.
constexpr double no_better = 1e-8;

double turn(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}
// Left turn that is no rounding and no straight line.
bool turns_left(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return turn(a, b, c) > 1e-7 * (b - a).norm() * (c - a).norm();
}

// Whether the direction from corner i to corner j points inside at i.
bool sees(const RegionCorners& region, int i, int j) {
  const int n = static_cast<int>(region.loop);
  const Vec2d &p = region.uv[at(i)], &q = region.uv[at(j)];
  const Vec2d &before = region.uv[at((i + n - 1) % n)], &after = region.uv[at((i + 1) % n)];
  if (turn(before, p, after) > 0) return turns_left(p, after, q) && turns_left(before, p, q);
  return turns_left(p, after, q) || turns_left(before, p, q);
}

// Whether a chord lies inside and meets no side.
bool is_inner(const RegionCorners& region, int i, int j) {
  if (!sees(region, i, j) || !sees(region, j, i)) return false;
  const int n = static_cast<int>(region.loop);
  const Vec2d &p = region.uv[at(i)], &q = region.uv[at(j)];
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    if (k == i || k == j || next == i || next == j) continue;
    const Vec2d &a = region.uv[at(k)], &b = region.uv[at(next)];
    const bool apart = turn(p, q, a) * turn(p, q, b) > 0 || turn(a, b, p) * turn(a, b, q) > 0;
    if (!apart) return false;
  }
  return true;
}

// The best partition of a simple polygon into triangles and quads, by dynamic programming over the
// subpolygons i..j that a chord cuts off.
class Partition {
 public:
  Partition(const RegionCorners& region, const PolygonJudge& judge, bool quads)
      : region_(region), judge_(judge), quads_(quads), n_(static_cast<int>(region.loop)) {
    const auto squared = region.loop * region.loop;
    best_.assign(squared, {});
    allowed_.assign(squared, 0);
    for (int i = 0; i < n_; ++i)
      for (int j = i + 1; j < n_; ++j) allowed_[key(i, j)] = is_side(i, j) || is_inner(region, i, j);
  }

  // Empty if there is none, which exact arithmetic would rule out.
  std::vector<Piece> run() {
    for (int width = 1; width < n_; ++width)
      for (int i = 0; i + width < n_; ++i) solve(i, i + width);
    std::vector<Piece> pieces;
    if (std::isfinite(best_[key(0, n_ - 1)].cost)) collect(0, n_ - 1, pieces);
    return pieces;
  }

 private:
  struct Choice {
    double cost = std::numeric_limits<double>::infinity();
    int first = -1, second = -1;  // corners of the piece between i and j
  };
  size_t key(int i, int j) const { return at(i) * region_.loop + at(j); }
  bool is_side(int i, int j) const { return j == i + 1 || (i == 0 && j == n_ - 1); }
  void solve(int i, int j);
  void collect(int i, int j, std::vector<Piece>& pieces) const;

  const RegionCorners& region_;
  const PolygonJudge& judge_;
  bool quads_;
  int n_;
  std::vector<Choice> best_;
  std::vector<char> allowed_;
};

void Partition::solve(int i, int j) {
  Choice& choice = best_[key(i, j)];
  if (j == i + 1) {
    choice.cost = 0;
    return;
  }
  if (!allowed_[key(i, j)]) return;
  for (int k = i + 1; k < j; ++k) {
    const double rest = best_[key(i, k)].cost + best_[key(k, j)].cost;
    if (rest < choice.cost - no_better) {
      const double cost = rest + judge_.triangle_cost(region_, i, k, j);
      if (cost < choice.cost - no_better) choice = {cost, k, -1};
    }
    if (!quads_) continue;
    for (int l = k + 1; l < j; ++l) {
      const double others = best_[key(i, k)].cost + best_[key(k, l)].cost + best_[key(l, j)].cost;
      if (others >= choice.cost - no_better) continue;
      const double cost = others + judge_.quad_cost(region_, {i, k, l, j});
      if (cost < choice.cost - no_better) choice = {cost, k, l};
    }
  }
}

void Partition::collect(int i, int j, std::vector<Piece>& pieces) const {
  if (j == i + 1) return;
  const Choice& choice = best_[key(i, j)];
  if (choice.second < 0) {
    pieces.push_back({i, choice.first, j});
    collect(i, choice.first, pieces);
    collect(choice.first, j, pieces);
  } else {
    pieces.push_back({i, choice.first, choice.second, j});
    collect(i, choice.first, pieces);
    collect(choice.first, choice.second, pieces);
    collect(choice.second, j, pieces);
  }
}

RegionCorners part_of(const RegionCorners& region, const Piece& piece) {
  RegionCorners part;
  for (const int i : piece) {
    part.node.push_back(region.node[at(i)]);
    part.uv.push_back(region.uv[at(i)]);
    part.position.push_back(region.position[at(i)]);
    part.face.push_back(region.face[at(i)]);
    part.corner_normal.push_back(region.corner_normal[at(i)]);
  }
  part.loop = piece.size();
  part.normal = region.normal;
  part.on_surface = region.on_surface;
  if (!region.forbidden.empty())
    for (int i = 0; i < static_cast<int>(piece.size()); ++i)
      for (int k = i + 1; k < static_cast<int>(piece.size()); ++k)
        if (region.is_forbidden(piece[at(i)], piece[at(k)])) part.forbid(i, k);
  return part;
}

std::vector<Vec3d> positions_of(const RegionCorners& region, const Piece& piece) {
  std::vector<Vec3d> result;
  for (const int i : piece) result.push_back(region.position[at(i)]);
  return result;
}

bool acceptable(const RegionCorners& region, const Piece& piece, const PartitionOptions& options) {
  if (options.max_degree > 0 && piece.size() > at(options.max_degree)) return false;
  return !options.convex || PolygonJudge::is_convex(positions_of(region, piece));
}

std::vector<Piece> cut_convex(const RegionCorners& region) {
  return convex_partition({region.uv.begin(), region.uv.begin() + static_cast<std::ptrdiff_t>(region.loop)});
}

// Sine of the angle between two directions, 1 where it is wide.
double sine_between(const Vec3d& a, const Vec3d& b) {
  const double lengths = a.norm() * b.norm();
  if (!(lengths > 0)) return 0;
  return (a | b) <= 0 ? 1 : cross(a, b).norm() / lengths;
}

// How steeply a chord leaves the four sides that it meets: 0 where it runs along one, 1 at right angles.
double steepness(const RegionCorners& region, int i, int j) {
  const int n = static_cast<int>(region.loop);
  const auto place = [&](int k) -> const Vec3d& { return region.position[at((k + n) % n)]; };
  const Vec3d chord = place(j) - place(i);
  return std::min({sine_between(chord, place(i + 1) - place(i)), sine_between(chord, place(i - 1) - place(i)),
                   sine_between(-chord, place(j + 1) - place(j)),
                   sine_between(-chord, place(j - 1) - place(j))});
}

// Two parts of so many corners at least, by a chord that is short, since that leaves the surface least, and
// steep: along a straight side one would cut off what has no area.
std::vector<Piece> cut_in_two(const RegionCorners& region, int least) {
  const int n = static_cast<int>(region.loop);
  double shortest = std::numeric_limits<double>::infinity();
  int from = -1, to = -1;
  for (int i = 0; i < n; ++i)
    for (int j = i + least; j < n && n - (j - i) >= least; ++j) {
      const double steep = steepness(region, i, j);
      const double squared = (region.position[at(j)] - region.position[at(i)]).sqrnorm() / (steep * steep);
      if (!is_surely_less(squared, shortest) || region.is_forbidden(i, j) || !is_inner(region, i, j))
        continue;
      shortest = squared;
      from = i;
      to = j;
    }
  if (from < 0) return {};
  std::vector<Piece> parts(2);
  for (int i = 0; i < n; ++i) {
    if (from <= i && i <= to) parts[0].push_back(i);
    if (i <= from || to <= i) parts[1].push_back(i);
  }
  return parts;
}

}  // namespace

std::vector<Piece> cut_ears(const RegionCorners& region) {
  Piece ring(region.loop);
  for (size_t i = 0; i < ring.size(); ++i) ring[i] = static_cast<int>(i);
  std::vector<Piece> triangles;
  while (ring.size() > 3) {
    size_t best = 0;
    double best_quality = -std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < ring.size(); ++i) {
      const int a = ring[(i + ring.size() - 1) % ring.size()], b = ring[i], c = ring[(i + 1) % ring.size()];
      const Vec2d &pa = region.uv[at(a)], &pb = region.uv[at(b)], &pc = region.uv[at(c)];
      double quality = turn(pa, pb, pc) / ((pb - pa).norm() * (pc - pb).norm());
      for (const int k : ring) {
        if (k == a || k == b || k == c) continue;
        const Vec2d& p = region.uv[at(k)];
        if (turn(pa, pb, p) >= 0 && turn(pb, pc, p) >= 0 && turn(pc, pa, p) >= 0) quality -= 10;
      }
      if (quality > best_quality + no_better) {
        best_quality = quality;
        best = i;
      }
    }
    triangles.push_back(
        {ring[(best + ring.size() - 1) % ring.size()], ring[best], ring[(best + 1) % ring.size()]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(best));
  }
  triangles.push_back(ring);
  return triangles;
}

std::vector<Piece> best_partition(const RegionCorners& region, const PolygonJudge& judge, bool quads) {
  return Partition(region, judge, quads).run();
}

std::vector<Piece> partition_region(const RegionCorners& region, const PolygonJudge& judge,
                                    const PartitionOptions& options) {
  Piece whole(region.loop);
  for (size_t i = 0; i < whole.size(); ++i) whole[i] = static_cast<int>(i);
  if (region.loop == 3) return {whole};
  if (options.max_degree != 4 && options.max_degree != 3 && acceptable(region, whole, options))
    return {whole};

  const bool large = region.loop > search_limit;
  if (large || options.max_degree == 0) {
    std::vector<Piece> pieces, result;
    // In a flat place corners are straight but for rounding, and a convex partition would turn on that.
    if (options.max_degree != 0) pieces = cut_in_two(region, static_cast<int>(region.loop) / 4);
    if (pieces.size() < 2) pieces = cut_convex(region);
    if (large && pieces.size() < 2) pieces = cut_in_two(region, 2);
    if (pieces.empty()) pieces = cut_ears(region);
    if (pieces.size() > 1) {
      for (const Piece& piece : pieces)
        for (Piece& part : partition_region(part_of(region, piece), judge, options)) {
          for (int& i : part) i = piece[at(i)];
          result.push_back(std::move(part));
        }
      return result;
    }
  }
  std::vector<Piece> pieces;
  if (!large) pieces = Partition(region, judge, options.max_degree != 3).run();
  if (pieces.empty()) pieces = cut_ears(region);
  if (options.max_degree == 0 || options.max_degree > 4)
    return join_triangles(region, std::move(pieces), judge, options);
  return pieces;
}

namespace {

// The ring around two polygons that share exactly one edge, from a to b in the first.
Piece joined(const Piece& first, const Piece& second, int a, int b) {
  Piece ring;
  const auto start = [](const Piece& piece, int corner) {
    return static_cast<size_t>(std::find(piece.begin(), piece.end(), corner) - piece.begin());
  };
  const size_t from = start(first, b), other = start(second, a);
  for (size_t i = 0; i < first.size(); ++i) ring.push_back(first[(from + i) % first.size()]);
  for (size_t i = 1; i + 1 < second.size(); ++i) ring.push_back(second[(other + i) % second.size()]);
  return ring;
}

bool is_simple(Piece ring) {
  std::sort(ring.begin(), ring.end());
  return std::adjacent_find(ring.begin(), ring.end()) == ring.end();
}

}  // namespace

std::vector<Piece> join_triangles(const RegionCorners& region, std::vector<Piece> pieces,
                                  const PolygonJudge& judge, const PartitionOptions& options) {
  if (options.max_degree == 3) return pieces;
  const auto cost_of = [&](const Piece& piece) {
    if (piece.size() == 3) return judge.triangle_cost(region, piece[0], piece[1], piece[2]);
    if (piece.size() == 4) return judge.quad_cost(region, {piece[0], piece[1], piece[2], piece[3]});
    return 1.0;
  };
  std::vector<double> costs;
  costs.reserve(pieces.size());
  for (const Piece& piece : pieces) costs.push_back(cost_of(piece));
  while (true) {
    std::map<std::pair<int, int>, size_t> owner;
    for (size_t p = 0; p < pieces.size(); ++p)
      for (size_t i = 0; i < pieces[p].size(); ++i)
        owner[{pieces[p][i], pieces[p][(i + 1) % pieces[p].size()]}] = p;
    double best_gain = 0;
    size_t best_first = 0, best_second = 0;
    Piece best_ring;
    for (const auto& [edge, first] : owner) {
      const auto twin = edge.first < edge.second ? owner.find({edge.second, edge.first}) : owner.end();
      if (twin == owner.end() || twin->second == first) continue;
      Piece ring = joined(pieces[first], pieces[twin->second], edge.first, edge.second);
      if (!is_simple(ring) || !acceptable(region, ring, options)) continue;
      const double gain = costs[first] + costs[twin->second] - cost_of(ring);
      if (gain <= best_gain + no_better) continue;
      best_gain = gain;
      best_first = first;
      best_second = twin->second;
      best_ring = std::move(ring);
    }
    if (best_gain <= 0) return pieces;
    costs[best_first] = cost_of(best_ring);
    pieces[best_first] = std::move(best_ring);
    pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(best_second));
    costs.erase(costs.begin() + static_cast<std::ptrdiff_t>(best_second));
  }
}

}  // namespace anisomesh::detail
