#include "anisomesh/mesher.hh"

#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "anisomesh/errors.hh"
#include "anisomesh/lines.hh"
#include "anisomesh/properties.hh"
#include "catch.hh"
#include "mesher/line_directions.hh"
#include "network/uv_locator.hh"

using namespace anisomesh;

namespace {

constexpr double pi = 3.14159265358979323846;
using Mesh = OpenMesh::TriMesh;
using Map = std::function<Vec3d(const Vec2d&)>;

Vec3d flat(const Vec2d& uv) { return {uv[0], uv[1], 0}; }

// The unit square, n by n cells of two triangles, uv as given, in space where the map says.
Mesh square(int n, const Map& map = flat, double scale = 1) {
  Mesh mesh;
  mesh.request_edge_status();
  const auto uv = provide_property(mesh, property::uv);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const Vec2d p(static_cast<double>(i) / n, static_cast<double>(j) / n);
      mesh.property(uv, mesh.add_vertex(map(p) * scale)) = p * scale;
    }
  const auto at = [&](int i, int j) { return mesh.vertex_handle(static_cast<unsigned>(j * (n + 1) + i)); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.add_face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  return mesh;
}

// Lines on the square of the given scale, drawn in its unit coordinates.
class Drawing {
 public:
  explicit Drawing(Mesh& mesh, double scale = 1) : surface_(mesh), locator_(surface_), scale_(scale) {}

  void line(LineKind kind, const std::vector<Vec2d>& points, LineEnd begin = LineEnd::border,
            LineEnd end = LineEnd::border) {
    Line line;
    line.kind = kind;
    line.begin_reason = begin;
    line.end_reason = end;
    for (const Vec2d& p : points) line.points.push_back(at(p));
    network_.lines.push_back(line);
  }
  // With samples in between, about 0.013 apart.
  void segment(LineKind kind, const Vec2d& from, const Vec2d& to, LineEnd begin = LineEnd::border,
               LineEnd end = LineEnd::border) {
    std::vector<Vec2d> points;
    const int n = static_cast<int>(std::ceil((to - from).norm() / 0.013));
    for (int i = 0; i <= n; ++i)
      points.push_back(i == n ? to : from + (to - from) * (static_cast<double>(i) / n));
    line(kind, points, begin, end);
  }
  void circle(LineKind kind, const Vec2d& centre, double radius, int samples = 60) {
    Line line;
    line.kind = kind;
    line.closed = true;
    line.begin_reason = line.end_reason = LineEnd::loop;
    for (int i = 0; i < samples; ++i) {
      const double angle = 2 * pi * (i + 0.3) / samples;
      line.points.push_back(at(centre + radius * Vec2d(std::cos(angle), std::sin(angle))));
    }
    network_.lines.push_back(line);
  }
  void sample(const Vec2d& p) { network_.isotropic_samples.push_back(at(p)); }
  void keep() const { write_lines(surface_, network_); }
  const SurfaceRef& surface() const { return surface_; }

 private:
  SurfacePoint at(const Vec2d& p) const {
    SurfacePoint point = locator_.locate_surely(p * scale_, OpenMesh::FaceHandle(0));
    for (double& b : point.barycentric)  // as a tracer that stops on an edge has it
      if (std::abs(b) < 1e-12) b = 0;
    point.barycentric /= point.barycentric[0] + point.barycentric[1] + point.barycentric[2];
    return point;
  }

  SurfaceRef surface_;
  detail::UvLocator locator_;
  double scale_;
  LineNetwork network_;
};

std::map<int, int> degrees(const OpenMesh::PolyMesh& mesh) {
  std::map<int, int> count;
  for (const auto f : mesh.faces()) ++count[static_cast<int>(mesh.valence(f))];
  return count;
}

int euler(const OpenMesh::PolyMesh& mesh) {
  return static_cast<int>(mesh.n_vertices()) - static_cast<int>(mesh.n_edges()) +
         static_cast<int>(mesh.n_faces());
}

size_t with_origin(const OpenMesh::PolyMesh& mesh, Origin origin) {
  const auto handle = require_property(mesh, property::origin);
  size_t count = 0;
  for (const auto v : mesh.vertices()) count += mesh.property(handle, v) == static_cast<int>(origin);
  return count;
}

size_t with_kind(const OpenMesh::PolyMesh& mesh, EdgeKind kind) {
  const auto handle = require_property(mesh, property::edge_kind);
  size_t count = 0;
  for (const auto e : mesh.edges()) count += mesh.property(handle, e) == static_cast<int>(kind);
  return count;
}

// Area in the plane: exactly that of the square if the faces cover it once.
double area(const OpenMesh::PolyMesh& mesh) {
  double sum = 0;
  for (const auto h : mesh.halfedges()) {
    if (mesh.is_boundary(h)) continue;
    const auto a = mesh.point(mesh.from_vertex_handle(h)), b = mesh.point(mesh.to_vertex_handle(h));
    sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
  }
  return sum;
}

void grid(Drawing& drawing, int min_lines, int max_lines) {
  for (int i = 1; i <= min_lines; ++i) {
    const double y = (i + 0.1) / (min_lines + 1.2);
    drawing.segment(LineKind::min, {0, y}, {1, y});
  }
  for (int i = 1; i <= max_lines; ++i) {
    const double x = (i + 0.1) / (max_lines + 1.2);
    drawing.segment(LineKind::max, {x, 0}, {x, 1});
  }
}

}  // namespace

