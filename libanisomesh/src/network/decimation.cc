#include "network/decimation.hh"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>
#include <vector>

#include "numerics/segment.hh"
#include "surface/rounding.hh"

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

class Decimator {
 public:
  Decimator(NetworkGraph& network, Embedding& embedding, const DecimationOptions& options)
      : network_(network), graph_(network.graph), embedding_(embedding), options_(options) {}

  DecimationReport run() {
    trim();
    straighten();
    if (options_.merge_fraction > 0)
      while (contract_short_edges() > 0) {
        trim();
        straighten();
      }
    return report_;
  }

 private:
  // Edges at a node.
  template <class Visit>
  void visit_edges(int node, const Visit& visit) const {
    for (int e = graph_.first_edge(node); e >= 0; e = graph_.next_edge(e, node)) visit(e);
  }

  bool passes_through(int node) const;
  void trim();
  void straighten();
  std::vector<int> chain_from(int node, int edge, std::vector<char>& seen) const;
  double tolerance_between(const std::vector<int>& chain, int begin, int end) const;
  void order_chain(const std::vector<int>& chain, std::vector<std::pair<int, int>>& removable);
  bool remove_from_chain(int node);
  size_t contract_short_edges();
  double continuation(int edge, int node) const;
  bool contract(int keep, int gone, int edge);
  bool is_feature(int edge) const { return graph_.edge(edge).kind == static_cast<int>(EdgeKind::feature); }
  std::vector<Vec3d> left_out_at(int edge) const;
  bool stays_near(const std::vector<Vec3d>& samples, int a, int b) const;
  void leave_out(const std::vector<Vec3d>& samples, int a, int b);
  bool touches(int node, EdgeKind kind) const { return network_.touches(node, kind); }
  bool on_curve(int node) const {
    return touches(node, EdgeKind::border) || touches(node, EdgeKind::feature);
  }
  int rank(int node) const;
  double length(int edge) const {
    const auto& e = graph_.edge(edge);
    return (network_.positions[at(e.node[0])] - network_.positions[at(e.node[1])]).norm();
  }

  NetworkGraph& network_;
  PlanarGraph& graph_;
  Embedding& embedding_;
  const DecimationOptions& options_;
  DecimationReport report_;
  std::unordered_map<int, std::vector<Vec3d>> left_out_;  // of features, by the edge that stands for them
};

std::vector<Vec3d> Decimator::left_out_at(int edge) const {
  const auto found = left_out_.find(edge);
  return found == left_out_.end() ? std::vector<Vec3d>() : found->second;
}

// Whether an edge between two nodes is near enough to samples of a feature.
bool Decimator::stays_near(const std::vector<Vec3d>& samples, int a, int b) const {
  const Vec3d &p = network_.positions[at(a)], &q = network_.positions[at(b)];
  return std::all_of(samples.begin(), samples.end(), [&](const Vec3d& sample) {
    return !(off_segment(sample, p, q).norm() > options_.feature_tolerance);
  });
}

void Decimator::leave_out(const std::vector<Vec3d>& samples, int a, int b) {
  auto& all = left_out_[graph_.find_edge(a, b)];
  all.insert(all.end(), samples.begin(), samples.end());
}

// Two edges of the same kind, and no reason of its own to be a vertex.
bool Decimator::passes_through(int node) const {
  if (network_.fixed[at(node)] || graph_.degree(node) != 2) return false;
  const int first = graph_.first_edge(node);
  return graph_.edge(first).kind == graph_.edge(graph_.next_edge(first, node)).kind;
}

// The first two rules: a line that ends in the middle of a cell is cut back to its last crossing, and so on.
void Decimator::trim() {
  std::vector<int> dropped;
  for (int start = 0; start < static_cast<int>(graph_.n_nodes()); ++start) {
    int node = start;
    while (graph_.degree(node) == 1 && !network_.fixed[at(node)]) {
      const int edge = graph_.first_edge(node);
      if (!is_line(graph_.edge(edge).kind)) break;
      const int next = graph_.other(edge, node);
      graph_.remove_edge(edge);
      dropped.push_back(node);
      ++report_.trimmed;
      node = next;
    }
    if (graph_.degree(node) == 0 && !network_.fixed[at(node)]) dropped.push_back(node);
  }
  embedding_.drop(dropped);
}

// The chain of pass-through nodes that leaves `node` by `edge`, with both its ends.
std::vector<int> Decimator::chain_from(int node, int edge, std::vector<char>& seen) const {
  std::vector<int> chain{node};
  while (true) {
    seen[at(edge)] = 1;
    const int next = graph_.other(edge, chain.back());
    chain.push_back(next);
    if (next == node || !passes_through(next)) return chain;
    const int first = graph_.first_edge(next);
    edge = first == edge ? graph_.next_edge(first, next) : first;
  }
}

