#include "joining.hh"

#include <algorithm>
#include <array>
#include <utility>

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

// A line is worth something: to take a piece of it out, the quad must be this much better.
constexpr double line_worth = 0.3;

class Joiner {
 public:
  Joiner(std::vector<std::vector<int>>& polygons, const NetworkGraph& network, const PolygonJudge& judge,
         bool join_lines)
      : polygons_(polygons), network_(network), judge_(judge), join_lines_(join_lines) {}

  void run() {
    collect();
    match();
    std::vector<std::vector<int>> kept;
    kept.reserve(polygons_.size());
    for (auto& polygon : polygons_)
      if (!polygon.empty()) kept.push_back(std::move(polygon));
    polygons_ = std::move(kept);
  }

 private:
  struct Candidate {
    double gain;
    std::array<size_t, 2> triangle;
    std::array<int, 4> quad;  // the common edge runs from its first to its third corner
  };

  void collect();
  void consider(size_t first, size_t second, int a, int b);
  void match();
  double worth(int a, int b) const;
  bool can_lose_an_edge(int node) const;

  std::vector<std::vector<int>>& polygons_;
  const NetworkGraph& network_;
  const PolygonJudge& judge_;
  bool join_lines_;
  std::vector<Candidate> candidates_;
  std::vector<int> faces_at_;
};

// Three edges are to be left inside, and one face on the border.
bool Joiner::can_lose_an_edge(int node) const {
  bool border = false;
  const auto& graph = network_.graph;
  for (int e = graph.first_edge(node); e >= 0; e = graph.next_edge(e, node))
    border |= graph.edge(e).kind == static_cast<int>(EdgeKind::border);
  return faces_at_[at(node)] > (border ? 1 : 3);
}

// What the edge is worth by itself; negative: it must stay.
double Joiner::worth(int a, int b) const {
  const int edge = network_.graph.find_edge(a, b);
  if (edge < 0) {
    const auto isotropic = [&](int n) { return network_.origins[at(n)] == Origin::isotropic; };
    return isotropic(a) && isotropic(b) ? -1 : 0;
  }
  return join_lines_ && is_line(network_.graph.edge(edge).kind) ? line_worth : -1;
}

void Joiner::consider(size_t first, size_t second, int a, int b) {
  const double edge_worth = worth(a, b);
  if (edge_worth < 0) return;
  const auto apex = [&](size_t t) {
    for (const int n : polygons_[t])
      if (n != a && n != b) return n;
    return -1;
  };
  const int c = apex(first), d = apex(second);  // first is (a, b, c), second (b, a, d)
  RegionCorners corners;
  corners.node = {a, d, b, c};
  corners.loop = 4;
  for (const int n : corners.node) {
    corners.uv.push_back(network_.graph.uv(n));
    corners.position.push_back(network_.positions[at(n)]);
    corners.face.push_back(network_.points[at(n)].face);
    corners.corner_normal.emplace_back(0, 0, 0);
  }
  const auto& p = corners.position;
  corners.normal = cross(p[2] - p[0], p[3] - p[0]) + cross(p[0] - p[2], p[1] - p[2]);
  const double now = judge_.triangle_cost(corners, 0, 2, 3) + judge_.triangle_cost(corners, 2, 0, 1);
  const double gain = now - judge_.quad_cost(corners, {0, 1, 2, 3}) - edge_worth;
  if (gain > 0) candidates_.push_back({gain, {first, second}, {a, d, b, c}});
}

void Joiner::collect() {
  struct Side {
    int from, to;
    size_t triangle;
  };
  std::vector<Side> sides;
  faces_at_.assign(network_.graph.n_nodes(), 0);
  for (size_t t = 0; t < polygons_.size(); ++t)
    for (size_t i = 0; i < polygons_[t].size(); ++i) {
      const int from = polygons_[t][i], to = polygons_[t][(i + 1) % polygons_[t].size()];
      ++faces_at_[at(from)];
      if (polygons_[t].size() == 3) sides.push_back({from, to, t});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
    const auto key = [](const Side& s) {
      return std::make_pair(std::min(s.from, s.to), std::max(s.from, s.to));
    };
    return key(x) != key(y) ? key(x) < key(y) : x.from < y.from;
  });
  for (size_t i = 0; i + 1 < sides.size(); ++i)
    if (sides[i].from == sides[i + 1].to && sides[i].to == sides[i + 1].from)
      consider(sides[i].triangle, sides[i + 1].triangle, sides[i].from, sides[i].to);
}

// Triangles with the fewest possible partners choose first, so that few are left over (Karp and Sipser 1981).
void Joiner::match() {
  std::vector<std::vector<size_t>> options(polygons_.size());
  for (size_t c = 0; c < candidates_.size(); ++c)
    for (const size_t t : candidates_[c].triangle) options[t].push_back(c);
  std::vector<char> open(candidates_.size(), 1);
  std::vector<std::vector<size_t>> waiting(4);
  const auto count = [&](size_t t) {
    return static_cast<size_t>(
        std::count_if(options[t].begin(), options[t].end(), [&](size_t c) { return open[c]; }));
  };
  for (size_t t = options.size(); t-- > 0;)
    if (!options[t].empty()) waiting[options[t].size()].push_back(t);
  for (size_t level = 1; level < waiting.size();) {
    if (waiting[level].empty()) {
      ++level;
      continue;
    }
    const size_t t = waiting[level].back();
    waiting[level].pop_back();
    if (count(t) != level) continue;  // it has changed since, and waits elsewhere
    size_t best = candidates_.size();
    for (const size_t c : options[t])
      if (open[c] && (best == candidates_.size() || candidates_[c].gain > candidates_[best].gain)) best = c;
    const Candidate& chosen = candidates_[best];
    open[best] = 0;
    const int a = chosen.quad[0], b = chosen.quad[2];
    const bool keeps_valence = can_lose_an_edge(a) && can_lose_an_edge(b);
    if (keeps_valence) {
      --faces_at_[at(a)];
      --faces_at_[at(b)];
      polygons_[chosen.triangle[0]].assign(chosen.quad.begin(), chosen.quad.end());
      polygons_[chosen.triangle[1]].clear();
    }
    for (const size_t triangle : chosen.triangle)
      for (const size_t c : options[triangle]) {
        if (keeps_valence) open[c] = 0;
        for (const size_t other : candidates_[c].triangle) {
          const size_t left = count(other);
          if (left == 0) continue;
          waiting[left].push_back(other);
          level = std::min(level, left);
        }
      }
  }
}

}  // namespace

void join_pairs(std::vector<std::vector<int>>& polygons, const NetworkGraph& network,
                const PolygonJudge& judge, bool join_lines) {
  Joiner(polygons, network, judge, join_lines).run();
}

}  // namespace anisomesh::detail
