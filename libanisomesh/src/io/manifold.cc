#include <algorithm>

#include "io/sides.hh"
#include "io/soup.hh"
#include "numerics/disjoint_sets.hh"

namespace anisomesh::detail {

namespace {

/// Height over length of a triangle below which coordinates in a file have rounded its area away.
constexpr double flat = 1e-7;

bool is_flat(const Soup& soup, size_t f) {
  const int* corner = soup.face(f);
  const auto at = [&](int k) -> const Vec3d& { return soup.points[static_cast<size_t>(corner[k % 3])]; };
  double longest = 0;  // squared
  for (int k = 0; k < 3; ++k) longest = std::max(longest, (at(k + 1) - at(k)).sqrnorm());
  return !(((at(1) - at(0)) % (at(2) - at(0))).norm() > flat * longest);
}

/// Largest difference in a coordinate: no square that could overflow.
double apart(const Soup& soup, int v, int w) {
  return (soup.points[static_cast<size_t>(v)] - soup.points[static_cast<size_t>(w)]).l8_norm();
}

}  // namespace

// A parametric source closes its seam with faces between vertices that differ in the last bits.
void join_short_sides(const Soup& soup, DisjointSets& places, ReadReport& report) {
  for (size_t f = 0; f < soup.n_faces(); ++f) {
    const size_t n = soup.degree(f);
    const int* corner = soup.face(f);
    double longest = 0;
    for (size_t k = 0; k < n; ++k) longest = std::max(longest, apart(soup, corner[k], corner[(k + 1) % n]));
    for (size_t k = 0; k < n; ++k)
      if (!(apart(soup, corner[k], corner[(k + 1) % n]) > flat * longest))
        report.joined_vertices +=
            places.join(static_cast<size_t>(corner[k]), static_cast<size_t>(corner[(k + 1) % n]));
  }
}

// Nothing can be made of them, and where they hang on a surface they would cut it open.
void drop_flat_pieces(Soup& soup, ReadReport& report) {
  std::vector<char> is_solid(soup.n_faces(), 0);
  for (size_t f = 0; f < is_solid.size(); ++f) is_solid[f] = !is_flat(soup, f);
  const auto solid = std::count(is_solid.begin(), is_solid.end(), 1);
  if (solid == 0 || solid == static_cast<std::ptrdiff_t>(is_solid.size())) return;
  const Sides sides(soup);
  DisjointSets pieces(soup.n_faces());
  sides.for_each_pair(soup, [&](size_t a, size_t b) { pieces.join(sides.face[a], sides.face[b]); });
  std::vector<char> has_area(soup.n_faces(), 0), keep(soup.n_faces(), 0);
  for (size_t f = 0; f < is_solid.size(); ++f) has_area[pieces.root(f)] |= is_solid[f];
  for (size_t f = 0; f < is_solid.size(); ++f) keep[f] = has_area[pieces.root(f)];
  report.flat_faces += keep_faces(soup, keep);
}

void orient(Soup& soup, ReadReport& report) {
  const Sides sides(soup);
  std::vector<size_t> other(soup.corners.size(), size_t(-1));
  bool consistent = true;
  sides.for_each_pair(soup, [&](size_t a, size_t b) {
    other[a] = b;
    other[b] = a;
    consistent = consistent && soup.corners[a] != soup.corners[b];
  });
  if (consistent) return;

  // A walk over each component gives every face a side; the larger side stays as it is. On a one-sided
  // surface the walk meets itself wrongly somewhere; split_non_manifold() cuts it open there.
  constexpr char unknown = 0, as_is = 1, turned = 2;
  std::vector<char> state(soup.n_faces(), unknown);
  std::vector<size_t> component;
  for (size_t seed = 0; seed < soup.n_faces(); ++seed) {
    if (state[seed] != unknown) continue;
    component.assign(1, seed);
    state[seed] = as_is;
    size_t n_turned = 0;
    for (size_t k = 0; k < component.size(); ++k) {
      const size_t f = component[k];
      for (size_t i = soup.begins[f]; i < soup.begins[f + 1]; ++i) {
        if (other[i] == size_t(-1)) continue;
        const size_t g = sides.face[other[i]];
        if (state[g] != unknown) continue;
        const bool agree = soup.corners[i] != soup.corners[other[i]];
        state[g] = agree ? state[f] : (state[f] == as_is ? turned : as_is);
        n_turned += state[g] == turned;
        component.push_back(g);
      }
    }
    const char turn = 2 * n_turned > component.size() ? as_is : turned;
    for (const size_t f : component)
      if (state[f] == turn) {
        std::reverse(soup.face(f), soup.face(f) + soup.degree(f));
        ++report.reoriented_faces;
      }
  }
}

void split_non_manifold(Soup& soup, ReadReport& report) {
  const Sides sides(soup);
  // Corners at one vertex whose faces share a proper edge there belong to one fan.
  DisjointSets fans(soup.corners.size());
  sides.for_each_pair(soup, [&](size_t a, size_t b) {
    if (soup.corners[a] == soup.corners[b]) return;  // they disagree on orientation
    fans.join(a, sides.next[b]);
    fans.join(sides.next[a], b);
  });
  // The first fan keeps the vertex; each further one gets a copy, in the order of corners.
  std::vector<size_t> fan_of(soup.points.size(), size_t(-1));
  std::vector<int> copy_of(soup.corners.size(), -1);
  for (size_t i = 0; i < soup.corners.size(); ++i) {
    const size_t v = static_cast<size_t>(soup.corners[i]), fan = fans.root(i);
    if (fan_of[v] == size_t(-1)) fan_of[v] = fan;
    if (fan_of[v] == fan) continue;
    if (copy_of[fan] < 0) {
      copy_of[fan] = static_cast<int>(soup.points.size());
      const Vec3d place = soup.points[v];
      soup.points.push_back(place);
      ++report.duplicated_vertices;
    }
    soup.corners[i] = copy_of[fan];
  }
}

}  // namespace anisomesh::detail
