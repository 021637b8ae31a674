// How near results lie to their inputs, beside the decimaters, at the same number of vertices.
//
//   ANISOMESH_DATA=FOLDER fidelity [--scans A,B] [--vertices N,M] [--only scans|smooth|convergence] [--plot
//   FILE.svg]
//
// Eight scans of libcgal-demo; torus, ellipsoid and wave; then how the error of smooth shapes falls with the
// number of vertices, beside the least that bilinear and triangular elements can have. Needs
// OpenMesh-commandlineDecimater and meshlabserver with xvfb-run for the peers; what is missing is left out.
// Exits 1 if a bar is missed.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <sstream>
#include <vector>

#include "anisomesh/properties.hh"
#include "anisomesh/remesh.hh"
#include "anisomesh/shapes.hh"
#include "peers.hh"

using namespace anisomesh;

namespace {

struct Ours {
  OpenMesh::PolyMesh mesh;
  double seconds = 0;  ///< of the processor, all threads: the machine may be busy with other work
};

Ours remeshed(OpenMesh::TriMesh mesh, size_t vertices, bool fit) {
  RemeshOptions options;
  options.target_vertices = vertices;
  options.fit.enabled = fit;
  Ours ours;
  const std::clock_t start = std::clock();
  ours.mesh = remesh(mesh, options);
  ours.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return ours;
}

void print_head() {
  std::printf(
      "| input | tool | vertices | rms %% | hausdorff %% | normal | of polygons | quads %% | align | bend %% "
      "| folded, not "
      "manifold | topology | s |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
}

void print_row(const std::string& input, const char* tool, const Comparison& c, const std::string& seconds) {
  std::printf("| %s | %s | %zu | %.4f | %.2f | %.2f | %.2f | %.1f | %.1f | %.2f | %zu | %s | %s |\n",
              input.c_str(), tool, c.vertices, 100 * c.two_sided.rms, 100 * c.two_sided.hausdorff,
              c.mean_surface_normal_deviation_degrees, c.mean_normal_deviation_degrees, 100 * c.quad_fraction,
              c.mean_alignment_degrees, 100 * c.mean_planarity,
              c.folded_faces + c.non_manifold_edges + c.non_manifold_vertices,
              c.same_topology ? "kept" : "NO", seconds.c_str());
  std::fflush(stdout);
}

std::string named(const std::string& what, size_t vertices, const std::string& bar) {
  return what + " at " + std::to_string(vertices) + ": " + bar;
}

/// One input at one number of vertices, all tools. \param smooth one of the surfaces made by code
void compare_tools(const std::string& name, const OpenMesh::TriMesh& input, const std::string& path,
                   size_t vertices, bool smooth, bool with_plain, const bench::Folder& folder,
                   bench::Bars& bars) {
  bench::Ruler ruler(input);
  Ours plain;
  if (with_plain) {
    plain = remeshed(input, vertices, false);
    print_row(name, "no fit", ruler(plain.mesh), bench::format("%.2f", plain.seconds));
  }
  Ours fitted = remeshed(input, vertices, true);
  const Comparison c = ruler(fitted.mesh);
  print_row(name, "**fit**", c, bench::format("%.2f", fitted.seconds));
  const auto check = [&](bool kept, const std::string& bar) {
    bars.check(kept, named(name, vertices, bar), false);
  };
  if (auto mesh = bench::decimated(path, c.vertices, folder)) {
    const Comparison d = ruler(*mesh);
    print_row(name, "decimater -M Q", d, "");
    const double ratio = c.two_sided.rms / d.two_sided.rms;
    check(ratio <= 1, "rms over the decimater's " + bench::format("%.2f", ratio) + " (1)");
    check(c.two_sided.hausdorff <= 1.5 * d.two_sided.hausdorff,
          "hausdorff over the decimater's " +
              bench::format("%.2f", c.two_sided.hausdorff / d.two_sided.hausdorff) + " (1.5)");
    const double normals = c.mean_surface_normal_deviation_degrees,
                 theirs = d.mean_surface_normal_deviation_degrees;
    check(normals <= theirs, "normal deviation " + bench::format("%.2f", normals) + ", the decimater's " +
                                 bench::format("%.2f", theirs));
  }
  if (auto mesh = bench::collapsed_by_meshlab(path, c.vertices, folder)) {
    const Comparison m = ruler(*mesh);
    print_row(name, "MeshLab", m, "");
    const double ratio = c.two_sided.rms / m.two_sided.rms;
    check(ratio <= (smooth ? 1 : 1.5),
          "rms over MeshLab's " + bench::format("%.2f", ratio) + (smooth ? " (1)" : " (1.5)"));
  }
  check(c.quad_fraction >= 0.75, "quads " + bench::format("%.3f", c.quad_fraction) + " (0.75)");
  check(c.mean_alignment_degrees <= 9,
        "alignment " + bench::format("%.1f", c.mean_alignment_degrees) + " (9)");
  check(
      c.folded_faces + c.non_manifold_edges + c.non_manifold_vertices + c.t_junctions == 0 && c.same_topology,
      "folded, not manifold or of another topology");
  check(c.mean_planarity < 0.05, "bend " + bench::format("%.3f", c.mean_planarity) + " (0.05)");
  if (!with_plain) return;
  const double ratio = fitted.seconds / plain.seconds;
  check(ratio <= 1.3, "time over that without " + bench::format("%.2f", ratio) + " (1.3)");
}

void scans(const std::vector<std::string>& names, const std::vector<size_t>& counts, bool with_plain,
           bench::Bars& bars) {
  const bench::Folder folder;
  print_head();
  for (const auto& name : names) {
    const auto path = demo_mesh(name + ".off");
    if (!path) {
      std::printf("SKIPPED: %s.off is not in the folder ANISOMESH_DATA names\n", name.c_str());
      continue;
    }
    const auto mesh = read_surface(*path);
    for (const size_t vertices : counts)
      if (5 * vertices <= mesh.n_vertices())
        compare_tools(name, mesh, *path, vertices, false, with_plain, folder, bars);
  }
  std::printf("\n");
}

OpenMesh::TriMesh smooth_shape(const std::string& name) {
  ShapeOptions options;
  options.vertices = 40000;
  return make_shape(name, options);
}

void smooth(bench::Bars& bars) {
  const bench::Folder folder;
  print_head();
  for (const std::string name : {"torus", "ellipsoid", "wave"}) {
    const auto mesh = smooth_shape(name);
    OpenMesh::PolyMesh polygons;
    for (const auto v : mesh.vertices()) polygons.add_vertex(mesh.point(v));
    for (const auto f : mesh.faces()) {
      std::vector<OpenMesh::VertexHandle> corners;
      for (const auto v : mesh.fv_range(f)) corners.push_back(v);
      polygons.add_face(corners);
    }
    const std::string path = folder / (name + ".off");
    write_mesh(polygons, path);
    compare_tools(name, mesh, path, 1000, true, true, folder, bars);
  }
  std::printf("\n");
}

/// What the best mesh of n vertices has where the curvatures do not vary over an element: with area
/// elements free, A ~ K^(-1/3) is best, and the rms is constant * (integral of |K|^(1/3))^(3/2) / (sqrt(area)
/// n). Squares of a quadric: 1 / sqrt(360); equilateral triangles, two for each vertex: 0.03729.
double least_rms(OpenMesh::TriMesh mesh, double constant) {
  estimate_curvature(mesh);
  const auto k_min = require_property(mesh, property::k_min), k_max = require_property(mesh, property::k_max);
  const SurfaceRef surface = mesh;
  double integral = 0, area = 0;
  for (const auto f : mesh.faces()) {
    const auto c = surface.corners(f);
    const Vec3d &a = surface.point(c.vertex[0]), &b = surface.point(c.vertex[1]),
                &d = surface.point(c.vertex[2]);
    const double part = 0.5 * cross(b - a, d - a).norm();
    double gauss = 0;
    for (const auto v : c.vertex) gauss += std::abs(mesh.property(k_min, v) * mesh.property(k_max, v)) / 3;
    integral += part * std::cbrt(gauss);
    area += part;
  }
  return constant * std::pow(integral, 1.5) / std::sqrt(area) / surface.diagonal();
}

struct Curve {
  std::string name;
  std::vector<double> vertices, rms;
  double bilinear = 0, triangular = 0;  // times 1 / vertices

  double slope() const {
    double x = 0, y = 0, xx = 0, xy = 0;
    const double n = static_cast<double>(vertices.size());
    for (size_t i = 0; i < vertices.size(); ++i) {
      const double a = std::log(vertices[i]), b = std::log(rms[i]);
      x += a, y += b, xx += a * a, xy += a * b;
    }
    return (n * xy - x * y) / (n * xx - x * x);
  }
};

std::vector<Curve> convergence() {
  std::vector<Curve> curves;
  std::printf(
      "| shape | vertices | rms %% | over the least of bilinear elements | over that of triangles |\n"
      "|---|---|---|---|---|\n");
  for (const std::string name : {"sphere", "torus", "ellipsoid", "saddle", "wave"}) {
    const auto mesh = smooth_shape(name);
    bench::Ruler ruler(mesh);
    Curve curve{name, {}, {}, least_rms(mesh, 1 / std::sqrt(360.0)), least_rms(mesh, 0.03729)};
    for (const size_t vertices : {250, 500, 1000, 2000, 4000}) {
      Ours ours = remeshed(mesh, vertices, true);
      const Comparison c = ruler(ours.mesh);
      const auto n = static_cast<double>(c.vertices);
      curve.vertices.push_back(n);
      curve.rms.push_back(c.two_sided.rms);
      std::printf("| %s | %zu | %.4f | %.2f | %.2f |\n", name.c_str(), c.vertices, 100 * c.two_sided.rms,
                  c.two_sided.rms * n / curve.bilinear, c.two_sided.rms * n / curve.triangular);
      std::fflush(stdout);
    }
    curves.push_back(curve);
  }
  std::printf("\n| shape | slope of log rms over log vertices |\n|---|---|\n");
  for (const Curve& curve : curves) std::printf("| %s | %.2f |\n", curve.name.c_str(), curve.slope());
  std::printf("\n");
  return curves;
}

/// Both axes logarithmic; a dot a result, and the two bounds as lines of slope -1.
void plot(const std::vector<Curve>& curves, const std::string& path) {
  const char* colours[] = {"#4477aa", "#ee6677", "#228833", "#aa8800", "#aa3377"};
  const double left = 60, top = 20, width = 560, height = 380;
  const auto x = [&](double n) { return left + width * std::log10(n / 200) / std::log10(5000.0 / 200); };
  const auto y = [&](double rms) { return top + height * std::log10(3e-3 / rms) / std::log10(3e-3 / 1e-5); };
  std::ostringstream svg;
  svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 760 450\" font-family=\"sans-serif\" "
         "font-size=\"13\">\n<rect width=\"760\" height=\"450\" fill=\"white\"/>\n";
  const auto line = [&](double x1, double y1, double x2, double y2, const std::string& style) {
    svg << "<line x1=\"" << x1 << "\" y1=\"" << y1 << "\" x2=\"" << x2 << "\" y2=\"" << y2 << "\" " << style
        << "/>\n";
  };
  const auto text = [&](double px, double py, const std::string& words, const std::string& style = "") {
    svg << "<text x=\"" << px << "\" y=\"" << py << "\" " << style << ">" << words << "</text>\n";
  };
  for (const int n : {250, 500, 1000, 2000, 4000}) {
    line(x(n), top, x(n), top + height, "stroke=\"#ddd\"");
    text(x(n), top + height + 18, std::to_string(n), "text-anchor=\"middle\"");
  }
  for (const double rms : {1e-3, 1e-4, 1e-5}) {
    line(left, y(rms), left + width, y(rms), "stroke=\"#ddd\"");
    text(left - 6, y(rms) + 4, bench::format("%.3f %%", 100 * rms), "text-anchor=\"end\"");
  }
  text(left + width / 2, top + height + 38, "vertices", "text-anchor=\"middle\"");
  text(left + 6, top + 14, "two-sided rms; full lines: least of bilinear elements, dashed: of triangles");
  for (size_t i = 0; i < curves.size(); ++i) {
    const std::string colour = std::string("stroke=\"") + colours[i % 5] + "\"";
    const Curve& c = curves[i];
    line(x(250), y(c.bilinear / 250), x(4000), y(c.bilinear / 4000), colour + " opacity=\"0.6\"");
    line(x(250), y(c.triangular / 250), x(4000), y(c.triangular / 4000),
         colour + " stroke-dasharray=\"5 4\" opacity=\"0.6\"");
    for (size_t k = 0; k < c.rms.size(); ++k)
      svg << "<circle cx=\"" << x(c.vertices[k]) << "\" cy=\"" << y(c.rms[k]) << "\" r=\"4\" fill=\""
          << colours[i % 5] << "\"/>\n";
    text(left + width + 12, top + 30 + 22 * static_cast<double>(i),
         c.name + ", slope " + bench::format("%.2f", c.slope()),
         std::string("fill=\"") + colours[i % 5] + "\"");
  }
  svg << "</svg>\n";
  write_text(svg.str(), path);
}

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> words;
  std::istringstream stream(list);
  for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
  return words;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> names{"mannequin-devil", "lion-head",        "bunny00", "camel",
                                 "armadillo",       "refined_elephant", "bull",    "man"};
  std::vector<size_t> counts{1000, 2000, 4000};
  std::string only, plot_path;
  bool with_plain = true;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--scans") == 0) names = split(argv[i + 1]);
    if (std::strcmp(argv[i], "--only") == 0) only = argv[i + 1];
    if (std::strcmp(argv[i], "--plain") == 0) with_plain = std::strcmp(argv[i + 1], "no") != 0;
    if (std::strcmp(argv[i], "--plot") == 0) plot_path = argv[i + 1];
    if (std::strcmp(argv[i], "--vertices") == 0) {
      counts.clear();
      for (const auto& word : split(argv[i + 1])) counts.push_back(std::stoul(word));
    }
  }
  bench::Bars bars;
  try {
    if (only.empty() || only == "scans") scans(names, counts, with_plain, bars);
    if (only.empty() || only == "smooth") smooth(bars);
    if (only.empty() || only == "convergence") {
      const auto curves = convergence();
      if (!plot_path.empty()) plot(curves, plot_path);
    }
  } catch (const std::exception& error) {
    std::printf("%s\n", error.what());
    return 1;
  }
  std::printf("%d of %d bars kept\n", bars.checked() - bars.missed(), bars.checked());
  return bars.missed() > 0 ? 1 : 0;
}
