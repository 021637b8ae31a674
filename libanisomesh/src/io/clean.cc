#include <algorithm>
#include <numeric>
#include <set>

#include "io/soup.hh"

namespace anisomesh::detail {

size_t keep_faces(Soup& soup, const std::vector<char>& keep) {
  if (std::find(keep.begin(), keep.end(), 0) == keep.end()) return 0;
  Soup kept;
  kept.corners.reserve(soup.corners.size());
  kept.begins.reserve(soup.begins.size());
  for (size_t f = 0; f < soup.n_faces(); ++f) {
    if (!keep[f]) continue;
    kept.corners.insert(kept.corners.end(), soup.face(f), soup.face(f) + soup.degree(f));
    kept.end_face();
  }
  const size_t dropped = soup.n_faces() - kept.n_faces();
  soup.corners = std::move(kept.corners);
  soup.begins = std::move(kept.begins);
  return dropped;
}

void drop_degenerate_faces(Soup& soup, ReadReport& report) {
  std::vector<int> seen(soup.points.size(), -1);
  std::vector<char> keep(soup.n_faces(), 1);
  for (size_t f = 0; f < soup.n_faces(); ++f)
    for (size_t k = 0; k < soup.degree(f); ++k) {
      int& last_face = seen[static_cast<size_t>(soup.face(f)[k])];
      if (last_face == static_cast<int>(f)) keep[f] = 0;
      last_face = static_cast<int>(f);
    }
  report.degenerate_faces += keep_faces(soup, keep);
}

void drop_duplicate_faces(Soup& soup, ReadReport& report) {
  // Faces are listed at their lowest corner, so that only few have to be compared.
  const size_t n = soup.points.size();
  std::vector<size_t> begin(n + 1, 0);
  std::vector<int> lowest(soup.n_faces());
  for (size_t f = 0; f < soup.n_faces(); ++f) {
    lowest[f] = *std::min_element(soup.face(f), soup.face(f) + soup.degree(f));
    ++begin[static_cast<size_t>(lowest[f]) + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<size_t> faces(soup.n_faces());
  std::vector<size_t> fill(begin.begin(), begin.end() - 1);
  for (size_t f = 0; f < soup.n_faces(); ++f) faces[fill[static_cast<size_t>(lowest[f])]++] = f;

  std::vector<char> keep(soup.n_faces(), 1);
  std::set<std::vector<int>> corner_sets;
  for (size_t v = 0; v < n; ++v) {
    if (begin[v + 1] - begin[v] < 2) continue;
    corner_sets.clear();
    for (size_t i = begin[v]; i < begin[v + 1]; ++i) {
      const size_t f = faces[i];
      std::vector<int> corners(soup.face(f), soup.face(f) + soup.degree(f));
      std::sort(corners.begin(), corners.end());
      if (!corner_sets.insert(std::move(corners)).second) keep[f] = 0;
    }
  }
  report.duplicate_faces += keep_faces(soup, keep);
}

void take_places(Soup& soup, DisjointSets& places) {
  for (int& corner : soup.corners) corner = static_cast<int>(places.root(static_cast<size_t>(corner)));
}

void drop_isolated_vertices(Soup& soup, DisjointSets& places, ReadReport& report) {
  std::vector<char> used(soup.points.size(), 0);
  for (const int v : soup.corners) used[static_cast<size_t>(v)] = 1;
  const size_t n_used = static_cast<size_t>(std::count(used.begin(), used.end(), 1));
  if (n_used == soup.points.size()) return;
  report.vertex_of.assign(soup.points.size(), -1);
  int next = 0;
  for (size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    soup.points[static_cast<size_t>(next)] = soup.points[v];
    report.vertex_of[v] = next++;
  }
  for (size_t v = 0; v < places.size(); ++v) report.vertex_of[v] = report.vertex_of[places.root(v)];
  soup.points.resize(static_cast<size_t>(next));
  report.isolated_vertices +=
      static_cast<size_t>(std::count(report.vertex_of.begin(), report.vertex_of.end(), -1));
  for (int& v : soup.corners) v = report.vertex_of[static_cast<size_t>(v)];
}

}  // namespace anisomesh::detail