TEST_CASE("a grid of lines becomes a grid of quads", "[mesher]") {
  const double scale = GENERATE(1.0, 1e-6, 1e6);
  Mesh mesh = square(13, flat, scale);
  Drawing drawing(mesh, scale);
  grid(drawing, 4, 7);
  drawing.keep();
  MeshReport report;
  const auto result = build_polygons(drawing.surface(), {}, &report);
  CHECK(degrees(result) == std::map<int, int>{{4, 5 * 8}});
  CHECK(result.n_vertices() == 6 * 9);
  CHECK(with_origin(result, Origin::crossing) == 4 * 7);
  CHECK(with_origin(result, Origin::corner) == 4);
  CHECK(with_origin(result, Origin::border) == 2 * (4 + 7));
  CHECK(with_kind(result, EdgeKind::min) == 4 * 8);
  CHECK(with_kind(result, EdgeKind::max) == 7 * 5);
  CHECK(with_kind(result, EdgeKind::border) == 2 * (5 + 8));
  CHECK(with_kind(result, EdgeKind::conforming) == 0);
  CHECK(area(result) == Approx(scale * scale).epsilon(1e-12));
  CHECK(report.crossings == 4 * 7);
  CHECK(report.quads == 40);
}

TEST_CASE("result vertices are points of the input surface", "[mesher]") {
  Mesh mesh = square(17, [](const Vec2d& p) { return Vec3d(p[0], p[1], 0.3 * std::sin(3 * p[0]) * p[1]); });
  Drawing drawing(mesh);
  grid(drawing, 6, 6);
  drawing.keep();
  const auto result = build_polygons(drawing.surface());
  const auto face = require_property(result, property::source_face);
  const auto barycentric = require_property(result, property::source_barycentric);
  for (const auto v : result.vertices()) {
    const SurfacePoint p{OpenMesh::FaceHandle(result.property(face, v)), result.property(barycentric, v)};
    CHECK(p.barycentric[0] + p.barycentric[1] + p.barycentric[2] == Approx(1));
    CHECK(*std::min_element(p.barycentric.begin(), p.barycentric.end()) >= 0);
    CHECK((position(drawing.surface(), p) - Vec3d(result.point(v))).norm() == 0);
  }
}

TEST_CASE("a line that ends in a cell is cut back to its last crossing", "[mesher]") {
  Mesh mesh = square(9);
  Drawing drawing(mesh);
  grid(drawing, 2, 2);
  drawing.segment(LineKind::min, {0, 0.52}, {0.83, 0.52}, LineEnd::border, LineEnd::too_close);
  drawing.segment(LineKind::max, {0.2, 0.07}, {0.25, 0.2}, LineEnd::too_close, LineEnd::too_close);
  drawing.keep();
  SECTION("polygons as extracted keep the T as a corner") {
    MeshOptions options;
    options.max_degree = 0;
    const auto result = build_polygons(drawing.surface(), options);
    CHECK(degrees(result) == std::map<int, int>{{4, 10}, {5, 1}});
    CHECK(result.n_vertices() == 16 + 3);
    CHECK(with_kind(result, EdgeKind::conforming) == 0);
  }
  SECTION("conforming edges leave quads and triangles") {
    const auto result = build_polygons(drawing.surface());
    CHECK(degrees(result) == std::map<int, int>{{3, 1}, {4, 11}});
    CHECK(result.n_vertices() == 16 + 3);
    CHECK(with_kind(result, EdgeKind::conforming) == 1);
  }
  SECTION("triangles only") {
    MeshOptions options;
    options.max_degree = 3;
    const auto result = build_polygons(drawing.surface(), options);
    CHECK(degrees(result) == std::map<int, int>{{3, 10 * 2 + 3}});
    CHECK(area(result) == Approx(1));
  }
}

