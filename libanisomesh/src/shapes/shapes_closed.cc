#include "shapes/shapes_closed.hh"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "shapes/planar_sampling.hh"

namespace anisomesh::detail {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double kJitter = 0.35;  // of the spacing, either way

double symmetric(std::mt19937& generator) { return 2 * uniform(generator) - 1; }

/// An icosahedron with a vertex at each pole, its faces cut into frequency^2 triangles, on the unit sphere.
ClosedSampling geodesic_sphere(int frequency) {
  std::vector<Vec3d> corner{{0, 0, 1}};
  for (const double z : {1.0, -1.0})
    for (int i = 0; i < 5; ++i) {
      const double angle = 2 * pi * (i + (z < 0 ? 0.5 : 0)) / 5, r = 2 / std::sqrt(5.0);
      corner.emplace_back(r * std::cos(angle), r * std::sin(angle), z / std::sqrt(5.0));
    }
  corner.emplace_back(0, 0, -1);
  std::vector<std::array<int, 3>> faces;
  for (int i = 0; i < 5; ++i) {
    const int a = 1 + i, b = 1 + (i + 1) % 5, c = 6 + i, d = 6 + (i + 1) % 5;
    faces.insert(faces.end(), {{0, a, b}, {a, c, b}, {b, c, d}, {11, d, c}});
  }
  ClosedSampling result;
  // A point is known by the corners that it is a mean of, and their weights.
  std::map<std::array<int, 6>, int> known;
  const auto point = [&](const std::array<int, 3>& face, int i, int j, int k) {
    std::array<std::pair<int, int>, 3> parts{{{face[0], i}, {face[1], j}, {face[2], k}}};
    for (auto& part : parts)
      if (part.second == 0) part.first = -1;
    std::sort(parts.begin(), parts.end());
    const std::array<int, 6> key{parts[0].first,  parts[0].second, parts[1].first,
                                 parts[1].second, parts[2].first,  parts[2].second};
    const auto [it, is_new] = known.try_emplace(key, static_cast<int>(result.points.size()));
    if (is_new) {
      Vec3d sum(0, 0, 0);
      for (const auto& [c, weight] : parts)
        if (weight > 0) sum += weight * corner[static_cast<size_t>(c)];
      result.points.push_back(sum.normalized());
    }
    return it->second;
  };
  for (const auto& face : faces)
    for (int i = 0; i < frequency; ++i)
      for (int j = 0; j < frequency - i; ++j) {
        const int k = frequency - i - j;
        result.triangles.push_back(
            {point(face, k, i, j), point(face, k - 1, i + 1, j), point(face, k - 1, i, j + 1)});
        if (i + j + 2 <= frequency)
          result.triangles.push_back(
              {point(face, k - 1, i + 1, j), point(face, k - 2, i + 1, j + 1), point(face, k - 1, i, j + 1)});
      }
  return result;
}

/// The Delaunay triangulation on the sphere: that of the stereographic projection from point 0, (0, 0, 1), to
/// which the rim is joined.
void triangulate_sphere(ClosedSampling& sphere) {
  PlanarSampling plane;
  for (size_t i = 1; i < sphere.points.size(); ++i) {
    const Vec3d& p = sphere.points[i];
    plane.points.emplace_back(p[0] / (1 - p[2]), p[1] / (1 - p[2]));
  }
  triangulate_delaunay(plane, {});
  sphere.triangles.clear();
  std::map<std::pair<int, int>, int> open;  // edges whose other side has no triangle
  for (const auto& t : plane.triangles) {
    // Seen from the pole, counter-clockwise in the plane is clockwise from outside.
    sphere.triangles.push_back({t[0] + 1, t[2] + 1, t[1] + 1});
    for (size_t i = 0; i < 3; ++i) {
      const int a = t[i] + 1, b = t[(i + 1) % 3] + 1;
      if (open.erase({b, a}) == 0) open[{a, b}] = 1;
    }
  }
  for (const auto& entry : open) sphere.triangles.push_back({entry.first.first, entry.first.second, 0});
}

ClosedSampling sample_sphere(const Vec3d& semi_axes, const ShapeOptions& options, std::mt19937& generator) {
  const int frequency = std::max(1, static_cast<int>(std::lround(std::sqrt((options.vertices - 2) / 10.0))));
  ClosedSampling sphere = geodesic_sphere(frequency);
  if (options.irregular) {
    const double spacing = std::sqrt(4 * pi / static_cast<double>(sphere.points.size()));
    for (size_t i = 1; i < sphere.points.size(); ++i)
      for (int k = 0; k < 3; ++k) sphere.points[i][k] += kJitter * spacing * symmetric(generator);
    for (Vec3d& p : sphere.points) p.normalize();
    triangulate_sphere(sphere);
  }
  for (Vec3d& p : sphere.points) p *= semi_axes;
  return sphere;
}

/// Delaunay on the flat torus: of nine copies side by side the triangles whose middle lies in the central
/// one.
std::vector<std::array<int, 3>> triangulate_periodic(const std::vector<Vec2d>& points, double width,
                                                     double height) {
  PlanarSampling tiled;
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i)
      for (const Vec2d& p : points) tiled.points.push_back(p + Vec2d(i * width, j * height));
  triangulate_delaunay(tiled, {});
  std::vector<std::array<int, 3>> result;
  const int n = static_cast<int>(points.size());
  for (const auto& t : tiled.triangles) {
    Vec2d middle(0, 0);
    for (const int v : t) middle += tiled.points[static_cast<size_t>(v)] / 3;
    if (middle[0] >= 0 && middle[0] < width && middle[1] >= 0 && middle[1] < height)
      result.push_back({t[0] % n, t[1] % n, t[2] % n});
  }
  return result;
}

