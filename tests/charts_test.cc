#include "anisomesh/charts.hh"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "anisomesh/domain.hh"
#include "anisomesh/errors.hh"
#include "anisomesh/io.hh"
#include "anisomesh/properties.hh"
#include "anisomesh/remesh.hh"
#include "anisomesh/shapes.hh"
#include "catch.hh"
#include "data.hh"
#include "field/chart_field.hh"
#include "flatten/chart_patch.hh"
#include "lines/make_domain.hh"
#include "numerics/planar_map.hh"
#include "numerics/tensor2d.hh"
#include "sound_result.hh"

using namespace anisomesh;
using namespace anisomesh::detail;

namespace {

std::vector<int> chart_numbers(const OpenMesh::TriMesh& mesh) {
  const auto chart = require_property(mesh, property::chart);
  std::vector<int> numbers;
  for (const auto f : mesh.faces()) numbers.push_back(mesh.property(chart, f));
  return numbers;
}

/// Every chart is one disc, laid out one to one, with areas that change by at most the bound.
void check_atlas(OpenMesh::TriMesh& mesh, const ChartReport& report, double max_stretch) {
  const SurfaceRef surface = mesh;
  const FaceSides sides(surface);
  const auto uv = require_property(mesh, property::chart_uv);
  const auto numbers = chart_numbers(mesh);
  REQUIRE(*std::max_element(numbers.begin(), numbers.end()) + 1 == static_cast<int>(report.charts));
  std::vector<Region> charts(report.charts);
  for (size_t f = 0; f < numbers.size(); ++f)
    charts[static_cast<size_t>(numbers[f])].faces.push_back(static_cast<int>(f));
  const auto side_of = [&](OpenMesh::HalfedgeHandle h) {  // by its start
    const auto f = mesh.face_handle(h);
    const auto c = surface.corners(f);
    const auto v = mesh.from_vertex_handle(h);
    return 3 * f.idx() + (c.vertex[0] == v ? 0 : c.vertex[1] == v ? 1 : 2);
  };
  for (const auto e : mesh.edges()) {
    if (e.is_boundary() || !is_seam(surface, e) || mesh.status(e).feature()) continue;
    const int a = side_of(e.h0()), b = side_of(e.h1());
    if (numbers[static_cast<size_t>(a / 3)] != numbers[static_cast<size_t>(b / 3)]) continue;
    for (const int side : {a, b})
      charts[static_cast<size_t>(numbers[static_cast<size_t>(a / 3)])].slits.push_back(side);
  }
  for (Region& region : charts) {
    std::sort(region.slits.begin(), region.slits.end());
    const ChartPatch chart(surface, sides, region);
    REQUIRE(chart.is_disc());
    std::vector<Vec2d> map(chart.patch.points.size());
    double plane = 0, space = 0;
    for (size_t t = 0; t < region.faces.size(); ++t) {
      auto h = mesh.halfedge_handle(OpenMesh::FaceHandle(region.faces[t]));
      for (size_t i = 0; i < 3; ++i, h = mesh.next_halfedge_handle(h))
        map[static_cast<size_t>(chart.patch.triangles[t][i])] = mesh.property(uv, h);
    }
    std::vector<double> in_plane(map.size(), 0), in_space(map.size(), 0);
    for (size_t t = 0; t < region.faces.size(); ++t) {
      const double area = signed_area(chart.patch, map, t);
      CHECK(area > 0);
      const auto& c = chart.patch.triangles[t];
      const Vec3d p = chart.patch.points[static_cast<size_t>(c[0])];
      const double true_area = 0.5 * ((chart.patch.points[static_cast<size_t>(c[1])] - p) %
                                      (chart.patch.points[static_cast<size_t>(c[2])] - p))
                                         .norm();
      for (const int v : c) {
        in_plane[static_cast<size_t>(v)] += area;
        in_space[static_cast<size_t>(v)] += true_area;
      }
      plane += area;
      space += true_area;
    }
    CHECK(plane == Approx(space).epsilon(1e-9));
    for (size_t v = 0; v < map.size(); ++v) {
      CHECK(in_plane[v] < max_stretch * in_space[v] * (1 + 1e-9));
      CHECK(in_space[v] < max_stretch * in_plane[v] * (1 + 1e-9));
    }
    CHECK(border_is_simple(chart.patch, map));
  }
}

OpenMesh::TriMesh prepared(const std::string& shape, int vertices, ChartReport* report = nullptr) {
  auto mesh = make_shape(shape, {vertices, true});
  estimate_curvature(mesh);
  const auto domain = choose_domain(mesh, anisomesh::Domain::charts);
  if (report) *report = domain.charts;
  smooth_tensors(mesh);
  return mesh;
}

}  // namespace

