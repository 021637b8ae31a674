#include "mesher/more_care.hh"

#include <algorithm>
#include <cmath>
#include <set>

#include "numerics/bvh.hh"

namespace anisomesh::detail {

namespace {

using Polygon = std::vector<int>;
using OpenMesh::FaceHandle;
size_t at(int i) { return static_cast<size_t>(i); }

constexpr double around = 1.5;        // an unsound polygon: times its width
constexpr double beside = 0.25;       // of its width: so near to a place in it triangles are kept
constexpr int parts_of_side = 4;      // of each triangle of a polygon: in each of its parts there is a place
constexpr double least_width = 1e-9;  // of its diameter

double diameter_of(const std::vector<Vec3d>& corners) {
  double squared = 0;
  for (const Vec3d& p : corners)
    for (const Vec3d& q : corners) squared = std::max(squared, (p - q).sqrnorm());
  return std::sqrt(squared);
}

/// Twice the area over the diameter.
double width_of(const std::vector<Vec3d>& corners) {
  Vec3d area(0, 0, 0);
  for (size_t i = 2; i < corners.size(); ++i)
    area += cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  const double diameter = diameter_of(corners);
  return diameter > 0 ? std::max(area.norm() / diameter, least_width * diameter) : 0;
}

std::vector<Vec3d> corners_of(const Polygon& polygon, const NetworkGraph& network) {
  std::vector<Vec3d> result;
  for (const int n : polygon) result.push_back(network.positions[at(n)]);
  return result;
}

// What is around a polygon: as far from it as it is wide, but for slivers, so that one along a whole side of
// a part does not concern all of it; these farther each time they are met.
class Surroundings {
 public:
  Surroundings(const Polygon& polygon, const NetworkGraph& network, double least_reach)
      : corners_(corners_of(polygon, network)) {
    for (const Vec3d& p : corners_) middle_ += p / static_cast<double>(corners_.size());
    for (const Vec3d& p : corners_) radius_ = std::max(radius_, (p - middle_).norm());
    const double diameter = diameter_of(corners_);
    reach_ = around * std::min(diameter, std::max(width_of(corners_), least_reach * diameter));
  }

  bool include(const Vec3d& place) const {
    if ((place - middle_).norm() > radius_ + reach_) return false;
    for (size_t i = 1; i + 1 < corners_.size(); ++i) {
      const Vec3d &a = corners_[0], &b = corners_[i], &c = corners_[i + 1];
      const Vec3d w = closest_barycentric(place, a, b, c);
      if ((w[0] * a + w[1] * b + w[2] * c - place).norm() <= reach_) return true;
    }
    return false;
  }

 private:
  std::vector<Vec3d> corners_;
  Vec3d middle_{0, 0, 0};
  double radius_ = 0, reach_ = 0;
};

/// In the middle of each of the small triangles that those of a polygon, as a fan, are parted into.
std::vector<Vec3d> places_in(const std::vector<Vec3d>& corners) {
  std::vector<Vec3d> places;
  const double n = parts_of_side;
  for (size_t i = 2; i < corners.size(); ++i)
    for (int a = 0; a < parts_of_side; ++a)
      for (int b = 0; a + b < parts_of_side; ++b)
        for (const double third : {1.0 / 3, 2.0 / 3}) {
          const double u = (a + third) / n, v = (b + third) / n;
          if (u + v < 1) places.push_back((1 - u - v) * corners[0] + u * corners[i - 1] + v * corners[i]);
        }
  return places;
}

}  // namespace

void take_more_care(const std::vector<Polygon>& polygons, const NetworkGraph& network, size_t retries,
                    NetworkGraph& start) {
  if (retries >= patience)
    for (const auto& polygon : polygons)
      for (const int n : polygon)
        if (at(n) < start.fixed.size() && start.origins[at(n)] == Origin::isotropic) start.fixed[at(n)] = 0;
  if (start.share.empty()) start.share.assign(start.positions.size(), 1);
  std::vector<char> near(start.share.size(), 0);
  const double least_reach = std::ldexp(1.0, static_cast<int>(retries) - static_cast<int>(patience));
  for (const auto& polygon : polygons) {
    const Surroundings surroundings(polygon, network, least_reach);
    for (size_t n = 0; n < near.size(); ++n) near[n] |= surroundings.include(start.positions[n]);
  }
  for (size_t n = 0; n < near.size(); ++n)
    if (near[n]) start.share[n] /= 2;
}

bool keep_triangles_at(const std::vector<Polygon>& polygons, const NetworkGraph& network,
                       const SurfaceRef& surface, const SurfaceLocator& locator, std::vector<char>& kept) {
  const auto& mesh = surface.connectivity();
  kept.resize(mesh.n_faces(), 0);
  bool any = false;
  for (const Polygon& polygon : polygons) {
    const std::vector<Vec3d> corners = corners_of(polygon, network), places = places_in(corners);
    const double reach = beside * width_of(corners);
    std::vector<FaceHandle> found;
    std::set<int> seen;
    const auto find = [&](FaceHandle f) {
      if (f.is_valid() && seen.insert(f.idx()).second) found.push_back(f);
    };
    for (const int n : polygon)
      for (const auto v : mesh.fv_range(network.points[at(n)].face))
        for (const auto f : mesh.vf_range(v)) find(f);
    for (const Vec3d& place : places)
      find(locator.locate(network.graph.uv(polygon[0]), place, network.points[at(polygon[0])].face).face);
    for (size_t i = 0; i < found.size(); ++i) {
      const auto c = surface.corners(found[i]);
      const Vec3d &p = surface.point(c.vertex[0]), &q = surface.point(c.vertex[1]),
                  &r = surface.point(c.vertex[2]);
      const bool is_near = std::any_of(places.begin(), places.end(), [&](const Vec3d& place) {
        const Vec3d w = closest_barycentric(place, p, q, r);
        return (w[0] * p + w[1] * q + w[2] * r - place).norm() <= reach;
      });
      if (!is_near) continue;
      any |= !kept[at(found[i].idx())];
      kept[at(found[i].idx())] = 1;
      for (const auto f : mesh.ff_range(found[i])) find(f);
    }
  }
  return any;
}

}  // namespace anisomesh::detail
