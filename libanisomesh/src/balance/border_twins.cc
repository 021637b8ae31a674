#include "balance/border_twins.hh"

#include <algorithm>
#include <tuple>

namespace anisomesh::detail {

std::vector<std::vector<int>> border_twins(const OpenMesh::PolyMesh& mesh) {
  std::vector<int> border;
  for (const auto v : mesh.vertices())
    if (v.is_boundary() && !mesh.is_isolated(v)) border.push_back(v.idx());
  const auto point = [&](int v) -> const Vec3d& { return mesh.point(OpenMesh::VertexHandle(v)); };
  std::sort(border.begin(), border.end(), [&](int v, int w) {
    const Vec3d &p = point(v), &q = point(w);
    return std::tie(p[0], p[1], p[2], v) < std::tie(q[0], q[1], q[2], w);
  });
  std::vector<std::vector<int>> groups;
  for (size_t first = 0, end = 0; first < border.size(); first = end) {
    while (end < border.size() && point(border[end]) == point(border[first])) ++end;
    if (end - first > 1)
      groups.emplace_back(border.begin() + static_cast<std::ptrdiff_t>(first),
                          border.begin() + static_cast<std::ptrdiff_t>(end));
  }
  return groups;
}

}  // namespace anisomesh::detail
