#include "numerics/dissection.hh"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace anisomesh::detail {

namespace {

using std::size_t;

class Dissection {
 public:
  Dissection(size_t unknowns, const std::vector<std::pair<int, int>>& adjacent, size_t largest_part)
      : largest_part_(largest_part),
        offset_(unknowns + 1, 0),
        part_(unknowns, 0),
        seen_(unknowns, 0),
        order_(unknowns) {
    for (const auto& [a, b] : adjacent) {
      ++offset_[static_cast<size_t>(a) + 1];
      ++offset_[static_cast<size_t>(b) + 1];
    }
    std::partial_sum(offset_.begin(), offset_.end(), offset_.begin());
    neighbour_.resize(static_cast<size_t>(offset_.back()));
    auto next = offset_;
    for (const auto& [a, b] : adjacent) {
      neighbour_[static_cast<size_t>(next[static_cast<size_t>(a)]++)] = b;
      neighbour_[static_cast<size_t>(next[static_cast<size_t>(b)]++)] = a;
    }
    std::iota(order_.begin(), order_.end(), 0);
    run();
  }

  Dissected take() { return {std::move(order_), std::move(undivided_)}; }

 private:
  struct Range {
    size_t begin, end;  ///< of order_
  };

  /// Parts still to be ordered are on a stack, so that deep dissections need no deep recursion.
  void run() {
    std::vector<Range> open{{0, order_.size()}};
    while (!open.empty()) {
      const Range range = open.back();
      open.pop_back();
      if (range.end - range.begin > largest_part_)
        split(range, open);
      else
        undivided_.emplace_back(range.begin, range.end);
    }
  }

  /// Breadth first search within a part: `queue_` gets the unknowns reached, `level_begin_` where each level
  /// starts in it, and the end.
  void search(int start, int part) {
    ++search_;
    queue_.assign(1, start);
    level_begin_.assign(1, 0);
    seen_[static_cast<size_t>(start)] = search_;
    for (size_t begin = 0, end = 1; begin < end; begin = end, end = queue_.size()) {
      for (size_t i = begin; i < end; ++i) {
        const auto v = static_cast<size_t>(queue_[i]);
        for (int k = offset_[v]; k < offset_[v + 1]; ++k) {
          const int w = neighbour_[static_cast<size_t>(k)];
          if (part_[static_cast<size_t>(w)] != part || seen_[static_cast<size_t>(w)] == search_) continue;
          seen_[static_cast<size_t>(w)] = search_;
          queue_.push_back(w);
        }
      }
      level_begin_.push_back(end);
    }
  }

  /// The thinnest level with at least a third of the unknowns on either side, or that of the median.
  size_t separating_level() const {
    const size_t n = queue_.size(), levels = level_begin_.size() - 1;
    size_t best = 0, least = n + 1;
    for (size_t level = 0; level < levels; ++level) {
      const size_t begin = level_begin_[level], end = level_begin_[level + 1];
      const bool median = begin <= n / 2 && n / 2 < end;
      const bool balanced = begin >= n / 3 && n - end >= n / 3;
      if ((balanced || (median && least > n)) && end - begin < least) {
        best = level;
        least = end - begin;
      }
    }
    return best;
  }

  void split(const Range& range, std::vector<Range>& open) {
    const int part = ++parts_;
    for (size_t i = range.begin; i < range.end; ++i) part_[static_cast<size_t>(order_[i])] = part;
    search(order_[range.begin], part);
    for (int i = 0; i < 2; ++i) search(queue_.back(), part);  // from a far end, levels are thin
    if (queue_.size() < range.end - range.begin) {
      separate_component(range, part, open);
      return;
    }
    const size_t level = separating_level();
    const auto begin = queue_.begin();
    const auto separator_begin = begin + static_cast<std::ptrdiff_t>(level_begin_[level]),
               separator_end = begin + static_cast<std::ptrdiff_t>(level_begin_[level + 1]);
    // near half | separator | far half  ->  near half | far half | separator
    const auto far_end = std::rotate(separator_begin, separator_end, queue_.end());
    std::copy(queue_.begin(), queue_.end(), order_.begin() + static_cast<std::ptrdiff_t>(range.begin));
    const size_t near_end = range.begin + level_begin_[level];
    open.push_back({range.begin, near_end});
    open.push_back({near_end, range.begin + static_cast<size_t>(far_end - begin)});
  }

  /// The part is not connected: what the search reached comes first.
  void separate_component(const Range& range, int part, std::vector<Range>& open) {
    for (const int v : queue_) part_[static_cast<size_t>(v)] = part + 1;
    ++parts_;
    const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(range.begin),
               end = order_.begin() + static_cast<std::ptrdiff_t>(range.end);
    std::stable_partition(begin, end, [&](int v) { return part_[static_cast<size_t>(v)] != part; });
    const size_t middle = range.begin + queue_.size();
    open.push_back({range.begin, middle});
    open.push_back({middle, range.end});
  }

  size_t largest_part_;
  std::vector<std::pair<size_t, size_t>> undivided_;
  std::vector<int> offset_, neighbour_;
  std::vector<int> part_, seen_;  ///< the part and the last search an unknown was in
  std::vector<int> order_, queue_;
  std::vector<size_t> level_begin_;
  int parts_ = 0, search_ = 0;
};

}  // namespace

Dissected nested_dissection(std::size_t unknowns, const std::vector<std::pair<int, int>>& adjacent,
                            std::size_t largest_part) {
  return Dissection(unknowns, adjacent, largest_part).take();
}

}  // namespace anisomesh::detail