double Decimator::tolerance_between(const std::vector<int>& chain, int begin, int end) const {
  if (network_.share.empty()) return options_.chain_tolerance;
  double share = 1;
  for (int i = begin; i <= end; ++i) share = std::min(share, network_.share[at(chain[at(i)])]);
  return share == 1 ? options_.chain_tolerance : share * options_.finite_tolerance;
}

// Splits the chain again and again at the sample farthest from the chord (Ramer 1972, Douglas and Peucker
// 1973): samples beyond the tolerance stay, the others are listed with the depth of their split, for the
// deepest to go first. A loop is held by three nodes at least.
void Decimator::order_chain(const std::vector<int>& chain, std::vector<std::pair<int, int>>& removable) {
  struct Range {
    int begin, end, depth;
  };
  const int last = static_cast<int>(chain.size()) - 1;
  const bool loop = chain.front() == chain.back();
  const int kind = graph_.edge(graph_.find_edge(chain[0], chain[1])).kind;
  const bool line = is_line(kind), feature = kind == static_cast<int>(EdgeKind::feature);
  std::vector<Range> ranges;
  int begin = 0;
  if (loop)
    for (const int end : {last / 3, last - last / 3}) {
      ranges.push_back({begin, end, 1});
      begin = end;
    }
  ranges.push_back({begin, last, 1});
  while (!ranges.empty()) {
    const Range r = ranges.back();
    ranges.pop_back();
    if (r.end - r.begin < 2) continue;
    const Vec3d &a = network_.positions[at(chain[at(r.begin)])],
                &b = network_.positions[at(chain[at(r.end)])];
    int split = (r.begin + r.end) / 2;
    double farthest = 0;
    const double nothing =
        kRounding * (b - a).norm();  // where the surface is flat the middle is the farthest
    for (int i = r.begin + 1; i < r.end; ++i) {
      const int node = chain[at(i)];
      const Vec3d off = off_segment(network_.positions[at(node)], a, b);
      // A line may turn within the surface at will; the border and features have a shape of their own.
      const double d = line ? std::abs(off | network_.normals[at(node)]) : off.norm();
      if (d > farthest + nothing) {
        farthest = d;
        split = i;
      }
    }
    const double tolerance = tolerance_between(chain, r.begin, r.end);
    if (!(farthest > (feature ? std::min(tolerance, options_.feature_tolerance) : tolerance)))
      removable.emplace_back(r.depth, chain[at(split)]);
    ranges.push_back({r.begin, split, r.depth + 1});
    ranges.push_back({split, r.end, r.depth + 1});
  }
}

// The third rule: a sample goes if the triangle it makes with its neighbours holds nothing else.
bool Decimator::remove_from_chain(int node) {
  const int first = graph_.first_edge(node), second = graph_.next_edge(first, node);
  const int a = graph_.other(first, node), b = graph_.other(second, node);
  if (a == b || graph_.find_edge(a, b) >= 0) return false;
  std::vector<Vec3d> samples;
  if (is_feature(first)) {
    samples = left_out_at(first);
    for (const Vec3d& sample : left_out_at(second)) samples.push_back(sample);
    samples.push_back(network_.positions[at(node)]);
    if (!stays_near(samples, a, b)) return false;
  }
  if (!embedding_.straighten(a, node, b)) return false;
  const auto& edge = graph_.edge(first);
  const int kind = edge.kind, tag = edge.tag;
  graph_.remove_edge(first);
  graph_.remove_edge(second);
  graph_.add_edge(a, b, kind, tag);
  if (!samples.empty()) leave_out(samples, a, b);
  ++report_.straightened;
  return true;
}

void Decimator::straighten() {
  std::vector<std::pair<int, int>> removable;  // depth of the split, node
  std::vector<char> seen(graph_.n_edges(), 0);
  for (int pass = 0; pass < 2; ++pass)  // chains with ends, then loops without
    for (int node = 0; node < static_cast<int>(graph_.n_nodes()); ++node) {
      if (graph_.degree(node) == 0 || (pass == 0 && passes_through(node))) continue;
      visit_edges(node, [&](int edge) {
        if (!seen[at(edge)]) order_chain(chain_from(node, edge, seen), removable);
      });
    }
  std::sort(removable.begin(), removable.end(), [](const auto& x, const auto& y) {
    return x.first != y.first ? x.first > y.first : x.second < y.second;
  });
  while (true) {
    const auto kept = std::remove_if(removable.begin(), removable.end(),
                                     [&](const auto& entry) { return remove_from_chain(entry.second); });
    if (kept == removable.end()) return;
    removable.erase(kept, removable.end());
  }
}

// Which of two nodes a contraction keeps: the higher.
int Decimator::rank(int node) const {
  const int place = network_.fixed[at(node)]           ? 16
                    : touches(node, EdgeKind::border)  ? 8
                    : touches(node, EdgeKind::feature) ? 4
                                                       : 0;
  return place + std::min(graph_.degree(node), 3);
}

