#include "mesher/cells.hh"

#include <algorithm>

namespace anisomesh::detail {

std::vector<int> loop_around(const Cell& cell) {
  auto sides = cell.sides;
  std::sort(sides.begin(), sides.end());
  const auto leaves_twice = [](const auto& x, const auto& y) { return x[0] == y[0]; };
  if (sides.empty() || std::adjacent_find(sides.begin(), sides.end(), leaves_twice) != sides.end()) return {};
  std::vector<int> loop;
  int node = sides.front()[0];
  do {
    const auto next = std::lower_bound(sides.begin(), sides.end(), std::array<int, 2>{node, -1});
    if (next == sides.end() || (*next)[0] != node || loop.size() == sides.size()) return {};
    loop.push_back(node);
    node = (*next)[1];
  } while (node != loop.front());
  return loop.size() == sides.size() ? loop : std::vector<int>{};
}

}  // namespace anisomesh::detail
