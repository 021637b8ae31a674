// An elimination order for sparse systems on surfaces.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace anisomesh::detail {

/// Nested dissection by level structures: the thinnest of the middle levels of a breadth first search parts
/// the unknowns in two halves, which are ordered the same way; it comes after both. On the graph of a surface
/// this fills little more than a graph partitioner's order and is found much faster. [George and Liu,
/// An automatic nested dissection algorithm, 1978]
/// \param adjacent pairs of unknowns with an entry in the matrix, each at least once, either way round
/// \return the unknown that comes at each position
std::vector<int> nested_dissection(std::size_t unknowns, const std::vector<std::pair<int, int>>& adjacent);

}  // namespace anisomesh::detail
