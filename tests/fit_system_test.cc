// The sparse least squares of the fit.
#include "fit/fit_system.hh"

#include <cmath>

#include "catch.hh"

using namespace anisomesh::detail;
using OpenMesh::PolyMesh;

TEST_CASE("the steps of the fit are those that its rows ask for, and vertices that are not free stay",
          "[fit]") {
  // A net of squares, each of which pulls the mean of its corners one way and stiffens its sides a little.
  const int n = GENERATE(2, 9, 40);
  PolyMesh net;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) net.add_vertex({static_cast<double>(i), static_cast<double>(j), 0});
  const auto at = [&](int i, int j) { return OpenMesh::VertexHandle(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) net.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  const FitMesh mesh(net);
  const FitPattern pattern(mesh);
  std::vector<char> free(net.n_vertices(), 1);
  free.front() = free.back() = 0;
  std::vector<Vec3d> wanted;
  for (size_t v = 0; v < free.size(); ++v) {
    const auto x = static_cast<double>(v);
    wanted.push_back(free[v] ? Vec3d(std::sin(x), std::cos(3 * x), std::sin(x * x)) : Vec3d(0, 0, 0));
  }
  FitSystem system(free, pattern);
  const auto ask = [&](const auto& corner, const auto& factor, const Vec3d& direction, double weight) {
    double sum = 0;
    for (size_t k = 0; k < std::size(corner); ++k)
      sum += factor[k] * (direction | wanted[static_cast<size_t>(corner[k])]);
    system.add_row(corner, factor, direction, sum, weight);
  };
  for (int p = 0; p < mesh.n_polygons(); ++p) {
    const int* c = mesh.begin(p);
    for (int k = 0; k < 4; ++k) {
      const int corner[4] = {c[k], c[(k + 1) % 4], c[(k + 2) % 4], c[(k + 3) % 4]},
                side[2] = {c[k], c[(k + 1) % 4]};
      const double shares[4] = {0.6, 0.2, 0.1, 0.1}, along[2] = {-1, 1};
      ask(corner, shares, Vec3d(0, 0.6, 0.8), 3);
      ask(side, along, Vec3d(1, 0, 0), 0.01);
      for (const Vec3d& axis : {Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)}) {
        const int one[1] = {c[k]};
        const double whole[1] = {1};
        ask(one, whole, axis, 0.02);
      }
    }
  }
  const std::vector<Vec3d> steps = system.solve();
  REQUIRE(steps.size() == free.size());
  double off = 0, all = 0;
  for (size_t v = 0; v < free.size(); ++v) {
    if (!free[v]) CHECK(steps[v] == Vec3d(0, 0, 0));
    off += (steps[v] - wanted[v]).sqrnorm();
    all += wanted[v].sqrnorm();
  }
  CHECK(std::sqrt(off / all) < 0.01);
}
