#include "anisomesh/lines.hh"

#include "anisomesh/properties.hh"
#include "catch.hh"
#include "traced_surface.hh"

using namespace anisomesh;

namespace {

LineNetwork some_lines() {
  LineNetwork network;
  const OpenMesh::FaceHandle f0(0), f1(1);
  network.lines.push_back({LineKind::min,
                           false,
                           LineEnd::border,
                           LineEnd::too_close,
                           {{f0, {0.5, 0.25, 0.25}}, {f1, {0, 1, 0}}}});
  network.lines.push_back({LineKind::max, true, LineEnd::loop, LineEnd::loop, {{f1, {0.1, 0.2, 0.7}}}});
  network.isotropic_samples.push_back({f0, {1.0 / 3, 1.0 / 3, 1.0 / 3}});
  return network;
}

}  // namespace

TEST_CASE("a network comes back from the mesh as it was written", "[lines]") {
  auto mesh = traced::square(2, traced::constant(1, 2, 0));
  const auto written = some_lines();
  write_lines(mesh, written);
  const auto read = read_lines(mesh);
  REQUIRE(read.lines.size() == 2);
  for (size_t i = 0; i < 2; ++i) {
    CHECK(read.lines[i].kind == written.lines[i].kind);
    CHECK(read.lines[i].closed == written.lines[i].closed);
    CHECK(read.lines[i].begin_reason == written.lines[i].begin_reason);
    CHECK(read.lines[i].end_reason == written.lines[i].end_reason);
    REQUIRE(read.lines[i].points.size() == written.lines[i].points.size());
    for (size_t j = 0; j < read.lines[i].points.size(); ++j) {
      CHECK(read.lines[i].points[j].face == written.lines[i].points[j].face);
      CHECK(read.lines[i].points[j].barycentric == written.lines[i].points[j].barycentric);
    }
  }
  REQUIRE(read.isotropic_samples.size() == 1);
  CHECK(read.isotropic_samples[0].barycentric == written.isotropic_samples[0].barycentric);
}

TEST_CASE("lines that do not fit the mesh are refused", "[lines]") {
  auto mesh = traced::square(2, traced::constant(1, 2, 0));
  CHECK_THROWS_WITH(read_lines(mesh), Catch::Contains("trace_lines"));
  write_lines(mesh, some_lines());
  auto& table = mesh.property(require_property(mesh, property::line_table));
  auto& faces = mesh.property(require_property(mesh, property::line_faces));
  SECTION("a face that is not there") { faces[1] = 8; }
  SECTION("a missing coordinate") { faces.push_back(0); }
  SECTION("a table cut off") { table.pop_back(); }
  SECTION("an unknown kind") { table[5] = 2; }
  SECTION("an unknown end") { table[2] = 6; }
  SECTION("first points out of order") { table[9] = 4; }
  SECTION("a first point before the start") { table[9] = -1; }
  CHECK_THROWS_AS(read_lines(mesh), InvalidInput);
}
