#include "mesher/joining.hh"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "mesher/conforming.hh"
#include "mesher/polygon_adjacency.hh"

namespace anisomesh::detail {

namespace {

using Polygon = std::vector<int>;
size_t at(int i) { return static_cast<size_t>(i); }

// A line is worth something: to take a piece of it out, the rest must be this much better.
constexpr double line_worth = 0.2;
constexpr double least_gain = 0.02;
constexpr double gain_step = 1e-6;  // gains that differ by less count as the same, whatever rounding does
constexpr int max_rounds = 4;
constexpr double folded_cost = 500;  // above it the judge has found a fold

// Polygons on a path from one triangle to another, and what they would become.
struct Candidate {
  std::vector<int> path;
  double gain = 0;
  std::vector<Polygon> replacement;
  std::vector<std::array<int, 2>> chords;  // nodes of its inner edges, the lower first
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
      adjacency_ = PolygonAdjacency(polygons_, network_.graph.n_nodes(),
                                    [this](int a, int b) { return may_go(a, b); });
      std::vector<Candidate> candidates = find_paths();
      tbb::parallel_for(size_t{0}, candidates.size(), [&](size_t i) { evaluate(candidates[i]); });
      if (apply(candidates) == 0) return;
    }
  }

 private:
  std::vector<Candidate> find_paths() const;
  void extend(std::vector<int>& path, std::vector<Candidate>& candidates) const;
  bool may_go(int a, int b) const;
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
  PolygonAdjacency adjacency_;
};

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
    const int next = adjacency_.neighbor(last, i);
    if (next < 0 || polygons_[at(next)].size() > 4 || std::find(path.begin(), path.end(), next) != path.end())
      continue;
    path.push_back(next);
    if (polygons_[at(next)].size() == 3) {
      if (path.front() < next) candidates.push_back({path, 0, {}, {}});
    } else if (static_cast<int>(path.size()) <= max_between_ + 1) {
      extend(path, candidates);
    }
    path.pop_back();
  }
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
  const RegionCorners corners = adjacency_.around(polygons_, candidate.path, network_);
  if (corners.loop == 0) return;
  const std::vector<Polygon> before = in_corners(corners, polygons_, candidate.path);
  std::vector<Polygon> after = best_partition(corners, judge_, true);
  const double cost = judge_.cost(corners, after);
  candidate.gain = judge_.cost(corners, before) - cost - worth_of_lines(corners, before, after);
  candidate.gain = gain_step * std::round(candidate.gain / gain_step);
  if (after.empty() || after.size() >= before.size() || cost > folded_cost) candidate.gain = 0;
  for (const Polygon& p : after)
    for (size_t i = 0; i < p.size(); ++i) {
      const int a = p[i], b = p[(i + 1) % p.size()];
      if (a < b && !corners.is_side(a, b) && !corners.is_side(b, a))
        candidate.chords.push_back({std::min(corners.node[at(a)], corners.node[at(b)]),
                                    std::max(corners.node[at(a)], corners.node[at(b)])});
    }
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
  const auto change = [&](int by) {
    for (const int p : candidate.path) adjacency_.count(polygons_[at(p)], -by);
    for (const Polygon& p : candidate.replacement) adjacency_.count(p, by);
  };
  change(1);
  for (const Polygon& p : candidate.replacement)
    for (const int n : p)
      if (adjacency_.faces_at(n) < 3 && !on_border(n)) {
        change(-1);
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
  std::set<std::array<int, 2>> new_chords;  // of this round: no second polygon may have one as its side
  for (const size_t c : order) {
    const Candidate& candidate = candidates[c];
    const auto taken = [&](int p) { return changed[at(p)] != 0; };
    const auto is_new = [&](const std::array<int, 2>& chord) { return new_chords.count(chord) > 0; };
    if (std::any_of(candidate.path.begin(), candidate.path.end(), taken) ||
        std::any_of(candidate.chords.begin(), candidate.chords.end(), is_new) || !keeps_valence(candidate))
      continue;
    new_chords.insert(candidate.chords.begin(), candidate.chords.end());
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
