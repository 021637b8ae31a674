// Eigen's vectors as points: this header wants the first one in front and the meshes behind it.
#include <OpenMesh/Core/Utils/vector_traits.hh>
//
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>
//
#include "anisomesh/remesh.hh"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <cmath>
#include <string>

#include "anisomesh/compare.hh"
#include "anisomesh/io.hh"
#include "anisomesh/properties.hh"
#include "anisomesh/shapes.hh"
#include "catch.hh"
#include "data.hh"
#include "sound_result.hh"

using namespace anisomesh;

namespace {

struct EigenTraits : OpenMesh::DefaultTraits {
  using Point = Eigen::Vector3d;
  using Normal = Eigen::Vector3d;
};
using FloatMesh = OpenMesh::TriMesh_ArrayKernelT<>;
using DoubleMesh = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;
using EigenMesh = OpenMesh::TriMesh_ArrayKernelT<EigenTraits>;

/// A copy of the mesh of another type, its points rounded to what a float holds (by hand: GCC 12's vectorizer
/// loses a cast to float and back).
template <class Mesh>
Mesh rounded_copy(const OpenMesh::TriMesh& mesh, double scale = 1) {
  Mesh copy;
  for (const auto v : mesh.vertices()) {
    typename Mesh::Point p;
    for (int i = 0; i < 3; ++i)
      p[i] =
          static_cast<std::decay_t<decltype(p[0])>>(scale * std::round(mesh.point(v)[i] * 0x1p20) * 0x1p-20);
    copy.add_vertex(p);
  }
  for (const auto f : mesh.faces()) {
    std::vector<OpenMesh::VertexHandle> corners;
    for (const auto v : f.vertices()) corners.push_back(v);
    copy.add_face(corners);
  }
  return copy;
}

std::vector<std::vector<int>> faces_of(const OpenMesh::PolyMesh& mesh) {
  std::vector<std::vector<int>> faces;
  for (const auto f : mesh.faces()) {
    faces.emplace_back();
    for (const auto v : f.vertices()) faces.back().push_back(v.idx());
  }
  return faces;
}

/// The same faces, and no vertex farther from its like than `tolerance` of the diagonal.
void check_same(const OpenMesh::PolyMesh& a, const OpenMesh::PolyMesh& b, double scale, double tolerance) {
  REQUIRE(a.n_vertices() == b.n_vertices());
  CHECK(faces_of(a) == faces_of(b));
  double worst = 0, size = 0;
  for (const auto v : a.vertices()) {
    worst = std::max(worst, (scale * a.point(v) - b.point(v)).norm());
    size = std::max(size, (scale * a.point(v)).norm());
  }
  CHECK(worst <= tolerance * size);
}

}  // namespace

TEMPLATE_TEST_CASE("a mesh of any traits gives the same polygons", "[remesh]", FloatMesh, DoubleMesh,
                   EigenMesh) {
  const auto shape = make_shape("saddle", {1500, true});
  auto reference = rounded_copy<OpenMesh::TriMesh>(shape);
  auto mesh = rounded_copy<TestType>(shape);
  check_same(remesh(reference), remesh(mesh), 1, 0);
}

TEST_CASE("the result scales with the input", "[remesh]") {
  const auto shape = make_shape("dome", {1200, true});
  auto mesh = rounded_copy<OpenMesh::TriMesh>(shape);
  const auto result = remesh(mesh);
  for (const double scale : {std::ldexp(1.0, -20), std::ldexp(1.0, 20)}) {
    auto scaled = rounded_copy<OpenMesh::TriMesh>(shape, scale);
    check_same(result, remesh(scaled), scale, 1e-9);
  }
}

TEST_CASE("a second run over the same mesh finds the same", "[remesh]") {
  auto mesh = make_shape("octa-flower", {1500});
  const auto first = remesh(mesh);
  check_same(first, remesh(mesh), 1, 0);
}

