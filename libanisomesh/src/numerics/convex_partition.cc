#include "numerics/convex_partition.hh"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Partition_traits_2.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/partition_2.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <list>
#include <utility>
#include <vector>

namespace anisomesh::detail {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Points = std::vector<Kernel::Point_2>;
using Map = CGAL::Pointer_property_map<Kernel::Point_2>::type;
using Traits = CGAL::Partition_traits_2<Kernel, Map>;
using Piece = Traits::Polygon_2;

// Pieces must use every edge of the polygon once and every cut twice, in opposite directions.
bool fits(const std::vector<std::vector<int>>& pieces, size_t n) {
  using Edge = std::pair<size_t, size_t>;
  std::vector<Edge> edges;
  for (const auto& piece : pieces) {
    if (piece.size() < 3) return false;
    for (size_t i = 0; i < piece.size(); ++i)
      edges.emplace_back(static_cast<size_t>(piece[i]), static_cast<size_t>(piece[(i + 1) % piece.size()]));
  }
  std::sort(edges.begin(), edges.end());
  if (std::adjacent_find(edges.begin(), edges.end()) != edges.end()) return false;
  const auto is_side = [n](const Edge& edge) { return edge.second == (edge.first + 1) % n; };
  const auto is_matched = [&](const Edge& edge) {
    const Edge back(edge.second, edge.first);
    return is_side(edge) || (!is_side(back) && std::binary_search(edges.begin(), edges.end(), back));
  };
  return static_cast<size_t>(std::count_if(edges.begin(), edges.end(), is_side)) == n &&
         std::all_of(edges.begin(), edges.end(), is_matched);
}

}  // namespace

std::vector<std::vector<int>> convex_partition(const std::vector<OpenMesh::Vec2d>& polygon,
                                               size_t exact_limit) {
  Points points;
  Piece input;
  for (size_t i = 0; i < polygon.size(); ++i) {
    points.emplace_back(polygon[i][0], polygon[i][1]);
    input.push_back(i);
  }
  const Traits traits(CGAL::make_property_map(points));
  std::list<Piece> output;
  try {
    if (polygon.size() <= exact_limit)
      CGAL::optimal_convex_partition_2(input.vertices_begin(), input.vertices_end(),
                                       std::back_inserter(output), traits);
    else
      CGAL::approx_convex_partition_2(input.vertices_begin(), input.vertices_end(),
                                      std::back_inserter(output), traits);
  } catch (const std::exception&) {  // CGAL's own checks: the polygon is not simple
    return {};
  }
  std::vector<std::vector<int>> pieces;
  for (const Piece& piece : output) {
    pieces.emplace_back();
    for (const size_t i : piece.container()) pieces.back().push_back(static_cast<int>(i));
  }
  return fits(pieces, polygon.size()) ? pieces : std::vector<std::vector<int>>{};
}

}  // namespace anisomesh::detail
