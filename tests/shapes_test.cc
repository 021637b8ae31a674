#include "anisomesh/shapes.hh"

#include <cmath>

#include "anisomesh/features.hh"
#include "catch.hh"

using namespace anisomesh;

namespace {

size_t border_loops(const OpenMesh::TriMesh& mesh) {
  std::vector<char> seen(mesh.n_halfedges(), 0);
  size_t loops = 0;
  for (const auto h : mesh.halfedges()) {
    if (!h.is_boundary() || seen[static_cast<size_t>(h.idx())]) continue;
    ++loops;
    for (auto g = h; !seen[static_cast<size_t>(g.idx())]; g = g.next())
      seen[static_cast<size_t>(g.idx())] = 1;
  }
  return loops;
}

}  // namespace

TEST_CASE("every shape is one disc of about the wanted size", "[shapes]") {
  const bool irregular = GENERATE(false, true);
  const int vertices = GENERATE(9, 100, 3000);
  for (const auto& name : disc_shape_names()) {
    INFO(name << (irregular ? ", irregular" : "") << ", " << vertices << " vertices");
    ShapeOptions options;
    options.vertices = vertices;
    options.irregular = irregular;
    const auto mesh = make_shape(name, options);
    const auto count = [](size_t n) { return static_cast<int>(n); };
    CHECK(count(mesh.n_vertices()) - count(mesh.n_edges()) + count(mesh.n_faces()) == 1);
    CHECK(border_loops(mesh) == 1);
    if (vertices >= 100)
      CHECK(static_cast<double>(mesh.n_vertices()) ==
            Approx(vertices).epsilon(vertices > 1000 ? 0.05 : 0.25));
    for (const auto v : mesh.vertices()) CHECK(v.valence() >= 2);
  }
}

TEST_CASE("every closed shape is one closed surface, oriented outward, on its formula", "[shapes]") {
  const bool irregular = GENERATE(false, true);
  const int vertices = GENERATE(9, 100, 3000);
  for (const auto& name : closed_shape_names()) {
    INFO(name << (irregular ? ", irregular" : "") << ", " << vertices << " vertices");
    ShapeOptions options;
    options.vertices = vertices;
    options.irregular = irregular;
    const auto mesh = make_shape(name, options);
    const auto count = [](size_t n) { return static_cast<int>(n); };
    CHECK(count(mesh.n_vertices()) - count(mesh.n_edges()) + count(mesh.n_faces()) ==
          (name == "torus" ? 0 : 2));
    CHECK(border_loops(mesh) == 0);
    if (vertices >= 100)
      CHECK(static_cast<double>(mesh.n_vertices()) ==
            Approx(vertices).epsilon(vertices > 1000 ? 0.05 : 0.25));
    double volume = 0, off = 0;
    for (const auto f : mesh.faces()) {
      std::vector<Vec3d> p;
      for (const auto v : f.vertices()) p.push_back(mesh.point(v));
      volume += (p[0] | (p[1] % p[2])) / 6;
    }
    for (const auto v : mesh.vertices()) {
      const auto p = mesh.point(v);
      const Vec3d axes = name == "ellipsoid" ? Vec3d(1, 0.6, 0.35) : Vec3d(1, 1, 1);
      off = std::max(off, std::abs(name == "cube"    ? p.max_abs() - 1
                                   : name == "torus" ? std::hypot(std::hypot(p[0], p[1]) - 1, p[2]) - 0.4
                                                     : (p / axes).norm() - 1));
    }
    CHECK(off < 1e-12);
    const double pi = std::acos(-1.0);
    const double exact = name == "cube"        ? 8
                         : name == "torus"     ? 2 * pi * pi * 0.16
                         : name == "ellipsoid" ? 4 * pi / 3 * 0.6 * 0.35
                                               : 4 * pi / 3;
    if (vertices >= 3000) CHECK(volume == Approx(exact).epsilon(0.01));
    CHECK(volume > 0);
    size_t creases = 0;
    for (const auto e : mesh.edges()) creases += mesh.status(e).feature();
    CHECK((creases > 0) == (name == "cube"));
  }
}

TEST_CASE("the same options give the same shape, another seed another one", "[shapes]") {
  ShapeOptions options;
  options.vertices = 400;
  options.irregular = true;
  options.noise = 0.001;
  const auto points = [&] {
    auto mesh = make_shape("wave", options);
    return SurfaceRef(mesh).points();
  };
  const auto first = points();
  CHECK(first == points());
  options.seed = 2;
  CHECK(first != points());
}

TEST_CASE("noise has the standard deviation asked for", "[shapes]") {
  ShapeOptions options;
  options.vertices = 5000;
  options.noise = 0.01;
  auto mesh = make_shape("plane", options);
  double sum = 0;
  for (const auto v : mesh.vertices()) sum += mesh.point(v)[2] * mesh.point(v)[2];
  CHECK(std::sqrt(sum / static_cast<double>(mesh.n_vertices())) == Approx(0.01 * std::sqrt(8)).epsilon(0.05));
}

TEST_CASE("the octa-flower has eight creases that meet at the centre", "[shapes]") {
  for (const bool irregular : {false, true}) {
    ShapeOptions options;
    options.irregular = irregular;
    auto mesh = make_shape("octa-flower", options);
    const auto skeleton = feature_skeleton(mesh);
    size_t creases = 0;
    for (const auto& curve : skeleton.curves) creases += !curve.border;
    CHECK(creases == 8);
    CHECK(skeleton.curves.size() == 16);
    CHECK(skeleton.corners.size() == 9);
  }
}

TEST_CASE("shape options outside their range are refused", "[shapes]") {
  ShapeOptions options;
  CHECK_THROWS_WITH(make_shape("teapot"), Catch::Contains("half-torus"));
  options.vertices = 3;
  CHECK_THROWS_AS(make_shape("plane", options), InvalidOption);
  options.vertices = 100;
  options.noise = -1;
  CHECK_THROWS_AS(make_shape("plane", options), InvalidOption);
}