TEST_CASE("epsilon rules where no target is given", "[remesh]") {
  auto mesh = make_shape("wave", {1500});
  RemeshOptions options;
  options.fit.enabled = false;
  options.trace.density.epsilon_fraction = 0.002;
  RemeshReport report;
  const auto coarse = remesh(mesh, options, &report);
  CHECK(report.epsilon_fraction == 0.002);
  CHECK(report.attempts == 1);
  CHECK(report.target_met);
  CHECK(report.mesh.faces == coarse.n_faces());
  options.trace.density.epsilon_fraction = 0.0005;
  CHECK(remesh(mesh, options).n_faces() > 2 * coarse.n_faces());
}

TEST_CASE("99 percent of the samples lie within two epsilons", "[remesh]") {
  for (const std::string name : {"half-torus", "ellipsoid-cap", "wave", "saddle", "dome", "cylinder"})
    for (const double epsilon : {0.001, 0.002, 0.004}) {
      const bool irregular = epsilon == 0.002;
      auto mesh = make_shape(name, {5000, irregular});
      RemeshOptions options;
      options.trace.density.epsilon_fraction = epsilon;
      auto result = remesh(mesh, options);
      INFO(name << " at " << epsilon);
      CHECK(compare(mesh, result, {20000}).p99_fraction <= 2 * epsilon);
    }
}

TEST_CASE("a cell tolerance that is given rules over the one recorded", "[remesh]") {
  auto mesh = make_shape("half-torus", {3000});
  RemeshOptions options;
  options.fit.enabled = false;
  options.trace.density.epsilon_fraction = 0.002;
  const auto recorded = remesh(mesh, options);
  CHECK(mesh.property(require_property(mesh, property::cell_tolerance)) == 2);
  MeshOptions given;
  check_same(recorded, build_polygons(mesh, given), 1, 0);
  given.cell_tolerance = 2;
  check_same(recorded, build_polygons(mesh, given), 1, 0);
  given.cell_tolerance = 4;
  CHECK(build_polygons(mesh, given).n_vertices() < recorded.n_vertices());
}

TEST_CASE("a target of faces or vertices is met within ten percent", "[remesh]") {
  for (const char* name :
       {"dome", "saddle", "octa-flower", "half-torus", "ellipsoid-cap", "monkey-saddle", "wave"}) {
    auto mesh = make_shape(name, {3000, true});
    for (const size_t target : {size_t{200}, size_t{1500}}) {
      RemeshOptions options;
      RemeshReport report;
      options.target_faces = target;
      const double faces = static_cast<double>(remesh(mesh, options, &report).n_faces());
      INFO(name << ": " << faces << " of " << target << " faces, attempts: " << report.attempts);
      CHECK(std::abs(faces / static_cast<double>(target) - 1) <= 0.1);
      CHECK(report.target_met);
      CHECK(report.attempts <= 4);
    }
    RemeshOptions options;
    options.target_vertices = 600;
    const double vertices = static_cast<double>(remesh(mesh, options).n_vertices());
    INFO(name);
    CHECK(vertices == Approx(600).epsilon(0.1));
  }
}

TEST_CASE("with the fit a number of vertices is met exactly, faces nearly", "[remesh]") {
  for (const char* name : {"saddle", "half-torus", "wave"}) {
    auto mesh = make_shape(name, {5000, true});
    INFO(name);
    RemeshOptions options;
    options.target_vertices = 500;
    CHECK(remesh(mesh, options).n_vertices() == 500);
    CHECK(mesh.property(require_property(mesh, property::target_vertices)) == 500);
    options.fit.enabled = false;
    remesh(mesh, options);
    CHECK(mesh.property(require_property(mesh, property::target_vertices)) == 0);
    options.fit.enabled = true;
    options.target_vertices = 0;
    options.target_faces = 500;
    INFO("faces");
    CHECK(static_cast<double>(remesh(mesh, options).n_faces()) == Approx(500).epsilon(0.03));
    options.target_faces = 0;
    options.trace.density.epsilon_fraction = 0.002;
    remesh(mesh, options);
    CHECK(mesh.property(require_property(mesh, property::target_vertices)) == 0);
  }
}

