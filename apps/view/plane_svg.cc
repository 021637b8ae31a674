#include "view/plane_svg.hh"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>

#include "anisomesh/features.hh"
#include "anisomesh/lines.hh"
#include "anisomesh/mesher.hh"
#include "anisomesh/properties.hh"

namespace view {

using namespace anisomesh;

namespace {

constexpr const char* min_colour = "#1f5fd0";
constexpr const char* max_colour = "#d62728";
constexpr const char* feature_colour = "#1a9850";
constexpr const char* conforming_colour = "#e08a00";

class Drawing {
 public:
  Drawing(const SurfaceRef& surface, double width)
      : surface_(surface), uv_(require_property(surface.connectivity(), property::uv)) {
    Vec2d low(std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()), high(-low);
    for (const auto v : surface.connectivity().vertices()) {
      low.minimize(surface.connectivity().property(uv_, v));
      high.maximize(surface.connectivity().property(uv_, v));
    }
    const double margin = 0.02 * width, span = std::max(high[0] - low[0], 1e-300);
    scale_ = (width - 2 * margin) / span;
    origin_ = Vec2d(low[0] - margin / scale_, high[1] + margin / scale_);
    height_ = (high[1] - low[1]) * scale_ + 2 * margin;
    width_ = width;
  }

  Vec2d at(OpenMesh::VertexHandle v) const { return surface_.connectivity().property(uv_, v); }
  Vec2d at(int face, const Vec3d& barycentric) const {
    Vec2d point(0, 0);
    const auto corners = surface_.corners(OpenMesh::FaceHandle(face));
    for (size_t i = 0; i < 3; ++i) point += barycentric[i] * at(corners.vertex[i]);
    return point;
  }

  void begin(const char* name, const std::string& style) {
    text_ += "<g id=\"" + std::string(name) + "\" " + style + ">\n";
  }
  void end() { text_ += "</g>\n"; }
  void path(const std::vector<Vec2d>& points, bool closed, int id) {
    text_ += "<path data-number=\"" + std::to_string(id) + "\" d=\"";
    for (size_t i = 0; i < points.size(); ++i) text_ += (i ? "L" : "M") + pair(points[i], " ");
    text_ += closed ? "Z\"/>\n" : "\"/>\n";
  }
  void dot(const Vec2d& point, double radius, const char* colour, int id) {
    text_ += "<circle data-number=\"" + std::to_string(id) + "\" " + centre(point) + " r=\"" +
             number(radius) + "\" fill=\"" + colour + "\"/>\n";
  }
  void triangle(const Vec2d& point, double radius, const char* colour, int id) {
    const double x = (point[0] - origin_[0]) * scale_, y = (origin_[1] - point[1]) * scale_;
    text_ += "<polygon data-number=\"" + std::to_string(id) + "\" points=\"" + number(x) + "," +
             number(y - radius) + " " + number(x + radius) + "," + number(y + 0.8 * radius) + " " +
             number(x - radius) + "," + number(y + 0.8 * radius) + "\" fill=\"" + colour + "\"/>\n";
  }

  std::string svg() const {
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + number(width_) + "\" height=\"" +
           number(height_) + "\" viewBox=\"0 0 " + number(width_) + " " + number(height_) +
           "\" fill=\"none\" stroke-linejoin=\"round\">\n<rect width=\"100%\" height=\"100%\" "
           "fill=\"#ffffff\"/>\n" +
           text_ + "</svg>\n";
  }

 private:
  static std::string number(double x) {
    char text[40];
    std::snprintf(text, sizeof text, "%.2f", x);
    return text;
  }
  std::string pair(const Vec2d& p, const char* separator) const {
    return number((p[0] - origin_[0]) * scale_) + separator + number((origin_[1] - p[1]) * scale_);
  }
  std::string centre(const Vec2d& p) const {
    return "cx=\"" + number((p[0] - origin_[0]) * scale_) + "\" cy=\"" +
           number((origin_[1] - p[1]) * scale_) + "\"";
  }

