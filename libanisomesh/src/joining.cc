#include "joining.hh"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <utility>

#include "conforming.hh"

namespace anisomesh::detail {

namespace {

using Polygon = std::vector<int>;
size_t at(int i) { return static_cast<size_t>(i); }

// A line is worth something: to take a piece of it out, the rest must be this much better.
constexpr double line_worth = 0.2;
constexpr double least_gain = 0.02;
constexpr int max_rounds = 4;
constexpr double folded_cost = 500;  // above it the judge has found a fold

// Polygons on a path from one triangle to another, and what they would become.
struct Candidate {
  std::vector<int> path;
  double gain = 0;
  std::vector<Polygon> replacement;
};

class Pairing {
 public:
  Pairing(std::vector<Polygon>& polygons, const NetworkGraph& network, const PolygonJudge& judge,
          bool join_lines, int max_between)
      : polygons_(polygons),
        network_(network),
        judge_(judge),
        join_lines_(join_lines),
        max_between_(max_between) {}

  void run() {
    for (int round = 0; round < max_rounds; ++round) {
      connect();
      std::vector<Candidate> candidates = find_paths();
      tbb::parallel_for(size_t{0}, candidates.size(), [&](size_t i) { evaluate(candidates[i]); });
      if (apply(candidates) == 0) return;
    }
  }

 private:
  void connect();
  std::vector<Candidate> find_paths() const;
  void extend(std::vector<int>& path, std::vector<Candidate>& candidates) const;
  bool may_go(int a, int b) const;
  RegionCorners around(const std::vector<int>& path) const;
  double cost_of(const RegionCorners& corners, const std::vector<Polygon>& pieces) const;
  double worth_of_lines(const RegionCorners& corners, const std::vector<Polygon>& before,
                        const std::vector<Polygon>& after) const;
  void evaluate(Candidate& candidate) const;
  bool keeps_valence(const Candidate& candidate);
  size_t apply(std::vector<Candidate>& candidates);
  bool on_border(int node) const;

