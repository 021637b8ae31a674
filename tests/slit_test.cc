// Borders that lie on one another: the sides of a slit have the same vertices, and no T-junctions.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include "anisomesh/compare.hh"
#include "anisomesh/remesh.hh"
#include "catch.hh"
#include "sound_result.hh"

using namespace anisomesh;

namespace {

/// A wavy sheet of n x n squares with a slit in its middle row, straight or not; on one side of it every
/// second square is divided the other way, so that the sides are no mirror images. \param to_rim it goes on
/// there, and the sheet is a disc
OpenMesh::TriMesh slit_sheet(int n, double bend, bool to_rim) {
  OpenMesh::TriMesh mesh;
  const auto place = [&](int i, int j) {
    const double u = static_cast<double>(i) / n, v = static_cast<double>(j) / n;
    return Vec3d(u, v + bend * std::sin(6 * u) * v * (1 - v), 0.2 * std::sin(5 * u) * std::cos(3 * v));
  };
  std::vector<OpenMesh::VertexHandle> vertex;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) vertex.push_back(mesh.add_vertex(place(i, j)));
  std::map<int, OpenMesh::VertexHandle> other;  // in the middle row, for what is above
  for (int i = to_rim ? 0 : n / 4 + 1; i < 3 * n / 4; ++i) other[i] = mesh.add_vertex(place(i, n / 2));
  const auto at = [&](int i, int j, bool above) {
    const auto found = other.find(i);
    return above && j == n / 2 && found != other.end() ? found->second
                                                       : vertex[static_cast<size_t>(j * (n + 1) + i)];
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const bool above = j >= n / 2;
      const auto a = at(i, j, above), b = at(i + 1, j, above), c = at(i + 1, j + 1, above),
                 d = at(i, j + 1, above);
      if (above && i % 2 == 1) {
        mesh.add_face(a, b, d);
        mesh.add_face(b, c, d);
      } else {
        mesh.add_face(a, b, c);
        mesh.add_face(a, c, d);
      }
    }
  return mesh;
}

}  // namespace

TEST_CASE("both sides of a slit have the same vertices, fitted or not", "[slit]") {
  for (const double bend : {0.0, 0.5})
    for (const bool fit : {true, false})
      for (const Domain domain : {Domain::surface, Domain::plane}) {
        auto mesh = slit_sheet(24, bend, domain == Domain::plane);
        RemeshOptions options;
        options.domain = domain;
        options.target_faces = 150;
        options.fit.enabled = fit;
        auto result = remesh(mesh, options);
        CompareOptions compare_options;
        compare_options.samples = 5000;
        const Comparison c = compare(mesh, result, compare_options);
        check_sound(c);
        CHECK(c.border_loops == (domain == Domain::plane ? 1 : 2));
        // Each edge of the inner border has another on it.
        std::map<std::array<double, 6>, int> edges;
        for (const auto h : result.halfedges()) {
          if (!h.is_boundary()) continue;
          const Vec3d p = result.point(h.from()), q = result.point(h.to());
          ++edges[{p[0], p[1], p[2], q[0], q[1], q[2]}];
        }
        size_t twins = 0;
        for (const auto& [edge, count] : edges)
          twins += edges.count({edge[3], edge[4], edge[5], edge[0], edge[1], edge[2]});
        CHECK(twins >= 4);
        // All edges of the slit: the others are on the rim of the square.
        size_t inner = 0;
        for (const auto& [edge, count] : edges) {
          const auto on_rim = [&edge = edge](size_t k) {
            return std::max(edge[k], edge[k + 3]) < 0.001 || std::min(edge[k], edge[k + 3]) > 0.999;
          };
          inner += !on_rim(0) && !on_rim(1);
        }
        CHECK(twins == inner);
      }
}
