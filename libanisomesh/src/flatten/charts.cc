#include "anisomesh/charts.hh"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "anisomesh/errors.hh"
#include "anisomesh/properties.hh"
#include "flatten/chart_patch.hh"
#include "flatten/patch_map.hh"
#include "flatten/region_split.hh"
#include "surface/canonical_copy.hh"
#include "surface/cut_surface.hh"

namespace anisomesh {

namespace {

using namespace detail;

struct Chart {
  Region region;
  std::vector<std::array<Vec2d, 3>> uv;  // of the corners of each face
  FlattenReport flatten;
  double area = 0;
};

// A triangle laid out by its edge lengths; one without an inside gets a little of it.
std::array<Vec2d, 3> lone_triangle(const Patch& patch) {
  const auto shape = triangle_shapes(patch).front();
  const double a = (patch.points[1] - patch.points[0]).norm();
  const double base = a > 0 ? a : std::max((patch.points[2] - patch.points[0]).norm(), 1e-300);
  const double b = base * std::sin(shape.angle[1]) / std::sin(shape.angle[2]);
  return {Vec2d(0, 0), Vec2d(base, 0), Vec2d(b * std::cos(shape.angle[0]), b * std::sin(shape.angle[0]))};
}

class Atlas {
 public:
  Atlas(const SurfaceRef& surface, const ChartOptions& options)
      : surface_(surface), options_(options), sides_(surface), shapes_(surface) {}

  std::vector<Chart> make(const Progress& progress);
  const FaceSides& sides() const { return sides_; }

 private:
  std::vector<Region> first_regions() const;
  std::optional<Chart> flattened(const Region& region) const;
  std::optional<Chart> flattened(const Region& region, const ChartPatch& patch) const;