  const SurfaceRef& surface_;
  OpenMesh::VPropHandleT<Vec2d> uv_;
  Vec2d origin_;
  double scale_ = 1, width_ = 0, height_ = 0;
  std::string text_;
};

std::string stroke(const char* colour, double width) {
  char text[80];
  std::snprintf(text, sizeof text, "stroke=\"%s\" stroke-width=\"%.2g\"", colour, width);
  return text;
}

template <class Condition>
void draw_edges(Drawing& drawing, const SurfaceRef& surface, Condition condition) {
  const auto& mesh = surface.connectivity();
  for (const auto e : mesh.edges()) {
    if (!condition(e)) continue;
    const auto h = mesh.halfedge_handle(e, 0);
    drawing.path({drawing.at(mesh.from_vertex_handle(h)), drawing.at(mesh.to_vertex_handle(h))}, false,
                 e.idx());
  }
}

void draw_lines(Drawing& drawing, const LineNetwork& network, LineKind kind) {
  for (size_t i = 0; i < network.lines.size(); ++i) {
    const auto& line = network.lines[i];
    if (line.kind != kind) continue;
    std::vector<Vec2d> points;
    for (const auto& p : line.points) points.push_back(drawing.at(p.face.idx(), p.barycentric));
    drawing.path(points, line.closed, static_cast<int>(i));
  }
}

void draw_umbilics(Drawing& drawing, const OpenMesh::TriConnectivity& mesh) {
  const auto kind = require_property(mesh, property::umbilic);
  const auto place = require_property(mesh, property::umbilic_position);
  for (const auto f : mesh.faces()) {
    const int sign = mesh.property(kind, f);
    const Vec2d point = drawing.at(f.idx(), mesh.property(place, f));
    if (sign > 0) drawing.dot(point, 5, "#ffb000", f.idx());
    if (sign < 0) drawing.triangle(point, 5.5, "#9b30d9", f.idx());
  }
}

void draw_polygons(Drawing& drawing, const OpenMesh::PolyMesh& result, bool by_kind, size_t faces) {
  const auto source = require_property(result, property::source_face);
  const auto place = require_property(result, property::source_barycentric);
  OpenMesh::EPropHandleT<int> kind;
  by_kind = by_kind && result.get_property_handle(kind, property::edge_kind.name);
  for (const auto v : result.vertices())
    if (result.property(source, v) < 0 || static_cast<size_t>(result.property(source, v)) >= faces)
      throw InvalidInput("vertex " + std::to_string(v.idx()) +
                         " of the result lies on a face that the surface does not have; give the surface it "
                         "was made from");
  constexpr std::array<const char*, 5> colours = {min_colour, max_colour, feature_colour, "#000000",
                                                  conforming_colour};
  for (size_t k = 0; k < (by_kind ? colours.size() : 1); ++k) {
    drawing.begin(by_kind ? "edge-kind" : "polygon-edges", stroke(by_kind ? colours[k] : "#000000", 1.3));
    for (const auto e : result.edges()) {
      if (by_kind && result.property(kind, e) != static_cast<int>(k)) continue;
      std::vector<Vec2d> ends;
      for (const auto v : {result.from_vertex_handle(result.halfedge_handle(e, 0)),
                           result.to_vertex_handle(result.halfedge_handle(e, 0))})
        ends.push_back(drawing.at(result.property(source, v), result.property(place, v)));
      drawing.path(ends, false, e.idx());
    }
    drawing.end();
  }
}

}  // namespace

std::string plane_svg(const SurfaceRef& surface, const OpenMesh::PolyMesh* result,
                      const std::vector<std::string>& layers, double width) {
  const auto& mesh = surface.connectivity();
  Drawing drawing(surface, width);
  const auto asked = [&](const char* name) {
    return std::find(layers.begin(), layers.end(), name) != layers.end();
  };
  const auto wanted = [&](const char* name) { return layers.empty() || asked(name); };
  if (asked("triangles")) {
    drawing.begin("triangles", stroke("#cccccc", 0.4));
    draw_edges(drawing, surface, [](OpenMesh::EdgeHandle) { return true; });
    drawing.end();
  }
  if (wanted("border")) {
    drawing.begin("border", stroke("#000000", 1.5));
    draw_edges(drawing, surface, [&](OpenMesh::EdgeHandle e) { return mesh.is_boundary(e); });
    drawing.end();
  }
  if (wanted("features")) {
    drawing.begin("features", stroke(feature_colour, 2.5));
    draw_edges(drawing, surface,
               [&](OpenMesh::EdgeHandle e) { return !mesh.is_boundary(e) && is_feature_or_border(mesh, e); });
    drawing.end();
  }
  LineNetwork network;
  if (has_property(mesh, property::line_table)) network = read_lines(surface);
  for (const auto kind : {LineKind::min, LineKind::max}) {
    const bool min = kind == LineKind::min;
    if (!wanted(min ? "min-lines" : "max-lines")) continue;
    drawing.begin(min ? "min-lines" : "max-lines", stroke(min ? min_colour : max_colour, 1));
    draw_lines(drawing, network, kind);
    drawing.end();
  }
  const bool sourced = result && has_property(*result, property::source_face);
  if (asked("polygons") || asked("edge-kinds") || (layers.empty() && sourced)) {
    if (!result) throw InvalidInput("polygons are of a result, and none was given");
    draw_polygons(drawing, *result, asked("edge-kinds"), mesh.n_faces());
  }
  if (wanted("samples")) {
    drawing.begin("samples", "stroke=\"none\"");
    for (size_t i = 0; i < network.isotropic_samples.size(); ++i)
      drawing.dot(
          drawing.at(network.isotropic_samples[i].face.idx(), network.isotropic_samples[i].barycentric), 2,
          "#000000", static_cast<int>(i));
    drawing.end();
  }
  if (wanted("umbilics") && has_property(mesh, property::umbilic)) {
    drawing.begin("umbilics", stroke("#000000", 1));
    draw_umbilics(drawing, mesh);
    drawing.end();
  }
  return drawing.svg();
}

}  // namespace view
