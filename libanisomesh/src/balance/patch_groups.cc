#include "balance/patch_groups.hh"

#include <algorithm>

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

}  // namespace

void PatchGroups::add_three(int p, int q, int r) {
  std::array<int, 3> three{p, q, r};
  std::sort(three.begin(), three.end());
  if (threes_.insert(three).second) groups_.push_back({p, q, r});
}

void PatchGroups::add_around(int polygon) {
  const std::vector<int> beside = mesh_.around(polygon);
  for (size_t i = 0; i < beside.size(); ++i)
    for (size_t j = 0; j < i; ++j) groups_.push_back({polygon, beside[j], beside[i]});
}

void PatchGroups::add_between_triangles(const std::vector<std::vector<int>>& pairs) {
  first_for_pairs_ = groups_.size();
  const auto& polygons = mesh_.polygons();
  std::vector<std::vector<int>> triangles(polygons.size());  // beside each quad
  for (size_t p = 0; p < polygons.size(); ++p) {
    if (polygons[p].size() != 3) continue;
    for (const int q : mesh_.around(static_cast<int>(p)))
      if (polygons[at(q)].size() == 4) triangles[at(q)].push_back(static_cast<int>(p));
  }
  for (size_t quad = 0; quad < triangles.size(); ++quad)
    for (size_t i = 0; i < triangles[quad].size(); ++i)
      for (size_t j = 0; j < i; ++j)
        add_three(triangles[quad][j], static_cast<int>(quad), triangles[quad][i]);
  for (const auto& pair : pairs)
    for (const int p : triangles[at(pair[0])])
      for (const int q : triangles[at(pair[1])])
        if (p != q) groups_.push_back({p, pair[0], pair[1], q});
}

}  // namespace anisomesh::detail
