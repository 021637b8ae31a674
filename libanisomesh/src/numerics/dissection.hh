// An elimination order for sparse systems on surfaces.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace anisomesh::detail {

/// An order in which the unknowns are eliminated, and the parts of it that are still free to be ordered.
struct Dissected {
  std::vector<int> order;                                  ///< the unknown that comes at each position
  std::vector<std::pair<std::size_t, std::size_t>> parts;  ///< positions [first, last) of each undivided part
};

/// Nested dissection by level structures, down to parts of at most `largest_part` unknowns: the thinnest of
/// the middle levels of a breadth first search parts the unknowns in two halves, which are divided the same
/// way; it comes after both. [George and Liu, An automatic nested dissection algorithm, 1978]
/// \param adjacent pairs of unknowns with an entry in the matrix, each at least once, either way round
Dissected nested_dissection(std::size_t unknowns, const std::vector<std::pair<int, int>>& adjacent,
                            std::size_t largest_part);

}  // namespace anisomesh::detail
