#include "anisomesh/curvature.hh"

#include <tbb/global_control.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "anisomesh/io.hh"
#include "anisomesh/properties.hh"
#include "catch.hh"
#include "curvature_error.hh"
#include "data.hh"

using namespace anisomesh;

namespace {

constexpr CurvatureEstimator estimators[] = {CurvatureEstimator::normal_cycle,
                                             CurvatureEstimator::corrected_normal_current};

/// All results of a run, vertex by vertex.
struct Field {
  std::vector<Vec3d> normal, gamma_min, gamma_max;
  std::vector<Vec6d> tensor;
  std::vector<double> k_min, k_max;
};

template <class Mesh>
Field read_field(const Mesh& mesh) {
  Field field;
  const auto read = [&](auto& values, const auto& declaration) {
    const auto handle = require_property(mesh, declaration);
    for (size_t i = 0; i < mesh.n_vertices(); ++i)
      values.push_back(mesh.property(handle, OpenMesh::VertexHandle(static_cast<int>(i))));
  };
  read(field.normal, property::normal);
  read(field.gamma_min, property::gamma_min);
  read(field.gamma_max, property::gamma_max);
  read(field.tensor, property::tensor);
  read(field.k_min, property::k_min);
  read(field.k_max, property::k_max);
  return field;
}

template <class Mesh>
Field estimate(Mesh& mesh, const CurvatureOptions& options = {}) {
  estimate_curvature(mesh, options);
  return read_field(mesh);
}

/// Whether all is finite, the frame orthonormal, and the tensor what the principal data say.
bool sound(const Field& field) {
  for (size_t i = 0; i < field.normal.size(); ++i) {
    const Vec3d &n = field.normal[i], &a = field.gamma_min[i], &b = field.gamma_max[i];
    const double k = std::max(std::abs(field.k_min[i]), std::abs(field.k_max[i]));
    if (!std::isfinite(k) || !(field.k_min[i] <= field.k_max[i])) return false;
    if (!((((a % b) | n)) * (((a % b) | n)) > 1 - 1e-9)) return false;  // of unit vectors only if orthonormal
    if (std::abs(a.norm() - 1) + std::abs(b.norm() - 1) + std::abs(n.norm() - 1) > 1e-9) return false;
    const double xx = field.k_min[i] * a[0] * a[0] + field.k_max[i] * b[0] * b[0];
    const double yz = field.k_min[i] * a[1] * a[2] + field.k_max[i] * b[1] * b[2];
    if (std::abs(field.tensor[i][0] - xx) + std::abs(field.tensor[i][4] - yz) > 1e-9 * k) return false;
  }
  return true;
}

Vec3d transformed(const Vec3d (&rows)[3], const Vec3d& a) { return {rows[0] | a, rows[1] | a, rows[2] | a}; }

/// Q T Q^T, column by column.
Vec6d transformed(const Vec3d (&rows)[3], const Vec6d& t) {
  const Vec3d columns[3] = {{t[0], t[1], t[2]}, {t[1], t[3], t[4]}, {t[2], t[4], t[5]}};
  const auto entry = [&](int i, int j) {
    return rows[i] | Vec3d(columns[0] | rows[j], columns[1] | rows[j], columns[2] | rows[j]);
  };
  return {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
}

/// The largest difference of two tensor fields over the largest norm of the first.
double difference(const std::vector<Vec6d>& a, const std::vector<Vec6d>& b) {
  double largest = 0, norm = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, (a[i] - b[i]).norm());
    norm = std::max(norm, a[i].norm());
  }
  return largest / norm;
}

}  // namespace

TEST_CASE("both estimators stay within the bars on closed forms, regular or not", "[curvature]") {
  const auto estimator =
      GENERATE(CurvatureEstimator::normal_cycle, CurvatureEstimator::corrected_normal_current);
  const bool irregular = GENERATE(false, true);
  CurvatureOptions options;
  options.estimator = estimator;
  for (const auto& form : shapes::curved()) {
    INFO(form.name << (irregular ? ", irregular" : "") << ", estimator " << static_cast<int>(estimator));
    auto sampled = shapes::sample(form, 20000, irregular);
    estimate_curvature(sampled.mesh, options);
    const auto e = shapes::curvature_error(sampled);
    CHECK(e.direction_degrees <= 2);
    CHECK(e.curvature <= 0.05);
    CHECK(e.border_direction_degrees <= 3);
    CHECK(e.border_curvature <= 0.05);
  }
}