TEST_CASE("charts are discs that lie flat, whatever the topology", "[charts]") {
  for (const std::string name :
       {"sphere", "ellipsoid", "torus", "cube", "half-torus", "octa-flower", "plane"}) {
    INFO(name);
    auto mesh = make_shape(name, {2000, true});
    const auto report = cut_into_charts(mesh);
    check_atlas(mesh, report, ChartOptions().max_area_stretch);
    CHECK(report.single_triangles == 0);
    CHECK(report.charts <= 8);  // few and large
  }
}

TEST_CASE("what has many borders, many parts or handles is cut too", "[charts]") {
  const std::pair<std::string, int> parts[] = {
      {"pig.stl", 17}, {"elephant.off", 1}, {"cow.off", 1}, {"mech-holes-shark.off", 1}, {"bones.off", 26}};
  for (const auto& [name, n_parts] : parts) {
    const auto path = demo_mesh(name);
    if (!path) return skip(name);
    INFO(name);
    auto mesh = read_surface(*path);
    const auto report = cut_into_charts(mesh);
    check_atlas(mesh, report, ChartOptions().max_area_stretch);
    CHECK(static_cast<double>(report.charts) < n_parts + 0.02 * static_cast<double>(mesh.n_faces()));
  }
}

TEST_CASE("features bound charts", "[charts]") {
  auto cube = make_shape("cube", {1500});
  const auto report = cut_into_charts(cube);
  CHECK(report.charts == 6);
  CHECK(report.seam_edges == 0);
  CHECK(report.max_area_stretch == Approx(1).epsilon(1e-9));
  const auto numbers = chart_numbers(cube);
  for (const auto e : cube.edges())
    CHECK((numbers[static_cast<size_t>(e.h0().face().idx())] !=
           numbers[static_cast<size_t>(e.h1().face().idx())]) == cube.status(e).feature());
}

TEST_CASE("without tags the borders of charts keep to creases", "[charts]") {
  const auto share_on_creases = [](double weight, int triangles) {
    auto cube = make_shape("cube", {triangles});
    for (const auto e : cube.edges()) cube.status(e).set_feature(false);
    ChartOptions options;
    options.crease_weight = weight;
    const auto report = cut_into_charts(cube, options);
    REQUIRE(report.charts > 1);
    const SurfaceRef surface = cube;
    double on_crease = 0;
    for (const auto e : cube.edges()) {
      if (!is_seam(surface, e)) continue;
      const auto a = cube.calc_normal(e.h0().face()), b = cube.calc_normal(e.h1().face());
      if ((a | b) < 0.5) on_crease += cube.calc_edge_length(e);
    }
    return on_crease / report.seam_length;
  };
  double with = 0, without = 0;  // of one cube it is chance where the borders run without the weight
  for (const int triangles : {1000, 2000, 3000, 4000}) {
    const double share = share_on_creases(1, triangles);
    CHECK(share > 0.4);
    with += share;
    without += share_on_creases(0, triangles);
  }
  CHECK(with > 3 * without);
}

TEST_CASE("charts that are there can be kept, and scale with the surface", "[charts]") {
  auto mesh = make_shape("torus", {1500, true});
  cut_into_charts(mesh);
  const auto before = chart_numbers(mesh);
  discard_charts(mesh);
  CHECK_FALSE(has_charts(mesh));
  ChartOptions keep;
  keep.keep_charts = true;
  cut_into_charts(mesh, keep);
  CHECK(chart_numbers(mesh) == before);
  CHECK(has_charts(mesh));
  auto large = make_shape("torus", {1500, true});
  for (const auto v : large.vertices()) large.set_point(v, std::ldexp(1.0, 20) * large.point(v));
  cut_into_charts(large);
  CHECK(chart_numbers(large) == before);
  auto none = make_shape("torus", {1500, true});
  CHECK_THROWS_AS(cut_into_charts(none, keep), InvalidInput);
  ChartOptions wrong;
  wrong.max_area_stretch = 1;
  CHECK_THROWS_AS(cut_into_charts(none, wrong), InvalidOption);
}