  std::vector<Polygon>& polygons_;
  const NetworkGraph& network_;
  const PolygonJudge& judge_;
  bool join_lines_;
  int max_between_;
  std::vector<std::array<int, 4>> neighbors_;  // across the side that begins at the corner of the same place
  std::vector<int> faces_at_;                  // how many polygons at each node
};

void Pairing::connect() {
  struct Side {
    int low, high, polygon;
    size_t place;
  };
  std::vector<Side> sides;
  neighbors_.assign(polygons_.size(), {-1, -1, -1, -1});
  faces_at_.assign(network_.graph.n_nodes(), 0);
  for (size_t p = 0; p < polygons_.size(); ++p)
    for (size_t i = 0; i < polygons_[p].size(); ++i) {
      const int from = polygons_[p][i], to = polygons_[p][(i + 1) % polygons_[p].size()];
      ++faces_at_[at(from)];
      if (polygons_[p].size() <= 4)
        sides.push_back({std::min(from, to), std::max(from, to), static_cast<int>(p), i});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
    if (x.low != y.low) return x.low < y.low;
    return x.high != y.high ? x.high < y.high : x.polygon < y.polygon;
  });
  for (size_t i = 0; i + 1 < sides.size(); ++i) {
    const Side &x = sides[i], &y = sides[i + 1];
    if (x.low != y.low || x.high != y.high || !may_go(x.low, x.high)) continue;
    neighbors_[at(x.polygon)][x.place] = y.polygon;
    neighbors_[at(y.polygon)][y.place] = x.polygon;
  }
}

bool Pairing::may_go(int a, int b) const {
  const int edge = network_.graph.find_edge(a, b);
  if (edge >= 0) return join_lines_ && is_line(network_.graph.edge(edge).kind);
  return network_.origins[at(a)] != Origin::isotropic || network_.origins[at(b)] != Origin::isotropic;
}

std::vector<Candidate> Pairing::find_paths() const {
  std::vector<Candidate> candidates;
  std::vector<int> path;
  for (size_t p = 0; p < polygons_.size(); ++p) {
    if (polygons_[p].size() != 3) continue;
    path.assign(1, static_cast<int>(p));
    extend(path, candidates);
  }
  return candidates;
}

void Pairing::extend(std::vector<int>& path, std::vector<Candidate>& candidates) const {
  const int last = path.back();
  for (size_t i = 0; i < polygons_[at(last)].size(); ++i) {
    const int next = neighbors_[at(last)][i];
    if (next < 0 || std::find(path.begin(), path.end(), next) != path.end()) continue;
    path.push_back(next);
    if (polygons_[at(next)].size() == 3) {
      if (path.front() < next) candidates.push_back({path, 0, {}});
    } else if (static_cast<int>(path.size()) <= max_between_ + 1) {
      extend(path, candidates);
    }
    path.pop_back();
  }
}

// The corners around the polygons of a path; none if one of them would be passed twice.
RegionCorners Pairing::around(const std::vector<int>& path) const {
  Polygon ring = polygons_[at(path.front())];
  for (size_t i = 1; i < path.size(); ++i) {
    const Polygon& before = polygons_[at(path[i - 1])];
    const Polygon& next = polygons_[at(path[i])];
    size_t side = 0;
    while (neighbors_[at(path[i - 1])][side] != path[i]) ++side;
    const int a = before[side], b = before[(side + 1) % before.size()];
    const auto start = static_cast<size_t>(std::find(next.begin(), next.end(), a) - next.begin());
    auto place = std::find(ring.begin(), ring.end(), b) - ring.begin();
    for (size_t k = 1; next[(start + k) % next.size()] != b; ++k, ++place)
      ring.insert(ring.begin() + place, next[(start + k) % next.size()]);
  }
  RegionCorners corners;
  Polygon sorted = ring;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return corners;
  for (const int n : ring) corners.add(network_, n);
  corners.loop = ring.size();
  for (size_t i = 1; i + 1 < ring.size(); ++i)
    corners.normal +=
        cross(corners.position[i] - corners.position[0], corners.position[i + 1] - corners.position[0]);
  return corners;
}

double Pairing::cost_of(const RegionCorners& corners, const std::vector<Polygon>& pieces) const {
  double sum = 0;
  for (const Polygon& p : pieces)
    sum += p.size() == 3 ? judge_.triangle_cost(corners, p[0], p[1], p[2])
                         : judge_.quad_cost(corners, {p[0], p[1], p[2], p[3]});
  return sum;
}

double Pairing::worth_of_lines(const RegionCorners& corners, const std::vector<Polygon>& before,
                               const std::vector<Polygon>& after) const {
  const auto chords = [&](const std::vector<Polygon>& pieces) {
    std::vector<std::pair<int, int>> result;
    for (const Polygon& p : pieces)
      for (size_t i = 0; i < p.size(); ++i) {
        const int a = p[i], b = p[(i + 1) % p.size()];
        if (a < b && !corners.is_side(a, b) && !corners.is_side(b, a)) result.emplace_back(a, b);
      }
    return result;
  };
  const auto kept = chords(after);
  double sum = 0;
  for (const auto& chord : chords(before))
    if (std::find(kept.begin(), kept.end(), chord) == kept.end() &&
        network_.graph.find_edge(corners.node[at(chord.first)], corners.node[at(chord.second)]) >= 0)
      sum += line_worth;
  return sum;
}

void Pairing::evaluate(Candidate& candidate) const {
  const RegionCorners corners = around(candidate.path);
  if (corners.loop == 0) return;
  std::vector<Polygon> before;
  for (const int p : candidate.path) {
    before.emplace_back();
    for (const int n : polygons_[at(p)])
      before.back().push_back(
          static_cast<int>(std::find(corners.node.begin(), corners.node.end(), n) - corners.node.begin()));
  }
  std::vector<Polygon> after = best_partition(corners, judge_);
  const double cost = cost_of(corners, after);
  candidate.gain = cost_of(corners, before) - cost - worth_of_lines(corners, before, after);
  if (after.empty() || after.size() >= before.size() || cost > folded_cost) candidate.gain = 0;
  for (Polygon& p : after)
    for (int& i : p) i = corners.node[at(i)];
  candidate.replacement = std::move(after);
}

bool Pairing::on_border(int node) const {
  const auto& graph = network_.graph;
  for (int e = graph.first_edge(node); e >= 0; e = graph.next_edge(e, node))
    if (graph.edge(e).kind == static_cast<int>(EdgeKind::border)) return true;
  return false;
}

// Three polygons are to be left at a node inside, and one on the border.
bool Pairing::keeps_valence(const Candidate& candidate) {
  const auto change = [&](int by_old) {
    for (const int p : candidate.path)
      for (const int n : polygons_[at(p)]) faces_at_[at(n)] += by_old;
    for (const Polygon& p : candidate.replacement)
      for (const int n : p) faces_at_[at(n)] -= by_old;
  };
  change(-1);
  for (const Polygon& p : candidate.replacement)
    for (const int n : p)
      if (faces_at_[at(n)] < 3 && !on_border(n)) {
        change(1);
        return false;
      }
  return true;
}

size_t Pairing::apply(std::vector<Candidate>& candidates) {
  std::vector<size_t> order;
  for (size_t c = 0; c < candidates.size(); ++c)
    if (candidates[c].gain > least_gain) order.push_back(c);
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t x, size_t y) { return candidates[x].gain > candidates[y].gain; });
  std::vector<char> changed(polygons_.size(), 0);
  size_t applied = 0;
  for (const size_t c : order) {
    const Candidate& candidate = candidates[c];
    const auto taken = [&](int p) { return changed[at(p)] != 0; };
    if (std::any_of(candidate.path.begin(), candidate.path.end(), taken) || !keeps_valence(candidate))
      continue;
    for (size_t i = 0; i < candidate.path.size(); ++i) {
      const auto p = at(candidate.path[i]);
      changed[p] = 1;
      if (i < candidate.replacement.size())
        polygons_[p] = candidate.replacement[i];
      else
        polygons_[p].clear();
    }
    ++applied;
  }
  polygons_.erase(
      std::remove_if(polygons_.begin(), polygons_.end(), [](const Polygon& p) { return p.empty(); }),
      polygons_.end());
  return applied;
}

}  // namespace

void pair_triangles(std::vector<Polygon>& polygons, const NetworkGraph& network, const PolygonJudge& judge,
                    bool join_lines, int max_between) {
  Pairing(polygons, network, judge, join_lines, max_between).run();
}

}  // namespace anisomesh::detail
