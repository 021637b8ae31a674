#include <cmath>

#include "anisomesh/lines.hh"
#include "catch.hh"
#include "traced_surface.hh"

using namespace anisomesh;

namespace {

double distance_to_border(const Vec3d& p) { return 1 - std::max(std::abs(p[0]), std::abs(p[1])); }

// Samples at least 3/4 of the spacing apart, and no place farther than one and a half from all of them.
void check_sampling(OpenMesh::TriMesh& mesh, double spacing) {
  const SurfaceRef surface = mesh;
  const auto network = read_lines(mesh);
  CHECK(network.lines.empty());
  std::vector<Vec3d> samples;
  for (const auto& p : network.isotropic_samples) samples.push_back(position(surface, p));
  REQUIRE(!samples.empty());
  for (size_t i = 0; i < samples.size(); ++i) {
    CHECK(distance_to_border(samples[i]) >= 0.75 * spacing - 1e-12);
    for (size_t j = i + 1; j < samples.size(); ++j)
      CHECK((samples[i] - samples[j]).norm() >= 0.75 * spacing - 1e-12);
  }
  for (const Vec3d& p : surface.points()) {
    double nearest = distance_to_border(p);
    for (const Vec3d& sample : samples) nearest = std::min(nearest, (p - sample).norm());
    CHECK(nearest <= 1.2 * spacing);
  }
}

}  // namespace

TEST_CASE("a plane is sampled at the largest spacing", "[isotropic]") {
  auto mesh = traced::square(40, [](double, double) { return Vec3d(0, 0, 0); });
  TraceOptions options;
  options.density.max_spacing_fraction = 0.1;
  CHECK(trace_lines(mesh, options).points == 0);
  const auto report = place_isotropic_samples(mesh, options);
  CHECK(report.from_umbilics == 0);
  CHECK(report.random > 0);
  check_sampling(mesh, 0.1 * std::sqrt(8.0));
}

TEST_CASE("a spherical region is sampled at the spacing of equation 6", "[isotropic]") {
  auto mesh = traced::square(40, [](double, double) { return Vec3d(1, 0, 1); });
  trace_lines(mesh);
  place_isotropic_samples(mesh);
  check_sampling(mesh, chord_spacing(1, 0.001 * std::sqrt(8.0)));
}

TEST_CASE("an umbilic where lines end needs no sample, a bare one gets it", "[isotropic]") {
  auto mesh =
      traced::square(31, [](double x, double y) { return Vec3d(2 + x - 0.01, -(y + 0.02), 2 - x + 0.01); });
  trace_lines(mesh);
  place_isotropic_samples(mesh);
  CHECK(read_lines(mesh).isotropic_samples.empty());
  LineNetwork bare;
  write_lines(mesh, bare);
  CHECK(place_isotropic_samples(mesh).from_umbilics == 1);
}

TEST_CASE("samples need lines first, and leave them as they were", "[isotropic]") {
  auto mesh = traced::square(20, traced::constant(0.5, 2, 0.4));
  CHECK_THROWS_WITH(place_isotropic_samples(mesh), Catch::Contains("trace_lines"));
  trace_lines(mesh);
  const auto before = mesh.property(require_property(mesh, property::line_barycentrics));
  place_isotropic_samples(mesh);
  CHECK(mesh.property(require_property(mesh, property::line_barycentrics)) == before);
}
