#include "mesher/coincident_sides.hh"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "surface/on_segment.hh"

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

std::array<int, 2> in_order(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

}  // namespace

CoincidentSides::CoincidentSides(const std::vector<std::vector<int>>& polygons, const NetworkGraph& network) {
  for (const auto& polygon : polygons)
    for (size_t i = 0; i < polygon.size(); ++i) {
      const int a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      joined_.push_back({a, b});
      joined_.push_back({b, a});
    }
  std::sort(joined_.begin(), joined_.end());
  joined_.erase(std::unique(joined_.begin(), joined_.end()), joined_.end());
  std::vector<int> nodes;
  for (const auto& polygon : polygons) nodes.insert(nodes.end(), polygon.begin(), polygon.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::stable_sort(nodes.begin(), nodes.end(), [&](int n, int m) {
    const Vec3d &p = network.positions[at(n)], &q = network.positions[at(m)];
    return std::tie(p[0], p[1], p[2]) < std::tie(q[0], q[1], q[2]);
  });
  std::vector<char> shared;
  for (size_t i = 1, first = 0; i < nodes.size(); ++i) {
    if (network.positions[at(nodes[i])] != network.positions[at(nodes[first])]) {
      first = i;
      continue;
    }
    if (place_.empty()) {
      place_.resize(network.positions.size());
      std::iota(place_.begin(), place_.end(), 0);
      shared.assign(place_.size(), 0);
    }
    place_[at(nodes[i])] = nodes[first];
    shared[at(nodes[first])] = 1;
  }
  if (place_.empty()) return;
  for (const auto& polygon : polygons)
    for (size_t i = 0; i < polygon.size(); ++i) {
      const int a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      if (shared[at(place_[at(a)])] || shared[at(place_[at(b)])])
        sides_[place_of(a, b)].push_back(in_order(a, b));
    }
}

CoincidentSides::Pair CoincidentSides::place_of(int a, int b) const {
  return in_order(place_[at(a)], place_[at(b)]);
}

bool CoincidentSides::lies_on_another(int a, int b) const {
  if (place_.empty()) return false;
  const auto found = sides_.find(place_of(a, b));
  if (found == sides_.end()) return false;
  return std::any_of(found->second.begin(), found->second.end(),
                     [&](const Pair& side) { return side != in_order(a, b); });
}

bool CoincidentSides::passes_a_node(int a, int b, const NetworkGraph& network) const {
  auto next = std::lower_bound(joined_.begin(), joined_.end(), Pair{a, -1});
  for (; next != joined_.end() && (*next)[0] == a; ++next) {
    const int n = (*next)[1];
    if (n != b &&
        is_on_segment(network.positions[at(n)], network.positions[at(a)], network.positions[at(b)]) &&
        std::binary_search(joined_.begin(), joined_.end(), Pair{n, b}))
      return true;
  }
  return false;
}

bool CoincidentSides::has_one(const std::vector<int>& polygon, const NetworkGraph& network) const {
  for (size_t i = 0; i < polygon.size(); ++i) {
    const int a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if (!lies_on_another(a, b) && !passes_a_node(a, b, network)) continue;
    const int edge = network.graph.find_edge(a, b);
    if (edge < 0 || is_line(network.graph.edge(edge).kind)) return true;
  }
  return false;
}

}  // namespace anisomesh::detail
