// Parts that are mostly flat and have few triangles, as print beds: faces of hundreds of corners, most of
// which lie on straight sides.
#include <cmath>

#include "anisomesh/compare.hh"
#include "anisomesh/features.hh"
#include "anisomesh/refine.hh"
#include "anisomesh/remesh.hh"
#include "catch.hh"
#include "sound_result.hh"

using namespace anisomesh;

namespace {

constexpr double pi = 3.14159265358979323846;

/// A plate with round corners of so many sides each, and a short side more at both ends of these as in files
/// that hold few digits; both faces are drawn from one corner.
OpenMesh::TriMesh plate(double half_width, double radius, double thickness, int sides) {
  constexpr double short_side = 1.7e-5;
  std::vector<Vec3d> rim;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double sx = quarter == 0 || quarter == 3 ? 1 : -1, sy = quarter < 2 ? 1 : -1;
    const Vec3d middle(sx * (half_width - radius), sy * (1 - radius), 0);
    const auto outward = [&](double turn) {
      const double angle = 0.5 * pi * (quarter + turn);
      return Vec3d(std::cos(angle), std::sin(angle), 0);
    };
    const Vec3d first = outward(0), last = outward(1);
    rim.push_back(middle + (radius + short_side) * first - short_side * last);
    for (int i = 0; i <= sides; ++i) rim.push_back(middle + radius * outward(static_cast<double>(i) / sides));
    rim.push_back(middle + (radius + short_side) * last - short_side * first);
  }
  OpenMesh::TriMesh mesh;
  std::vector<OpenMesh::VertexHandle> low, high;
  for (const Vec3d& p : rim) low.push_back(mesh.add_vertex(OpenMesh::TriMesh::Point(p[0], p[1], 0)));
  for (const Vec3d& p : rim) high.push_back(mesh.add_vertex(OpenMesh::TriMesh::Point(p[0], p[1], thickness)));
  const size_t n = rim.size();
  for (size_t i = 0; i < n; ++i) {
    const size_t next = (i + 1) % n;
    mesh.add_face(low[i], low[next], high[next]);
    mesh.add_face(low[i], high[next], high[i]);
    if (i > 0 && next > 0)
      mesh.add_face(high[0], high[i], high[next]), mesh.add_face(low[0], low[next], low[i]);
  }
  return mesh;
}

}  // namespace

// Chords along a straight side cut off what has no area, and a face with a sample in it was laid on a circle,
// where chords outside of it seemed to be inside; and the search began without the features, with lines a
// thousand times too dense: 388 faces, six retries and eight attempts.
TEST_CASE("a plate with round corners has the faces that are wanted, at once", "[flat]") {
  struct Shape {
    double half_width, radius, thickness;
  };
  for (const auto& [half_width, radius, thickness] :
       {Shape{1, 0.0128, 0.0128}, {1, 0.0255, 0.0255}, {1.3, 0.02, 0.08}}) {
    auto mesh = plate(half_width, radius, thickness, 23);
    const size_t wanted = mesh.n_faces() / 2;
    REQUIRE(tag_features(mesh).is_mechanical());
    mesh = refine(mesh);
    RemeshOptions options;
    options.target_faces = wanted;
    RemeshReport report;
    auto result = remesh(mesh, options, &report);
    const auto c = compare(mesh, result);
    check_sound(c);
    CHECK(c.two_sided.hausdorff < 1e-4);
    CHECK(static_cast<double>(result.n_faces()) == Approx(static_cast<double>(wanted)).epsilon(0.1));
    CHECK(report.mesh.retries == 0);
    CHECK(report.attempts <= 4);
  }
}