// Length of the edge that continues `edge` beyond `node`: the one of its kind that turns least; 0 if there is
// none.
double Decimator::continuation(int edge, int node) const {
  const auto towards = [&](int from, int to) {
    const Vec3d step = network_.positions[at(to)] - network_.positions[at(from)];
    const Vec2d flat = graph_.uv(to) - graph_.uv(from);
    return network_.planar ? Vec3d(flat[0], flat[1], 0) : step;
  };
  const Vec3d along = towards(graph_.other(edge, node), node);
  double best = 0, result = 0;
  visit_edges(node, [&](int e) {
    if (e == edge || graph_.edge(e).kind != graph_.edge(edge).kind) return;
    const Vec3d onward = towards(node, graph_.other(e, node));
    const double cosine = (along | onward) / (along.norm() * onward.norm());
    if (is_surely_less(best, cosine)) {
      best = cosine;
      result = length(e);
    }
  });
  return result;
}

// Moves all edges of `gone` to `keep`, if no edge sweeps over another node on the way.
bool Decimator::contract(int keep, int gone, int edge) {
  struct Moved {
    int edge, other;
    std::vector<Vec3d> samples;  // of a feature: those that its edge is to stand for
  };
  std::vector<Moved> moved;
  visit_edges(gone, [&](int e) {
    if (e == edge) return;
    moved.push_back({e, graph_.other(e, gone), {}});
    if (!is_feature(e)) return;
    auto& samples = moved.back().samples = left_out_at(e);
    samples.push_back(network_.positions[at(gone)]);
    if (is_feature(edge))
      for (const Vec3d& sample : left_out_at(edge)) samples.push_back(sample);
  });
  std::vector<int> others;
  for (const Moved& m : moved) {
    if (!stays_near(m.samples, keep, m.other)) return false;
    const int twin = graph_.find_edge(keep, m.other);
    if (twin >= 0 && !is_line(graph_.edge(twin).kind) && !is_line(graph_.edge(m.edge).kind)) return false;
    others.push_back(m.other);
  }
  if (!embedding_.contract(keep, gone, others)) return false;
  // Two edges that end in the same node become one: the triangle between them had nothing inside.
  for (const Moved& m : moved) {
    const auto& old = graph_.edge(m.edge);
    const int kind = old.kind, tag = old.tag;
    graph_.remove_edge(m.edge);
    const int twin = graph_.find_edge(keep, m.other);
    if (twin < 0)
      graph_.add_edge(keep, m.other, kind, tag);
    else if (graph_.edge(twin).kind < kind)
      graph_.set_kind(twin, kind, tag);
    if (!m.samples.empty()) leave_out(m.samples, keep, m.other);
  }
  graph_.remove_edge(edge);
  ++report_.merged;
  return true;
}

size_t Decimator::contract_short_edges() {
  std::vector<int> short_edges;
  const auto is_short = [&](int e) {
    const auto& edge = graph_.edge(e);
    if (!network_.planar && length(e) < options_.least_length) return true;
    const double before = continuation(e, edge.node[0]), after = continuation(e, edge.node[1]);
    const double reference = before > 0 && after > 0 ? std::min(before, after) : std::max(before, after);
    return length(e) < options_.merge_fraction * reference;
  };
  for (int e = 0; e < static_cast<int>(graph_.n_edges()); ++e)
    if (graph_.edge(e).alive && is_short(e)) short_edges.push_back(e);
  std::vector<double> lengths;
  lengths.reserve(short_edges.size());
  for (const int e : short_edges) lengths.push_back(length(e));
  lengths = in_steps(std::move(lengths));
  std::vector<std::pair<double, int>> candidates;
  for (size_t i = 0; i < lengths.size(); ++i) candidates.emplace_back(lengths[i], short_edges[i]);
  std::sort(candidates.begin(), candidates.end());
  size_t contracted = 0;
  for (const auto& candidate : candidates) {
    const int e = candidate.second;
    if (!graph_.edge(e).alive || !is_short(e)) continue;
    int keep = graph_.edge(e).node[0], gone = graph_.edge(e).node[1];
    if (rank(keep) < rank(gone)) std::swap(keep, gone);
    const int kind = graph_.edge(e).kind;
    // What is on the border or a feature moves along it and not off it, and corners stay.
    if (network_.fixed[at(gone)] || (on_curve(gone) && is_line(kind))) continue;
    if (touches(gone, EdgeKind::border) && kind != static_cast<int>(EdgeKind::border)) continue;
    if (contract(keep, gone, e)) ++contracted;
  }
  return contracted;
}

}  // namespace

DecimationReport decimate(NetworkGraph& network, Embedding& embedding, const DecimationOptions& options) {
  return Decimator(network, embedding, options).run();
}

}  // namespace anisomesh::detail
