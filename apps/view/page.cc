#include "view/page.hh"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "anisomesh/errors.hh"
#include "anisomesh/io.hh"
#include "support/command.hh"
#include "view/template.hh"

namespace view {

using apps::Json;

namespace {

/// JSON that cannot end the script element it stands in.
std::string for_script(const Json& json) {
  std::string out;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '&')
      out += "&amp;";
    else
      out += c;
  }
  return out;
}

/// Three finite numbers with commas between them, and nothing else.
bool read_point(const std::string& text, std::array<double, 3>& point) {
  int used = 0;
  return std::sscanf(text.c_str(), "%lf,%lf,%lf%n", &point[0], &point[1], &point[2], &used) == 3 &&
         static_cast<size_t>(used) == text.size() && std::isfinite(std::hypot(point[0], point[1], point[2]));
}

}  // namespace

bool have_page() { return !page_template().empty(); }

void require_ending(const std::string& path, const std::vector<std::string>& endings) {
  const std::string ending = apps::ending_of(path);
  if (ending.empty() || std::find(endings.begin(), endings.end(), ending) != endings.end()) return;
  throw anisomesh::InvalidInput(path + ": unknown ending '" + ending + "'; use " + endings.front());
}

void require_page(const std::string& path) {
  if (!have_page()) make_page("", {}, {}, {});
  anisomesh::require_writable(path);
}

std::string make_page(const std::string& title, const Frame& frame, const std::vector<Model>& models,
                      const std::vector<Table>& tables, const Scene& scene) {
  if (!have_page())
    throw anisomesh::CannotProcess(
        "this build has no viewer page; install npm and configure with -D ANISOMESH_VIEW=ON");
  Json header = {{"title", title},          {"centre", {frame.centre[0], frame.centre[1], frame.centre[2]}},
                 {"scale", frame.scale},    {"models", Json::array()},
                 {"tables", Json::array()}, {"layers", scene.layers}};
  if (scene.eye) header["eye"] = *scene.eye;
  if (scene.up) header["up"] = *scene.up;
  if (scene.middle) header["middle"] = *scene.middle;
  header["zoom"] = scene.zoom;
  if (scene.picture) header["picture"] = *scene.picture;
  std::string data;
  size_t count = 0;
  for (const auto& model : models) {
    Json json = {
        {"role", model.role}, {"name", model.name}, {"numbers", model.numbers}, {"arrays", Json::object()}};
    for (const auto& [key, section] : model.sections) {
      const std::string id = "data-" + std::to_string(count++);
      json["arrays"][key] = {{"id", id}, {"type", section.type}, {"components", section.components}};
      data += "<script type=\"application/octet-stream\" id=\"" + id + "\">" + section.base64 + "</script>\n";
    }
    header["models"].push_back(std::move(json));
  }
  for (const auto& table : tables) header["tables"].push_back({{"title", table.title}, {"rows", table.rows}});
  data += "<script type=\"application/json\" id=\"header\">" + for_script(header) + "</script>\n";

  std::string page(page_template());
  const auto replace = [&](const std::string& mark, const std::string& text) {
    const size_t at = page.find(mark);
    if (at != std::string::npos) page.replace(at, mark.size(), text);
  };
  replace("<!--data-->", data);
  replace("<!--title-->", escaped(title));
  return page;
}

std::array<double, 3> direction_from(const std::string& option, const std::string& text) {
  static const std::map<std::string, std::array<double, 3>> names = {
      {"front", {0, 0, 1}}, {"back", {0, 0, -1}},   {"left", {-1, 0, 0}}, {"right", {1, 0, 0}},
      {"top", {0, 1, 0}},   {"bottom", {0, -1, 0}}, {"corner", {1, 1, 1}}};
  const auto name = names.find(text);
  if (name != names.end()) return name->second;
  std::array<double, 3> eye{};
  if (!read_point(text, eye) || !(std::hypot(eye[0], eye[1], eye[2]) > 0))
    throw anisomesh::InvalidOption(
        option + " takes front, back, left, right, top, bottom, corner or x,y,z, not '" + text + "'");
  return eye;
}

std::array<double, 3> point_from(const std::string& option, const std::string& text) {
  std::array<double, 3> point{};
  if (!read_point(text, point)) throw anisomesh::InvalidOption(option + " takes x,y,z, not '" + text + "'");
  return point;
}

std::array<int, 2> size_from(const std::string& text) {
  std::array<int, 2> size{};
  int used = 0;
  constexpr int least = 64, most = 8192;
  const bool read = std::sscanf(text.c_str(), "%dx%d%n", &size[0], &size[1], &used) == 2 &&
                    static_cast<size_t>(used) == text.size();
  if (read && size[0] >= least && size[1] >= least && size[0] <= most && size[1] <= most) return size;
  throw anisomesh::InvalidOption("--size takes WIDTHxHEIGHT, each from 64 to 8192, not '" + text + "'");
}

}  // namespace view
