#include "numerics/convex_partition.hh"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Partition_traits_2.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/partition_2.h>
#include <CGAL/property_map.h>

#include <exception>
#include <iterator>
#include <list>

namespace anisomesh::detail {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Points = std::vector<Kernel::Point_2>;
using Map = CGAL::Pointer_property_map<Kernel::Point_2>::type;
using Traits = CGAL::Partition_traits_2<Kernel, Map>;
using Piece = Traits::Polygon_2;

// Pieces must use every edge of the polygon once and every cut twice, in opposite directions.
bool fits(const std::vector<std::vector<int>>& pieces, size_t n) {
  std::vector<char> boundary(n, 0);
  std::vector<std::pair<size_t, size_t>> cuts;
  for (const auto& piece : pieces) {
    if (piece.size() < 3) return false;
    for (size_t i = 0; i < piece.size(); ++i) {
      const auto a = static_cast<size_t>(piece[i]), b = static_cast<size_t>(piece[(i + 1) % piece.size()]);
      if (b == (a + 1) % n) {
        if (boundary[a]) return false;
        boundary[a] = 1;
      } else {
        cuts.emplace_back(a, b);
      }
    }
  }
  for (const char used : boundary)
    if (!used) return false;
  for (const auto& cut : cuts) {
    size_t same = 0, opposite = 0;
    for (const auto& other : cuts) {
      same += other == cut;
      opposite += other.first == cut.second && other.second == cut.first;
    }
    if (same != 1 || opposite != 1) return false;
  }
  return true;
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