  const SurfaceRef& surface_;
  const ChartOptions& options_;
  FaceSides sides_;
  FaceShapes shapes_;
};

// What features bound; or the charts that are there, where these are kept.
std::vector<Region> Atlas::first_regions() const {
  const auto& mesh = surface_.connectivity();
  std::map<int, std::vector<int>> faces;
  if (options_.keep_charts) {
    const auto chart = require_property(mesh, property::chart);
    for (const auto f : mesh.all_faces()) faces[mesh.property(chart, f)].push_back(f.idx());
  } else {
    for (const auto f : mesh.all_faces()) faces[0].push_back(f.idx());
  }
  std::vector<Region> regions;
  for (const auto& entry : faces)
    for (Region& region : connected_regions(sides_, entry.second)) regions.push_back(std::move(region));
  return regions;
}

std::optional<Chart> Atlas::flattened(const Region& region, const ChartPatch& patch) const {
  Chart chart;
  chart.region = region;
  for (const int f : region.faces) chart.area += shapes_.area[static_cast<size_t>(f)];
  if (region.faces.size() == 1) {
    chart.uv.push_back(lone_triangle(patch.patch));
    return chart;
  }
  if (!patch.is_disc()) return std::nullopt;
  try {
    auto map = free_map(patch.patch, chart.flatten);
    if (!map) return std::nullopt;
    normalize(patch.patch, *map);
    const auto faces = jacobians(patch.patch, *map);
    measure(faces, area_stretches(patch.patch, faces), chart.flatten);
    const double bound = options_.max_area_stretch;
    if (!(chart.flatten.min_area_stretch * bound >= 1 && chart.flatten.max_area_stretch <= bound))
      return std::nullopt;
    for (const auto& t : patch.patch.triangles)
      chart.uv.push_back({(*map)[static_cast<size_t>(t[0])], (*map)[static_cast<size_t>(t[1])],
                          (*map)[static_cast<size_t>(t[2])]});
  } catch (const SolverFailure&) {
    return std::nullopt;
  }
  return chart;
}

// A tube is slit open along its side before it is cut across.
std::optional<Chart> Atlas::flattened(const Region& region) const {
  const ChartPatch patch(surface_, sides_, region);
  if (patch.loops.size() != 2 || patch.euler != 0) return flattened(region, patch);
  Region slit = region;
  slit.slits = shortest_slit(sides_, region, patch);
  return flattened(slit, ChartPatch(surface_, sides_, slit));
}

std::vector<Chart> Atlas::make(const Progress& progress) {
  std::vector<Chart> charts;
  std::vector<Region> open = first_regions();
  size_t done = 0;
  while (!open.empty()) {
    const Region region = std::move(open.back());
    open.pop_back();
    report_progress(progress,
                    static_cast<double>(done) / static_cast<double>(surface_.connectivity().n_faces()));
    if (auto chart = flattened(region)) {
      done += region.faces.size();
      charts.push_back(std::move(*chart));
      continue;
    }
    for (Region& part : split_region(surface_, sides_, shapes_, region, options_.crease_weight))
      open.push_back(std::move(part));
  }
  std::sort(charts.begin(), charts.end(),
            [](const Chart& a, const Chart& b) { return a.region.faces.front() < b.region.faces.front(); });
  return charts;
}

ChartReport summary(const std::vector<Chart>& charts) {
  ChartReport report;
  report.charts = charts.size();
  double sum = 0, area = 0;
  for (const Chart& chart : charts) {
    report.max_area_stretch = std::max(
        {report.max_area_stretch, chart.flatten.max_area_stretch, 1 / chart.flatten.min_area_stretch});
    report.repaired_triangles += chart.flatten.repaired_triangles;
    report.single_triangles += chart.region.faces.size() == 1 ? 1 : 0;
    sum += chart.area * chart.flatten.mean_conformal_distortion;
    area += chart.area;
  }
  if (area > 0) report.mean_conformal_distortion = sum / area;
  return report;
}

void write_charts(const SurfaceRef& surface, const std::vector<Chart>& charts) {
  auto& mesh = surface.connectivity();
  const auto number = provide_property(mesh, property::chart);
  const auto uv = provide_property(mesh, property::chart_uv);
  for (const auto h : mesh.all_halfedges())
    if (h.is_boundary()) mesh.property(uv, h) = Vec2d(0, 0);
  for (size_t c = 0; c < charts.size(); ++c)
    for (size_t k = 0; k < charts[c].region.faces.size(); ++k) {
      const OpenMesh::FaceHandle face(charts[c].region.faces[k]);
      mesh.property(number, face) = static_cast<int>(c);
      auto h = mesh.halfedge_handle(face);  // to corner 0
      for (const Vec2d& corner : charts[c].uv[k]) {
        mesh.property(uv, h) = corner;
        h = mesh.next_halfedge_handle(h);
      }
    }
}

}  // namespace

void ChartOptions::validate() const {
  if (!(max_area_stretch > 1) || !std::isfinite(max_area_stretch))
    throw InvalidOption("max_area_stretch of charts is " + std::to_string(max_area_stretch) +
                        ", must be finite and above 1");
  if (!(crease_weight >= 0) || !std::isfinite(crease_weight))
    throw InvalidOption("crease_weight of charts is " + std::to_string(crease_weight) +
                        ", must be finite and at least 0");
}

ChartReport cut_into_charts(const SurfaceRef& surface, const ChartOptions& options,
                            const Progress& progress) {
  if (!surface.canonical_copy())
    return detail::in_canonical_order(
        surface, [&](const SurfaceRef& ordered) { return cut_into_charts(ordered, options, progress); });
  const auto start = std::chrono::steady_clock::now();
  options.validate();
  report_progress(progress, 0);
  const auto charts = Atlas(surface, options).make(progress);
  report_progress(progress, 1);
  ChartReport report = summary(charts);
  write_charts(surface, charts);
  const auto& mesh = surface.connectivity();
  for (const auto e : mesh.all_edges())
    if (!is_feature(mesh, e) && is_seam(surface, e)) {
      ++report.seam_edges;
      report.seam_length += (surface.point(e.v0()) - surface.point(e.v1())).norm();
    }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

bool has_charts(const SurfaceRef& surface) {
  const auto& mesh = surface.connectivity();
  return has_property(mesh, property::chart_uv) && !has_property(mesh, property::uv);
}

void discard_charts(const SurfaceRef& surface) {
  auto& mesh = surface.connectivity();
  if (!has_property(mesh, property::chart_uv)) return;
  auto handle = require_property(mesh, property::chart_uv);
  mesh.remove_property(handle);
}

bool is_seam(const SurfaceRef& surface, OpenMesh::EdgeHandle edge) {
  const auto& mesh = surface.connectivity();
  const auto number = require_property(mesh, property::chart);
  const auto uv = require_property(mesh, property::chart_uv);
  if (mesh.is_boundary(edge)) return false;
  const auto h = mesh.halfedge_handle(edge, 0), o = mesh.halfedge_handle(edge, 1);
  if (mesh.property(number, mesh.face_handle(h)) != mesh.property(number, mesh.face_handle(o))) return true;
  return mesh.property(uv, h) != mesh.property(uv, mesh.prev_halfedge_handle(o)) ||
         mesh.property(uv, o) != mesh.property(uv, mesh.prev_halfedge_handle(h));
}

}  // namespace anisomesh