TEST_CASE("two T's across a cell are joined", "[mesher]") {
  Mesh mesh = square(9);
  Drawing drawing(mesh);
  grid(drawing, 3, 3);  // lines at 0.26, 0.5, 0.74
  drawing.segment(LineKind::max, {0.38, 0}, {0.38, 0.3}, LineEnd::border, LineEnd::too_close);
  drawing.segment(LineKind::max, {0.38, 1}, {0.38, 0.45}, LineEnd::border, LineEnd::too_close);
  drawing.keep();
  const auto result = build_polygons(drawing.surface());
  CHECK(degrees(result) == std::map<int, int>{{4, 16 + 4}});
  CHECK(with_kind(result, EdgeKind::conforming) == 1);
}

TEST_CASE("without lines a patch is its border", "[mesher]") {
  Mesh mesh = square(6);
  Drawing drawing(mesh);
  drawing.keep();
  const auto result = build_polygons(drawing.surface());
  CHECK(result.n_vertices() == 4);
  CHECK(degrees(result) == std::map<int, int>{{4, 1}});
  CHECK(with_origin(result, Origin::corner) == 4);
}

TEST_CASE("circles and radii around an isotropic sample", "[mesher]") {
  Mesh mesh = square(20);
  Drawing drawing(mesh);
  const Vec2d centre(0.503, 0.497);
  drawing.circle(LineKind::min, centre, 0.15);
  drawing.circle(LineKind::min, centre, 0.35);
  for (int i = 0; i < 8; ++i) {
    const double angle = 2 * pi * (i + 0.2) / 8;
    const Vec2d out(std::cos(angle), std::sin(angle));
    drawing.segment(LineKind::max, centre + 0.1 * out, centre + 0.4 * out, LineEnd::too_close,
                    LineEnd::too_close);
  }
  drawing.sample(centre);
  drawing.keep();
  const auto result = build_polygons(drawing.surface());
  CHECK(with_origin(result, Origin::isotropic) == 1);
  CHECK(with_origin(result, Origin::crossing) == 16);
  CHECK(with_kind(result, EdgeKind::max) == 8);
  CHECK(with_kind(result, EdgeKind::min) == 16);
  CHECK(euler(result) == 1);
  CHECK(area(result) == Approx(1));
  for (const int max_degree : {3, 4}) {
    MeshOptions options;
    options.max_degree = max_degree;
    const auto mesh_of = build_polygons(drawing.surface(), options);
    const auto origin = require_property(mesh_of, property::origin);
    for (const auto v : mesh_of.vertices())
      if (mesh_of.property(origin, v) == static_cast<int>(Origin::isotropic))
        CHECK(mesh_of.valence(v) ==
              (max_degree == 3 ? 8 : 4));  // its fan in the inner circle, joined in pairs
  }
}

TEST_CASE("features stay, and lines that stop at them meet them", "[mesher]") {
  Mesh mesh = square(12);
  for (const auto e : mesh.edges()) {
    const auto h = mesh.halfedge_handle(e, 0);
    const Vec3d a = mesh.point(mesh.from_vertex_handle(h)), b = mesh.point(mesh.to_vertex_handle(h));
    mesh.status(e).set_feature(std::abs(a[1] - 0.5) < 1e-9 && std::abs(b[1] - 0.5) < 1e-9 &&
                               std::max(a[0], b[0]) < 0.8);
  }
  Drawing drawing(mesh);
  for (const double x : {0.21, 0.43, 0.61}) {
    drawing.segment(LineKind::max, {x, 0}, {x, 0.5}, LineEnd::border, LineEnd::feature);
    drawing.segment(LineKind::max, {x + 0.08, 1}, {x + 0.08, 0.5}, LineEnd::border, LineEnd::feature);
  }
  drawing.segment(LineKind::min, {0, 0.3}, {1, 0.3});
  drawing.keep();
  const auto result = build_polygons(drawing.surface());
  CHECK(euler(result) == 1);
  CHECK(area(result) == Approx(1));
  CHECK(with_origin(result, Origin::feature) == 6);
  CHECK(with_origin(result, Origin::corner) == 4 + 2);  // the feature begins on the border and ends inside
  CHECK(with_kind(result, EdgeKind::feature) == 7);
  double length = 0;
  for (const auto e : result.edges())
    if (result.status(e).feature()) length += result.calc_edge_length(e);
  CHECK(length == Approx(0.75));
}