TEST_CASE("remesh works in charts that a user brings", "[charts]") {
  auto mesh = make_shape("ellipsoid", {2500, true});
  auto& connectivity = SurfaceRef(mesh).connectivity();
  // Three slices of no shape's choosing.
  const auto slice = [&mesh](OpenMesh::FaceHandle f) {
    const double z = mesh.calc_face_centroid(f)[2] / SurfaceRef(mesh).diagonal();
    return z < -0.05 ? 0 : z < 0.1 ? 1 : 2;
  };
  const auto number = provide_property(connectivity, property::chart);
  for (const auto f : mesh.faces()) mesh.property(number, f) = slice(f);
  RemeshOptions options;
  options.domain = anisomesh::Domain::charts;
  options.charts.keep_charts = true;
  options.target_faces = 500;
  RemeshReport report;
  auto result = remesh(mesh, options, &report);
  CHECK(report.domain.charts.charts >= 3);
  check_sound(compare(mesh, result));
  std::vector<std::set<int>> slices(report.domain.charts.charts);
  for (const auto f : mesh.faces()) slices.at(static_cast<size_t>(mesh.property(number, f))).insert(slice(f));
  for (const auto& of_chart : slices) CHECK(of_chart.size() == 1);
  // without, seams lie elsewhere
  options.charts.keep_charts = false;
  remesh(mesh, options, &report);
  slices.assign(report.domain.charts.charts, {});
  for (const auto f : mesh.faces()) slices.at(static_cast<size_t>(mesh.property(number, f))).insert(slice(f));
  CHECK(std::any_of(slices.begin(), slices.end(), [](const auto& s) { return s.size() > 1; }));
  options.charts.max_area_stretch = 1;
  CHECK_THROWS_AS(remesh(mesh, options), InvalidOption);
}

TEST_CASE("a smaller bound gives more charts", "[charts]") {
  auto mesh = make_shape("ellipsoid", {3000, true});
  ChartOptions options;
  const auto wide = cut_into_charts(mesh, options);
  options.max_area_stretch = 1.2;
  const auto narrow = cut_into_charts(mesh, options);
  check_atlas(mesh, narrow, 1.2);
  CHECK(narrow.charts > wide.charts);
}

TEST_CASE("the field goes on over a seam", "[charts]") {
  ChartReport report;
  auto mesh = prepared("ellipsoid", 5000, &report);
  REQUIRE(report.charts > 1);
  find_umbilics(mesh);
  const SurfaceRef surface = mesh;
  const auto domain = make_domain(surface, DensityOptions());
  double worst[2] = {0, 0}, sum[2] = {0, 0};
  int count[2] = {0, 0};
  for (const auto e : mesh.edges()) {
    // From the middle of one face to beyond the edge and back: the tensor that is seen there is the one that
    // is found by going there, and hardly another than here.
    const auto f = e.h0().face();
    const auto c = surface.corners(f);
    SurfacePoint near{f, {0, 0, 0}};
    for (size_t i = 0; i < 3; ++i)
      near.barycentric[i] = c.vertex[i] == e.v0() || c.vertex[i] == e.v1() ? 0.4999 : 0.0002;
    const Vec3d here = domain->tensor(near);
    if (deviator_norm(here) < 0.2 * std::abs(here[0] + here[2])) continue;
    const auto g = e.h1().face();
    const double length =
        (position(surface, {g, {1.0 / 3, 1.0 / 3, 1.0 / 3}}) - position(surface, near)).norm();
    double best = 1e9;
    for (int k = 0; k < 16; ++k) {
      const double angle = 2 * 3.14159265358979 * k / 16;
      const Vec2d step(1e-3 * length * std::cos(angle), 1e-3 * length * std::sin(angle));
      if (domain->walk(near, step).point.face != g) continue;
      const Vec3d there = domain->tensor_ahead(near, step);
      best = std::min(best, std::acos(std::min(1.0, std::abs(max_direction(here) | max_direction(there)))));
    }
    if (best > 100) continue;
    const bool seam = is_seam(surface, e);
    worst[seam] = std::max(worst[seam], best);
    sum[seam] += best;
    ++count[seam];
  }
  REQUIRE(count[1] > 20);
  CHECK(sum[0] / count[0] < 1e-4);
  CHECK(sum[1] / count[1] < 2e-3);
  CHECK(worst[1] < 0.03);
}