TEST_CASE("what the mesh keeps after a search is what the result was made of", "[remesh]") {
  auto mesh = make_shape("dome", {1500, true});
  RemeshOptions options;
  options.target_faces = 400;
  options.fit.enabled = false;
  options.tolerance = 1e-6;  // never met: the best of several attempts is taken, not the last
  options.max_attempts = 2;
  RemeshReport report;
  const auto result = remesh(mesh, options, &report);
  CHECK(report.attempts == 2);
  CHECK(report.mesh.faces == result.n_faces());
  check_same(result, build_polygons(mesh), 1, 0);
}

TEST_CASE("the real discs meet a target", "[remesh][data]") {
  for (const auto& name : demo_discs()) {
    const auto path = demo_mesh(name);
    if (!path) return skip(name);
    auto mesh = read_surface(*path);
    RemeshOptions options;
    options.target_faces = 1000;
    const double faces = static_cast<double>(remesh(mesh, options).n_faces());
    INFO(name);
    CHECK(faces == Approx(1000).epsilon(0.1));
  }
}

TEST_CASE("a few polygons keep the limbs of a figure", "[remesh][data]") {
  const auto path = demo_mesh("man.off");
  if (!path) return skip("man.off");
  auto mesh = read_surface(*path);
  RemeshOptions options;
  options.target_faces = 200;
  const auto rms = [&] {
    auto result = remesh(mesh, options);
    const auto compared = compare(mesh, result);
    check_sound(compared);
    return compared.two_sided.rms;
  };
  options.coarsen = false;
  const double of_few_lines = rms();
  options.coarsen = true;
  CHECK(rms() < 0.5 * of_few_lines);
}

TEST_CASE("progress only grows, and stopping at any point leaves a mesh to go on with", "[remesh]") {
  auto mesh = make_shape("saddle", {1500, true});
  std::vector<double> seen;
  RemeshOptions options;
  options.target_faces = 300;
  const auto whole = remesh(mesh, options, nullptr, [&](double fraction) {
    seen.push_back(fraction);
    return true;
  });
  REQUIRE(seen.size() > 10);
  CHECK(std::is_sorted(seen.begin(), seen.end()));
  CHECK(seen.front() >= 0);
  CHECK(seen.back() == 1);
  for (const double stop : {0.0, 0.05, 0.2, 0.35, 0.5, 0.7, 0.9}) {
    auto fresh = make_shape("saddle", {1500, true});
    INFO(stop);
    CHECK_THROWS_AS(remesh(fresh, options, nullptr, [&](double fraction) { return fraction < stop; }),
                    Cancelled);
    if (stop > 0.1) check_same(whole, remesh(fresh, options), 1, 0);
  }
}

TEST_CASE("options out of range are refused before any work", "[remesh]") {
  auto mesh = make_shape("dome", {200});
  const auto refused = [&](const RemeshOptions& options) {
    CHECK_THROWS_AS(remesh(mesh, options), InvalidOption);
    CHECK_FALSE(has_property(mesh, property::tensor));
  };
  RemeshOptions options;
  options.target_faces = options.target_vertices = 100;
  refused(options);
  options = {};
  options.tolerance = 0;
  refused(options);
  options = {};
  options.trace.density.epsilon_fraction = -1;
  refused(options);
  options = {};
  options.mesh.max_degree = 2;
  refused(options);
}

TEST_CASE("relaxed lines make sound meshes, beside features and in either domain", "[remesh]") {
  auto mesh = make_shape("octa-flower", {8000, true});
  RemeshOptions options;
  options.domain = GENERATE(Domain::plane, Domain::surface);
  options.trace.relax_passes = 2;
  auto result = remesh(mesh, options);
  check_sound(compare(mesh, result));
}

TEST_CASE("a surface without area is refused before lines are drawn on it", "[remesh]") {
  auto mesh = make_shape("sphere", {300, true});
  for (const auto v : mesh.vertices()) mesh.set_point(v, {mesh.point(v)[2], 0, 0});
  CHECK_THROWS_WITH(remesh(mesh), Catch::Contains("no face of the surface has an area"));
}