TEST_CASE("a chain is straightened as far as the tolerance goes", "[mesher]") {
  // A quarter of a cylinder of radius 1 bent along x, with one line over it; epsilon says how near a chord is
  // to lie.
  const auto bent = [](const Vec2d& p) {
    return Vec3d(std::sin(p[0] * pi / 2), p[1], std::cos(p[0] * pi / 2));
  };
  Mesh mesh = square(40, bent);
  Drawing drawing(mesh);
  drawing.segment(LineKind::max, {0, 0.41}, {1, 0.41});
  drawing.keep();
  const double epsilon = 0.02;
  const auto handle = provide_property(mesh, property::OnMesh<double>{"anisomesh:epsilon", "trace_lines"});
  mesh.property(handle) = epsilon;
  MeshOptions options;
  options.chain_tolerance = 1;
  const auto result = build_polygons(drawing.surface(), options);
  size_t on_line = 0;
  for (const auto v : result.vertices()) on_line += std::abs(result.point(v)[1] - 0.41) < 1e-9;
  // A chord over the angle a lies 1 - cos(a / 2) below the arc: at least 4 chords, and halving may need 8.
  CHECK(on_line >= 5);
  CHECK(on_line <= 9);
  options.chain_tolerance = options.cell_tolerance = std::numeric_limits<double>::infinity();
  CHECK(build_polygons(drawing.surface(), options).n_vertices() == 6);
}

TEST_CASE("a line that nearly meets another at the border makes no sliver", "[mesher]") {
  Mesh mesh = square(10);
  Drawing drawing(mesh);
  grid(drawing, 3, 3);
  drawing.segment(LineKind::min, {0, 0.262}, {1, 0.258 + 0.12});
  drawing.keep();
  const auto result = build_polygons(drawing.surface());
  CHECK(euler(result) == 1);
  CHECK(area(result) == Approx(1));
  for (const auto e : result.edges()) CHECK(result.calc_edge_length(e) > 0.02);
}

TEST_CASE("what cannot be meshed is refused", "[mesher]") {
  Mesh mesh = square(4);
  const SurfaceRef surface = mesh;
  CHECK_THROWS_AS(build_polygons(surface), InvalidInput);  // no lines
  Drawing(mesh).keep();
  MeshOptions options;
  options.max_degree = 2;
  CHECK_THROWS_AS(build_polygons(surface, options), InvalidOption);
  CHECK_THROWS_AS(build_polygons(surface, {}, nullptr, [](double) { return false; }), Cancelled);
}

TEST_CASE("how far an edge turns from the directions of the lines is known from the tensors", "[mesher]") {
  auto mesh = square(2);
  const SurfacePoint middle{OpenMesh::FaceHandle(0), Vec3d(1, 1, 1) / 3};
  {
    const SurfaceRef surface(mesh);
    CHECK(detail::LineDirections(surface).misalignment(middle, {1, 1, 0}) == 0);  // none known
  }
  const auto tensor = provide_property(mesh, property::tensor);
  const auto bend = [&](const OpenMesh::Vec6d& t) {
    for (const auto v : mesh.vertices()) mesh.property(tensor, v) = t;
  };
  bend({0, 0, 0, 4, 0, 0});  // a cylinder along x
  const SurfaceRef surface(mesh);
  for (int i = 0; i <= 24; ++i) {
    const double angle = pi * i / 12, sine = std::sin(2 * angle);
    const Vec3d along(5 * std::cos(angle), 5 * std::sin(angle), 0.3);
    CHECK(detail::LineDirections(surface).misalignment(middle, along) == Approx(sine * sine).margin(1e-12));
  }
  bend({0, 2, 0, 0, 0, 0});  // a symmetric saddle: any directions will do
  CHECK(detail::LineDirections(surface).misalignment(middle, {1, 0, 0}) == 0);
  bend({3, 2, 0, 3, 0, 0});  // 1 and 5, along the diagonals
  CHECK(detail::LineDirections(surface).misalignment(middle, {1, 0, 0}) == Approx(1));
  CHECK(detail::LineDirections(surface).misalignment(middle, {1, 1, 0}) == Approx(0).margin(1e-12));
}