TEST_CASE("umbilics in charts: as many as the topology asks for", "[charts]") {
  for (const std::string name : {"ellipsoid", "torus", "sphere"}) {
    INFO(name);
    auto mesh = prepared(name, 4000);
    const auto found = find_umbilics(mesh);
    CHECK(found.index_sum == (name == "torus" ? 0 : 2));
    CHECK(found.border_turning == Approx(found.index_sum).margin(1e-9));
    if (name == "ellipsoid") {
      CHECK(found.wedges == 4);
      CHECK(found.trisectors == 0);
    }
    if (name == "torus") CHECK(found.wedges + found.trisectors == 0);
  }
}

TEST_CASE("umbilics in charts add up where charts turn by more than a full turn at a vertex", "[charts]") {
  // A crown: around its first vertex the angles of the triangles add up to 7 half turns; each of them is a
  // chart.
  constexpr int teeth = 5;
  OpenMesh::TriMesh mesh;
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  const auto top = mesh.add_vertex({0, 0, 0}), bottom = mesh.add_vertex({0, 0, -6});
  std::vector<OpenMesh::VertexHandle> ring;
  for (int k = 0; k < 2 * teeth; ++k) {
    const double angle = 3.14159265358979 * k / teeth;
    ring.push_back(mesh.add_vertex({std::cos(angle), std::sin(angle), k % 2 == 0 ? 2.0 : -2.0}));
  }
  for (size_t k = 0; k < ring.size(); ++k) {
    const auto next = ring[(k + 1) % ring.size()];
    mesh.add_face(top, ring[k], next);
    mesh.add_face(bottom, next, ring[k]);
  }
  estimate_curvature(mesh);
  const auto chart = provide_property(mesh, property::chart);
  for (const auto f : mesh.faces()) mesh.property(chart, f) = f.idx();
  ChartOptions keep;
  keep.keep_charts = true;
  REQUIRE(cut_into_charts(mesh, keep).charts == mesh.n_faces());
  smooth_tensors(mesh);
  const auto charts = chart_field(mesh, surface_field(mesh, read_surface_tensors(mesh)));
  const auto bends = seam_bends(charts);
  std::vector<double> around(mesh.n_vertices(), 0), angles(mesh.n_vertices(), 0);
  for (int side = 0; side < static_cast<int>(bends.size()); ++side) {
    const auto v = static_cast<size_t>(charts.sides.vertex[static_cast<size_t>(side)]);
    around[v] += bends[static_cast<size_t>(side)];
    angles[v] += std::arg(-charts.along(previous_side(side)) / charts.along(side));
  }
  CHECK(angles[0] > 6 * 3.14159265358979);
  for (size_t v = 0; v < around.size(); ++v) CHECK(around[v] + angles[v] == Approx(2 * 3.14159265358979));
  const auto found = find_umbilics(mesh);
  CHECK(found.index_sum == 2);
  CHECK(found.border_turning == Approx(2));
}

TEST_CASE("lines do not end at seams", "[charts]") {
  auto mesh = prepared("torus", 6000);
  find_umbilics(mesh);
  TraceOptions options;
  options.density.epsilon_fraction = 0.002;
  const auto report = trace_lines(mesh, options);
  CHECK(report.ends[static_cast<int>(LineEnd::border)] == 0);
  CHECK(report.ends[static_cast<int>(LineEnd::feature)] == 0);
  CHECK(report.closed_lines > 10);
}

TEST_CASE("results in charts are sound", "[charts]") {
  for (const std::string name : {"ellipsoid", "torus", "sphere", "cube", "wave"}) {
    INFO(name);
    auto mesh = make_shape(name, {2500, true});
    RemeshOptions options;
    options.domain = anisomesh::Domain::charts;
    options.target_faces = 600;
    RemeshReport report;
    auto result = remesh(mesh, options, &report);
    CHECK(report.domain.used == anisomesh::Domain::charts);
    if (name != "cube") CHECK(report.target_met);  // its edges alone ask for more
    check_sound(compare(mesh, result));
    // afterwards the same mesh on the surface: nothing of the charts is in the way
    options.domain = anisomesh::Domain::surface;
    auto fresh = make_shape(name, {2500, true});
    const auto again = remesh(mesh, options), first = remesh(fresh, options);
    REQUIRE(again.n_vertices() == first.n_vertices());
    for (const auto v : first.vertices()) CHECK(again.point(v) == first.point(v));
  }
}