TEST_CASE("the corrected normal current converges with order 2 on regular meshes", "[curvature]") {
  for (const auto& form : shapes::curved()) {
    INFO(form.name);
    double error[2];
    for (const int level : {0, 1}) {
      auto sampled = shapes::sample(form, level == 0 ? 1250 : 5000);
      estimate_curvature(sampled.mesh);
      error[level] = shapes::curvature_error(sampled).curvature;
    }
    CHECK(error[1] < 0.3 * error[0]);
  }
}

TEST_CASE("a sphere of radius r has curvature 1/r everywhere, turned inside out -1/r", "[curvature]") {
  auto sampled = shapes::sample(shapes::sphere(2), 3000, true);
  OpenMesh::TriMesh reversed;
  for (const auto v : sampled.mesh.vertices()) reversed.add_vertex(sampled.mesh.point(v));
  for (const auto f : sampled.mesh.faces()) {
    const auto h = f.halfedge();
    reversed.add_face(h.to(), h.from(), h.next().to());
  }
  const auto field = estimate(sampled.mesh), other = estimate(reversed);
  for (size_t i = 0; i < field.k_min.size(); ++i) {
    CHECK(field.k_min[i] == Approx(0.5).epsilon(0.03));
    CHECK(field.k_max[i] == Approx(0.5).epsilon(0.03));
    CHECK(other.k_min[i] == Approx(-field.k_max[i]));
    CHECK(other.k_max[i] == Approx(-field.k_min[i]));
  }
}

TEST_CASE("a cylinder of radius r has k = (0, 1/r), gamma_min along the axis", "[curvature]") {
  const auto estimator =
      GENERATE(CurvatureEstimator::normal_cycle, CurvatureEstimator::corrected_normal_current);
  auto sampled = shapes::sample(shapes::cylinder(0.5), 5000);
  CurvatureOptions options;
  options.estimator = estimator;
  const auto field = estimate(sampled.mesh, options);
  for (size_t i = 0; i < field.k_min.size(); ++i) {
    CHECK(field.k_min[i] == Approx(0).margin(0.01));
    CHECK(field.k_max[i] == Approx(2).epsilon(0.15));
    CHECK(std::abs(field.gamma_min[i][2]) > 0.9999);
  }
}

TEST_CASE("a plane has no curvature and still a sound frame", "[curvature]") {
  for (const auto estimator : estimators)
    for (const bool irregular : {false, true}) {
      auto sampled = shapes::sample(shapes::plane(), 2000, irregular);
      CurvatureOptions options;
      options.estimator = estimator;
      const auto field = estimate(sampled.mesh, options);
      CHECK(sound(field));
      for (size_t i = 0; i < field.k_min.size(); ++i)
        CHECK(std::max(std::abs(field.k_min[i]), std::abs(field.k_max[i])) < 1e-12);
    }
}