ClosedSampling sample_torus(double ring, double tube, const ShapeOptions& options, std::mt19937& generator) {
  const double width = 2 * pi * ring, height = 2 * pi * tube;
  const double spacing = std::sqrt(width * height / options.vertices);
  const int columns = std::max(5, static_cast<int>(std::lround(width / spacing)));
  const int rows = std::max(3, static_cast<int>(std::lround(height / spacing)));
  std::vector<Vec2d> points;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) points.emplace_back(width * i / columns, height * j / rows);
  ClosedSampling torus;
  constexpr int kFewest = 5;  // with fewer rows an edge may come twice
  if (options.irregular && rows >= kFewest) {
    for (Vec2d& p : points)
      p += Vec2d(kJitter * width / columns * symmetric(generator),
                 kJitter * height / rows * symmetric(generator));
    torus.triangles = triangulate_periodic(points, width, height);
  } else {
    const auto at = [&](int i, int j) { return (j % rows) * columns + i % columns; };
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i) {
        torus.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        torus.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
  }
  for (const Vec2d& p : points) {
    const double u = p[0] / ring, v = p[1] / tube, d = ring + tube * std::cos(v);
    torus.points.emplace_back(d * std::cos(u), d * std::sin(u), tube * std::sin(v));
  }
  return torus;
}

/// The cube [-1, 1]^3, each side a grid of n x n cells; its twelve edges are creases.
ClosedSampling sample_cube(const ShapeOptions& options, std::mt19937& generator) {
  const int n = std::max(1, static_cast<int>(std::lround(std::sqrt((options.vertices - 2) / 6.0))));
  ClosedSampling cube;
  std::map<std::array<int, 3>, int> known;
  const auto index = [&](const std::array<int, 3>& cell) {
    const auto [it, is_new] = known.try_emplace(cell, static_cast<int>(cube.points.size()));
    if (is_new) {
      Vec3d p;
      for (size_t k = 0; k < 3; ++k) {
        p[k] = 2.0 * cell[k] / n - 1;
        const bool inside = cell[k] > 0 && cell[k] < n;
        if (options.irregular && inside) p[k] += kJitter * 2 / n * symmetric(generator);
      }
      cube.points.push_back(p);
    }
    return it->second;
  };
  for (size_t axis = 0; axis < 3; ++axis)
    for (const int side : {0, n}) {
      // u, v and the outward normal make a right-handed frame.
      const size_t u = side == n ? (axis + 1) % 3 : (axis + 2) % 3, v = 3 - axis - u;
      const auto at = [&](int i, int j) {
        std::array<int, 3> cell{};
        cell[axis] = side;
        cell[u] = i;
        cell[v] = j;
        return index(cell);
      };
      PlanarSampling plane;
      std::vector<int> name;
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
          name.push_back(at(i, j));
          const Vec3d& p = cube.points[static_cast<size_t>(name.back())];
          plane.points.emplace_back(p[u], p[v]);
        }
      std::vector<int> border;
      border.reserve(4 * static_cast<size_t>(n));
      for (int i = 0; i < n; ++i) border.push_back(i);
      for (int j = 0; j < n; ++j) border.push_back(j * (n + 1) + n);
      for (int i = n; i > 0; --i) border.push_back(n * (n + 1) + i);
      for (int j = n; j > 0; --j) border.push_back(j * (n + 1));
      if (options.irregular) {
        triangulate_delaunay(plane, border);
      } else {
        plane.triangles = regular_rectangle(2, 2, n, n).triangles;
      }
      for (const auto& t : plane.triangles)
        cube.triangles.push_back({name[static_cast<size_t>(t[0])], name[static_cast<size_t>(t[1])],
                                  name[static_cast<size_t>(t[2])]});
      for (size_t i = 0; i < border.size(); ++i) {
        const int a = name[static_cast<size_t>(border[i])],
                  b = name[static_cast<size_t>(border[(i + 1) % border.size()])];
        if (a < b) cube.creases.emplace_back(a, b);  // the side beyond it has the same edge the other way
      }
    }
  return cube;
}

}  // namespace

std::optional<ClosedSampling> sample_closed_shape(const std::string& name, const ShapeOptions& options,
                                                  std::mt19937& generator) {
  if (name == "sphere") return sample_sphere({1, 1, 1}, options, generator);
  if (name == "ellipsoid") return sample_sphere({1, 0.6, 0.35}, options, generator);
  if (name == "torus") return sample_torus(1, 0.4, options, generator);
  if (name == "cube") return sample_cube(options, generator);
  return std::nullopt;
}

}  // namespace anisomesh::detail
