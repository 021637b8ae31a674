#include "shapes/planar_sampling.hh"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace anisomesh::detail {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double jitter = 0.35;  // of the spacing, either way: visibly irregular, no two points meet

double symmetric(std::mt19937& generator) { return 2 * uniform(generator) - 1; }

/// The indices of (position along the border, index) pairs by position.
std::vector<int> in_order(std::vector<std::pair<double, int>>& around) {
  std::sort(around.begin(), around.end());
  std::vector<int> indices(around.size());
  std::transform(around.begin(), around.end(), indices.begin(),
                 [](const auto& entry) { return entry.second; });
  return indices;
}

}  // namespace

double uniform(std::mt19937& generator) {
  const auto high = static_cast<double>(generator() >> 5U), low = static_cast<double>(generator() >> 6U);
  return (high * 67108864.0 + low) / 9007199254740992.0;
}

double gaussian(std::mt19937& generator) {
  const double radius = std::sqrt(-2 * std::log(1 - uniform(generator)));
  return radius * std::cos(2 * pi * uniform(generator));
}

PlanarSampling regular_rectangle(double width, double height, int columns, int rows) {
  PlanarSampling sampling;
  const auto index = [&](int i, int j) { return j * (columns + 1) + i; };
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i)  // the quotient first: the last column lies at `width` to the last bit
      sampling.points.emplace_back(width * (static_cast<double>(i) / columns),
                                   height * (static_cast<double>(j) / rows));
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int a = index(i, j), b = index(i + 1, j), c = index(i + 1, j + 1), d = index(i, j + 1);
      if ((2 * i < columns) == (2 * j < rows)) {
        sampling.triangles.push_back({a, b, c});
        sampling.triangles.push_back({a, c, d});
      } else {
        sampling.triangles.push_back({a, b, d});
        sampling.triangles.push_back({b, c, d});
      }
    }
  return sampling;
}

PlanarSampling regular_disc(int spokes, int rings, int crease_rays) {
  PlanarSampling sampling;
  const auto first_of = [&](int ring) { return ring == 0 ? 0 : 1 + spokes * ring * (ring - 1) / 2; };
  const auto index = [&](int ring, int i) { return ring == 0 ? 0 : first_of(ring) + i % (spokes * ring); };
  sampling.points.emplace_back(0, 0);
  for (int ring = 1; ring <= rings; ++ring)
    for (int i = 0; i < spokes * ring; ++i) {
      const double angle = 2 * pi * i / (spokes * ring), radius = static_cast<double>(ring) / rings;
      sampling.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
  for (int ring = 1; ring <= rings; ++ring)
    for (int spoke = 0; spoke < spokes; ++spoke)
      for (int i = 0; i < ring; ++i) {
        const int outer = spoke * ring + i, inner = spoke * (ring - 1) + i;
        sampling.triangles.push_back({index(ring - 1, inner), index(ring, outer), index(ring, outer + 1)});
        if (i + 1 < ring)
          sampling.triangles.push_back(
              {index(ring - 1, inner), index(ring, outer + 1), index(ring - 1, inner + 1)});
      }
  for (int ray = 0; ray < crease_rays; ++ray)
    for (int ring = 1; ring <= rings; ++ring) {
      const int spoke = ray * spokes / crease_rays;
      sampling.creases.emplace_back(index(ring - 1, spoke * (ring - 1)), index(ring, spoke * ring));
    }
  return sampling;
}

void make_irregular_rectangle(PlanarSampling& sampling, double width, double height, double spacing,
                              std::mt19937& generator) {
  std::vector<int> order(sampling.points.size());
  std::iota(order.begin(), order.end(), 0);
  std::vector<std::pair<double, int>> around;  // position along the border, index
  for (const int i : order) {
    Vec2d& p = sampling.points[static_cast<size_t>(i)];
    const bool side = p[0] == 0 || p[0] == width, level = p[1] == 0 || p[1] == height;
    const Vec2d move(side ? 0 : jitter * spacing * symmetric(generator),
                     level ? 0 : jitter * spacing * symmetric(generator));
    p += move;
    if (p[1] == 0)
      around.emplace_back(p[0], i);
    else if (p[0] == width)
      around.emplace_back(width + p[1], i);
    else if (p[1] == height)
      around.emplace_back(2 * width + height - p[0], i);
    else if (p[0] == 0)
      around.emplace_back(2 * width + 2 * height - p[1], i);
  }
  triangulate_delaunay(sampling, in_order(around));
}

void make_irregular_disc(PlanarSampling& sampling, int crease_rays, double spacing, std::mt19937& generator) {
  std::vector<char> fixed(sampling.points.size(), 0), crease(sampling.points.size(), 0);
  for (const auto& [a, b] : sampling.creases)
    crease[static_cast<size_t>(a)] = crease[static_cast<size_t>(b)] = 1;
  if (crease_rays > 0) fixed[0] = 1;
  std::vector<std::pair<double, int>> around;
  for (size_t i = 0; i < sampling.points.size(); ++i) {
    Vec2d& p = sampling.points[i];
    const double radius = p.norm(), angle = std::atan2(p[1], p[0]);
    const double shift = jitter * spacing * symmetric(generator),
                 turn = jitter * spacing * symmetric(generator);
    const bool border = radius > 1 - spacing / 2;
    if (fixed[i] || (border && crease[i])) {
      // a corner stays
    } else if (border) {
      p = Vec2d(std::cos(angle + turn), std::sin(angle + turn));
    } else if (crease[i]) {
      p *= (radius + shift) / radius;
    } else {
      p += Vec2d(shift, turn);
    }
    if (border) around.emplace_back(std::atan2(p[1], p[0]), static_cast<int>(i));
  }
  triangulate_delaunay(sampling, in_order(around));
}

}  // namespace anisomesh::detail