TEST_CASE("the tensors follow the surface through motions, scales and mirrors", "[curvature]") {
  const auto estimator =
      GENERATE(CurvatureEstimator::normal_cycle, CurvatureEstimator::corrected_normal_current);
  CurvatureOptions options;
  options.estimator = estimator;
  const auto sampled = shapes::sample(shapes::torus(), 2000, true, 0.0005);
  auto original = sampled.mesh;
  const auto before = estimate(original, options);
  const double c = std::cos(0.7), s = std::sin(0.7);
  const Vec3d turn[3] = {{c, -s * 0.6, s * 0.8}, {s, c * 0.6, -c * 0.8}, {0, 0.8, 0.6}};
  const Vec3d mirror[3] = {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

  SECTION("a motion") {
    auto moved = sampled.mesh;
    for (const auto v : moved.vertices())
      moved.set_point(v, transformed(turn, moved.point(v)) + Vec3d(3, -2, 1));
    auto expected = before.tensor;
    for (auto& t : expected) t = transformed(turn, t);
    CHECK(difference(expected, estimate(moved, options).tensor) < 1e-8);
  }
  SECTION("a scale") {
    for (const double scale : {1e-6, 1e6}) {
      auto scaled = sampled.mesh;
      for (const auto v : scaled.vertices()) scaled.set_point(v, scale * scaled.point(v));
      auto expected = before.tensor;
      for (auto& t : expected) t /= scale;
      CHECK(difference(expected, estimate(scaled, options).tensor) < 1e-8);
    }
  }
  SECTION("a mirror, the normals kept outward") {
    OpenMesh::TriMesh mirrored;
    for (const auto v : original.vertices()) mirrored.add_vertex(transformed(mirror, original.point(v)));
    for (const auto f : original.faces()) {
      const auto h = f.halfedge();
      mirrored.add_face(h.to(), h.from(), h.next().to());
    }
    auto expected = before.tensor;
    for (auto& t : expected) t = transformed(mirror, t);
    CHECK(difference(expected, estimate(mirrored, options).tensor) < 1e-8);
  }
  SECTION("other numbers for vertices and faces") {
    OpenMesh::TriMesh renumbered;
    const int n = static_cast<int>(original.n_vertices());
    const auto other = [&](int i) { return OpenMesh::VertexHandle(n - 1 - i); };
    for (int i = 0; i < n; ++i) renumbered.add_vertex(original.point(other(i)));
    for (int i = static_cast<int>(original.n_faces()) - 1; i >= 0; --i) {
      const auto h = original.halfedge_handle(OpenMesh::FaceHandle(i));
      const auto g = original.next_halfedge_handle(h);
      renumbered.add_face(other(original.to_vertex_handle(h).idx()),
                          other(original.to_vertex_handle(g).idx()),
                          other(original.from_vertex_handle(h).idx()));
    }
    auto expected = before.tensor;
    std::reverse(expected.begin(), expected.end());
    CHECK(difference(expected, estimate(renumbered, options).tensor) < 1e-8);
  }
}

TEST_CASE("a petal of the octa-flower is estimated as if the others were not there", "[curvature]") {
  const auto estimator =
      GENERATE(CurvatureEstimator::normal_cycle, CurvatureEstimator::corrected_normal_current);
  ShapeOptions shape;
  shape.vertices = 3000;
  auto flower = make_shape("octa-flower", shape);
  CurvatureOptions options;
  options.estimator = estimator;
  const auto whole = estimate(flower, options);
  CHECK(sound(whole));

  // Cut the petal between 0 and 45 degrees out.
  OpenMesh::TriMesh petal;
  std::map<int, OpenMesh::VertexHandle> copy;
  for (const auto f : flower.faces()) {
    Vec3d centre(0, 0, 0);
    for (const auto v : f.vertices()) centre += flower.point(v) / 3;
    const double angle = std::atan2(centre[1], centre[0]);
    if (angle < 0 || angle > shapes::pi / 4) continue;
    const auto h = f.halfedge();
    OpenMesh::VertexHandle corner[3];
    int i = 0;
    for (const auto v : {h.to(), h.next().to(), h.from()}) {
      auto [entry, added] = copy.try_emplace(v.idx());
      if (added) entry->second = petal.add_vertex(flower.point(v));
      corner[i++] = entry->second;
    }
    petal.add_face(corner[0], corner[1], corner[2]);
  }
  const double ratio = SurfaceRef(flower).extent() / SurfaceRef(petal).extent();
  options.radius_fraction *= ratio;
  const auto alone = estimate(petal, options);
  std::vector<Vec6d> expected, found;
  for (const auto& [v, own] : copy) {
    const auto edges = flower.ve_range(OpenMesh::VertexHandle(v));
    if (std::any_of(edges.begin(), edges.end(), [&](auto e) { return flower.status(e).feature(); })) continue;
    expected.push_back(alone.tensor[static_cast<size_t>(own.idx())]);
    found.push_back(whole.tensor[static_cast<size_t>(v)]);
  }
  REQUIRE(found.size() > 300);
  CHECK(difference(expected, found) < 1e-10);
}

TEST_CASE("a fold between two planes is curved only while it is not tagged", "[curvature]") {
  const auto estimator =
      GENERATE(CurvatureEstimator::normal_cycle, CurvatureEstimator::corrected_normal_current);
  CurvatureOptions options;
  options.estimator = estimator;
  ShapeOptions shape;
  shape.vertices = 900;
  auto mesh = make_shape("plane", shape);
  double crease = 1;  // fold the square along the first column of its grid past the middle
  for (const auto v : mesh.vertices())
    if (mesh.point(v)[0] > 1e-9) crease = std::min(crease, mesh.point(v)[0]);
  for (const auto v : mesh.vertices()) {
    const auto p = mesh.point(v);
    const double past = std::max(0.0, p[0] - crease);
    mesh.set_point(v, Vec3d(p[0] - 0.4 * past, p[1], -0.8 * past));
  }
  const auto strongest = [](const Field& field) {
    return *std::max_element(field.k_max.begin(), field.k_max.end());
  };
  CHECK(strongest(estimate(mesh, options)) > 1);
  for (const auto e : mesh.edges()) {
    if (e.is_boundary()) continue;
    const auto h = e.h0();
    mesh.status(e).set_feature(mesh.calc_dihedral_angle(h) * mesh.calc_dihedral_angle(h) > 0.01);
  }
  const auto field = estimate(mesh, options);
  CHECK(sound(field));
  CHECK(strongest(field) < 1e-9);
}

TEST_CASE("faces without area are left out and counted, isolated vertices tolerated", "[curvature]") {
  for (const auto estimator : estimators) {
    auto sampled = shapes::sample(shapes::cylinder(), 2000);
    auto& mesh = sampled.mesh;
    // Put a vertex of the interior on its neighbour: the two faces on their edge lose their area.
    auto v = OpenMesh::VertexHandle(static_cast<int>(mesh.n_vertices()) / 2);
    while (mesh.is_boundary(v)) v = OpenMesh::VertexHandle(v.idx() + 1);
    mesh.set_point(v, mesh.point(*mesh.cvv_iter(v)));
    mesh.add_vertex({0, 0, 5});
    CurvatureOptions options;
    options.estimator = estimator;
    CHECK(estimate_curvature(mesh, options).degenerate_faces == 2);
    const auto field = read_field(mesh);
    CHECK(sound(field));
    double worst = 0;
    for (size_t i = 0; i + 1 < field.k_max.size(); ++i) worst = std::max(worst, field.k_max[i]);
    CHECK(worst < 3);
  }
}

TEST_CASE("meshes without any area still get a sound frame", "[curvature]") {
  OpenMesh::TriMesh mesh;
  const auto a = mesh.add_vertex({0, 0, 0}), b = mesh.add_vertex({1, 0, 0}), c = mesh.add_vertex({3, 0, 0});
  mesh.add_face(a, b, c);
  CHECK(estimate_curvature(mesh).degenerate_faces == 1);
  CHECK(sound(read_field(mesh)));
}

TEST_CASE("a ball does not reach across to a sheet that only passes near", "[curvature]") {
  // Two parallel planes far closer than the radius, joined nowhere, orientation opposite, one curved.
  auto sampled = shapes::sample(shapes::plane(), 900);
  auto& mesh = sampled.mesh;
  const int n = static_cast<int>(mesh.n_vertices());
  for (int i = 0; i < n; ++i) {
    const auto p = mesh.point(OpenMesh::VertexHandle(i));
    mesh.add_vertex({p[0], p[1], -0.01 - 0.1 * p[0] * p[0]});
  }
  std::vector<std::array<OpenMesh::VertexHandle, 3>> faces;
  for (const auto f : mesh.faces())
    faces.push_back({f.halfedge().from(), f.halfedge().to(), f.halfedge().next().to()});
  for (const auto& f : faces)
    mesh.add_face(OpenMesh::VertexHandle(f[1].idx() + n), OpenMesh::VertexHandle(f[0].idx() + n),
                  OpenMesh::VertexHandle(f[2].idx() + n));
  CurvatureOptions options;
  options.radius_fraction = 0.05;
  const auto field = estimate(mesh, options);
  for (int i = 0; i < n; ++i) CHECK(std::abs(field.k_max[static_cast<size_t>(i)]) < 1e-12);
}

TEST_CASE("balls much larger than faces are averaged over a covering without loss", "[curvature]") {
  for (const auto estimator : estimators) {
    auto sampled = shapes::sample(shapes::torus(), 40000, true);
    CurvatureOptions options;
    options.estimator = estimator;
    options.radius_fraction = 0.03;
    estimate_curvature(sampled.mesh, options);
    const auto e = shapes::curvature_error(sampled);
    CHECK(e.direction_degrees < 0.5);
    CHECK(e.curvature < 0.02);
  }
}

TEST_CASE("the result is the same to the last bit for any number of threads", "[curvature]") {
  const auto sampled = shapes::sample(shapes::ellipsoid(), 20000, true, 0.0002);
  CurvatureOptions options;
  options.radius_fraction = 0.02;
  const auto with_threads = [&](size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    auto mesh = sampled.mesh;
    return estimate(mesh, options).tensor;
  };
  const auto one = with_threads(1);
  CHECK(one == with_threads(3));
}

TEST_CASE("a cancelled estimate leaves the mesh as it was", "[curvature]") {
  auto sampled = shapes::sample(shapes::saddle(), 20000);
  double last = 0;
  CHECK_THROWS_AS(estimate_curvature(sampled.mesh, {},
                                     [&](double fraction) {
                                       CHECK(fraction >= last);
                                       last = fraction;
                                       return fraction < 0.4;
                                     }),
                  Cancelled);
  CHECK_FALSE(has_property(sampled.mesh, property::tensor));
  CHECK_FALSE(has_property(sampled.mesh, property::normal));
  CHECK(last >= 0.4);
}

TEST_CASE("an automatic radius finds curvature under noise, and leaves clean surfaces and scans alone",
          "[curvature]") {
  CurvatureOptions automatic;
  automatic.radius_fraction = 0;
  for (const auto& form : shapes::curved()) {
    INFO(form.name);
    auto noisy = shapes::sample(form, 20000, true, 0.001);
    const auto report = estimate_curvature(noisy.mesh, automatic);
    CHECK(report.normal_fraction > 0);
    const auto e = shapes::curvature_error(noisy);
    CHECK(e.direction_degrees < 5);
    CHECK(e.curvature < 0.08);
    CHECK(e.border_curvature < 0.2);  // in balls of 1 % all of them are some ten times as large

    auto clean = shapes::sample(form, 5000, true), same = clean;
    const auto untouched = estimate_curvature(clean.mesh, automatic);
    estimate_curvature(same.mesh);
    CHECK(untouched.normal_fraction == 0);
    CHECK(read_field(clean.mesh).tensor == read_field(same.mesh).tensor);
  }
  for (const char* name : {"lion-head.off", "mannequin-devil.off"})
    if (const auto path = demo_mesh(name)) {
      auto mesh = read_surface(*path);
      CHECK(estimate_curvature(mesh, automatic).normal_fraction == 0);
    }
}

TEST_CASE("the choice by noise does not change with scale", "[curvature]") {
  auto mesh = shapes::sample(shapes::torus(), 5000, true, 0.001).mesh, large = mesh;
  for (const auto v : large.vertices()) large.set_point(v, 0x1p20 * large.point(v));
  CurvatureOptions automatic;
  automatic.radius_fraction = 0;
  const auto here = estimate_curvature(mesh, automatic), there = estimate_curvature(large, automatic);
  CHECK(here.noise == Approx(there.noise));
  CHECK(here.radius * 0x1p20 == Approx(there.radius));
}

TEST_CASE("a radius that is none is refused", "[curvature]") {
  auto sampled = shapes::sample(shapes::saddle(), 100);
  for (const double radius : {-0.01, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    CurvatureOptions options;
    options.radius_fraction = radius;
    CHECK_THROWS_AS(estimate_curvature(sampled.mesh, options), InvalidOption);
  }
}

TEST_CASE("a float mesh gets the curvatures of its double twin", "[curvature]") {
  auto sampled = shapes::sample(shapes::torus(), 2000);
  OpenMesh::TriMesh_ArrayKernelT<> single;
  for (const auto v : sampled.mesh.vertices()) single.add_vertex(OpenMesh::Vec3f(sampled.mesh.point(v)));
  for (const auto f : sampled.mesh.faces()) {
    const auto h = f.halfedge();
    single.add_face(OpenMesh::VertexHandle(h.from()), h.to(), h.next().to());
  }
  CHECK(difference(estimate(sampled.mesh).tensor, estimate(single).tensor) < 1e-3);
}

TEST_CASE("real scans give a sound field", "[curvature][data]") {
  for (const auto& name : demo_discs()) {
    const auto path = demo_mesh(name);
    if (!path) return skip(name);
    auto mesh = read_surface(*path);
    for (const auto estimator : estimators) {
      INFO(name);
      CurvatureOptions options;
      options.estimator = estimator;
      CHECK(sound(estimate(mesh, options)));
    }
  }
}
