// anisomesh-view: a page to look at, pictures without a display, drawings of the plane.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "anisomesh/io.hh"
#include "anisomesh/properties.hh"
#include "support/command.hh"
#include "support/reports.hh"
#include "view/picture.hh"
#include "view/plane_svg.hh"
#include "view/report.hh"

namespace {

using namespace anisomesh;

struct Arguments {
  std::vector<std::string> files, tables, layers;
  std::string page, png, svg, view, up, at, size = "1200x900";
  double zoom = 1;
  size_t samples = CompareOptions().samples;
};

/// What came from build_polygons(), has a face that is no triangle, or follows a surface without curvature is
/// a result; everything else is an input with what the stages left on it.
bool is_result(const OpenMesh::PolyMesh& mesh, bool follows_surface) {
  if (has_property(mesh, property::edge_kind) || has_property(mesh, property::origin)) return true;
  if (has_property(mesh, property::k_min) || has_property(mesh, property::uv)) return false;
  for (const auto f : mesh.faces())
    if (mesh.valence(f) != 3) return true;
  return follows_surface;
}

view::Meshes read_all(apps::Command& command, const std::vector<std::string>& files) {
  view::Meshes meshes;
  for (const auto& file : files) {
    const std::string name = std::filesystem::path(file).filename().string();
    auto mesh = read_polygons(file);
    if (is_result(mesh, !meshes.surfaces.empty()))
      meshes.results.push_back({name, std::move(mesh)});
    else
      meshes.surfaces.push_back({name, apps::read_surface(command, file)});
    command.stop_if_cancelled();
  }
  return meshes;
}

view::Table read_table(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw InvalidInput(file + ": cannot be read");
  auto json = apps::Json::parse(in, nullptr, false);
  if (!json.is_object())
    throw InvalidInput(file + ": is no report; --table takes what an app wrote with --json");
  return {std::filesystem::path(file).filename().string(), std::move(json)};
}

void add_options(CLI::App& app, Arguments& a) {
  app.add_option(
         "files", a.files,
         "Surfaces with what the stages left on them (.om), results (.om, .obj, ...): .obj, .off, .ply, "
         ".stl or .om")
      ->required()
      ->type_name("FILE");
  app.add_option("-o,--output", a.page, "Write a self-contained page, .html")
      ->type_name("FILE")
      ->group("Output");
  app.add_option("--png", a.png, "Write a picture; needs Chromium")->type_name("FILE")->group("Output");
  app.add_option("--svg", a.svg, "Write a drawing of the (u, v) plane")->type_name("FILE")->group("Output");
  app.add_option("--table", a.tables, "Show this report (--json of another app) in the page too")
      ->type_name("FILE")
      ->group("Output");
  std::string names;
  for (const auto& layer : view::layers()) names += (names.empty() ? "" : ", ") + std::string(layer.name);
  app.add_option("--layer", a.layers, "Show this and nothing else; may be repeated: " + names)
      ->type_name("NAME")
      ->group("Picture")
      ->allow_extra_args(false);
  app.add_option("--size", a.size, "Of the picture, WIDTHxHEIGHT in pixels")
      ->type_name("WxH")
      ->group("Picture");
  app.add_option(
         "--view", a.view,
         "Where to look from: front, back, left, right, top, bottom, corner, or x,y,z; by default the "
         "side that shows most")
      ->type_name("DIR")
      ->group("Picture");
  app.add_option("--up", a.up, "What is up, x,y,z or one of the names")->type_name("DIR")->group("Picture");
  app.add_option("--zoom", a.zoom, "So many times as large as what shows everything, > 0")
      ->type_name("F")
      ->group("Picture");
  app.add_option("--at", a.at, "What is in the middle, x,y,z; by default the middle of everything")
      ->type_name("POINT")
      ->group("Picture");
  app.add_option("--samples", a.samples, "Points that a result is measured with, >= 1000")
      ->type_name("N")
      ->group("Measuring");
}

view::Scene scene_of(const Arguments& a) {
  view::Scene scene;
  scene.layers = a.layers;
  if (!a.view.empty()) scene.eye = view::direction_from("--view", a.view);
  if (!a.up.empty()) scene.up = view::direction_from("--up", a.up);
  if (!a.at.empty()) scene.middle = view::point_from("--at", a.at);
  if (!(a.zoom > 0 && a.zoom <= 1e4))
    throw InvalidOption("--zoom must be above 0 and at most 10000, but is " + std::to_string(a.zoom));
  scene.zoom = a.zoom;
  return scene;
}

std::string title_of(const Arguments& a) {
  std::string title;
  for (const auto& file : a.files)
    title += (title.empty() ? "" : ", ") + std::filesystem::path(file).filename().string();
  return title;
}

bool asks_for(const Arguments& a, const char* layer) {
  return std::find(a.layers.begin(), a.layers.end(), layer) != a.layers.end();
}

/// Everything that can be refused is, before the work begins.
void check(const Arguments& a) {
  if (a.page.empty() && a.png.empty() && a.svg.empty())
    throw InvalidOption("nothing to write: give -o PAGE.html, --png PICTURE.png or --svg DRAWING.svg");
  view::require_ending(a.page, {".html", ".htm"});
  view::require_ending(a.png, {".png"});
  view::require_ending(a.svg, {".svg"});
  for (const auto& path : {a.page, a.png})
    if (!path.empty()) view::require_page(path);
  if (!a.svg.empty()) require_writable(a.svg);
  view::size_from(a.size);
  if (!a.png.empty()) view::find_chromium();
}

}  // namespace

int main(int argc, char* argv[]) {
  apps::Command command("anisomesh-view",
                        "Shows a surface, what the stages found on it, and results: as one page that needs "
                        "nothing else, as a picture, or as a drawing of the plane.");
  Arguments a;
  add_options(command.arguments(), a);
  return command.run(argc, argv, [&] {
    check(a);
    CompareOptions compare;
    compare.samples = a.samples;
    compare.validate();
    auto scene = scene_of(a);
    std::vector<view::Table> tables;
    for (const auto& file : a.tables) tables.push_back(read_table(file));
    auto meshes = read_all(command, a.files);
    if (!a.page.empty() || asks_for(a, "error")) {
      auto figures = view::compare_all(meshes, compare, command.progress("comparing"));
      tables.insert(tables.begin(), figures.begin(), figures.end());
    }
    for (const auto& layer : a.layers) view::require_layer(layer, meshes.shown());
    if (!a.svg.empty()) {
      if (meshes.surfaces.empty()) throw InvalidInput("--svg draws an input surface, and none was given");
      auto& surface = meshes.surfaces.back();
      if (!has_property(surface.mesh, property::uv)) view::require_layer("plane", meshes.shown());
      const auto* result = meshes.results.empty() ? nullptr : &meshes.results.front().mesh;
      write_text(view::plane_svg(surface.mesh, result, a.layers), a.svg);
      command.say(a.svg + ": the plane of " + surface.name);
    }
    if (!a.page.empty()) {
      write_text(view::make_report(title_of(a), meshes, tables, scene), a.page);
      command.say(a.page + ": open it in a browser");
    }
    if (!a.png.empty()) {
      scene.picture = view::size_from(a.size);
      const auto page = view::make_report(title_of(a), meshes, {}, scene);
      write_text(view::draw_picture(view::find_chromium(), page, [&] { return command.cancelled(); }), a.png);
      command.say(a.png + ": " + a.size);
    }
  });
}
