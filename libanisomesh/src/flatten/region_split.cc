#include "flatten/region_split.hh"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "surface/surface_normals.hh"

namespace anisomesh::detail {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

class Splitter {
 public:
  Splitter(const SurfaceRef& surface, const FaceSides& sides, const FaceShapes& shapes, const Region& region,
           double crease_weight)
      : surface_(surface), sides_(sides), shapes_(shapes), faces_(region.faces) {
    double area = 0;
    for (const int f : faces_) area += shapes.area[static_cast<size_t>(f)];
    radian_ = crease_weight * std::sqrt(area);
    link();
  }

  // The part of each face: 0 or 1.
  std::vector<int> run() {
    grow({0});
    const int first = farthest();
    grow({first});
    const int second = farthest();
    grow({first, second == first ? (first + 1) % static_cast<int>(faces_.size()) : second});
    straighten();
    return part_;
  }

 private:
  struct Link {
    int place = -1;
    double length = 0;
  };

  void link();
  void grow(const std::vector<int>& seeds);
  int farthest() const;
  void straighten();

  const SurfaceRef& surface_;
  const FaceSides& sides_;
  const FaceShapes& shapes_;
  const std::vector<int>& faces_;
  double radian_ = 0;  // what a turn by one radian adds to a length
  std::vector<Link> links_;
  std::vector<double> distance_;
  std::vector<int> part_;
};

void Splitter::link() {
  links_.resize(3 * faces_.size());
  for (size_t k = 0; k < faces_.size(); ++k)
    for (int i = 0; i < 3; ++i) {
      const auto side = 3 * static_cast<size_t>(faces_[k]) + static_cast<size_t>(i);
      const int twin = sides_.twin[side];
      if (twin < 0 || sides_.feature[side]) continue;
      const int other = place_among(faces_, twin / 3);
      if (other < 0) continue;
      const auto f = static_cast<size_t>(faces_[k]), g = static_cast<size_t>(twin / 3);
      const Vec3d middle =
          0.5 * (surface_.point(OpenMesh::VertexHandle(sides_.vertex[side])) +
                 surface_.point(OpenMesh::VertexHandle(sides_.vertex[static_cast<size_t>(twin)])));
      const Vec3d &m = shapes_.normal[f], &n = shapes_.normal[g];
      links_[3 * k + static_cast<size_t>(i)] = {other, (shapes_.centre[f] - middle).norm() +
                                                           (shapes_.centre[g] - middle).norm() +
                                                           radian_ * std::atan2((m % n).norm(), m | n)};
    }
}

void Splitter::grow(const std::vector<int>& seeds) {
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  distance_.assign(faces_.size(), kFar);
  part_.assign(faces_.size(), 0);
  for (size_t s = 0; s < seeds.size(); ++s) {
    distance_[static_cast<size_t>(seeds[s])] = 0;
    part_[static_cast<size_t>(seeds[s])] = static_cast<int>(s);
    queue.emplace(0.0, seeds[s]);
  }
  while (!queue.empty()) {
    const auto [distance, k] = queue.top();
    queue.pop();
    if (distance > distance_[static_cast<size_t>(k)]) continue;
    for (size_t i = 0; i < 3; ++i) {
      const Link& link = links_[3 * static_cast<size_t>(k) + i];
      if (link.place < 0) continue;
      const auto to = static_cast<size_t>(link.place);
      if (distance + link.length >= distance_[to]) continue;
      distance_[to] = distance + link.length;
      part_[to] = part_[static_cast<size_t>(k)];
      queue.emplace(distance_[to], link.place);
    }
  }
}

int Splitter::farthest() const {
  size_t best = 0;
  for (size_t k = 0; k < distance_.size(); ++k)
    if (distance_[k] != kFar && distance_[k] > distance_[best]) best = k;
  return static_cast<int>(best);
}

// A face with two neighbours beyond the line changes over. It hung on one edge, so that nothing comes apart.
void Splitter::straighten() {
  constexpr int kSweeps = 3;
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (size_t k = 0; k < faces_.size(); ++k) {
      int beyond = 0, beside = 0;
      for (size_t i = 0; i < 3; ++i) {
        const int other = links_[3 * k + i].place;
        if (other >= 0) ++(part_[static_cast<size_t>(other)] == part_[k] ? beside : beyond);
      }
      if (beyond == 2 && beside == 1) part_[k] = 1 - part_[k];
    }
}

}  // namespace

FaceShapes::FaceShapes(const SurfaceRef& surface) {
  const SurfaceNormals normals(surface);
  for (const auto f : surface.connectivity().all_faces()) {
    const SurfacePoint middle{f, {1.0 / 3, 1.0 / 3, 1.0 / 3}};
    const auto c = surface.corners(f);
    const Vec3d& p = surface.point(c.vertex[0]);
    centre.push_back(position(surface, middle));
    normal.push_back(normals.at(middle));
    area.push_back(0.5 * ((surface.point(c.vertex[1]) - p) % (surface.point(c.vertex[2]) - p)).norm());
  }
}

std::vector<Region> connected_regions(const FaceSides& sides, const std::vector<int>& faces) {
  std::vector<Region> regions;
  std::vector<char> seen(faces.size(), 0);
  std::vector<size_t> open;
  for (size_t start = 0; start < faces.size(); ++start) {
    if (seen[start]) continue;
    Region region;
    open.assign(1, start);
    seen[start] = 1;
    while (!open.empty()) {
      const size_t k = open.back();
      open.pop_back();
      region.faces.push_back(faces[k]);
      for (int i = 0; i < 3; ++i) {
        const auto side = 3 * static_cast<size_t>(faces[k]) + static_cast<size_t>(i);
        if (sides.twin[side] < 0 || sides.feature[side]) continue;
        const int other = place_among(faces, sides.twin[side] / 3);
        if (other < 0 || seen[static_cast<size_t>(other)]) continue;
        seen[static_cast<size_t>(other)] = 1;
        open.push_back(static_cast<size_t>(other));
      }
    }
    std::sort(region.faces.begin(), region.faces.end());
    regions.push_back(std::move(region));
  }
  return regions;
}

std::vector<Region> split_region(const SurfaceRef& surface, const FaceSides& sides, const FaceShapes& shapes,
                                 const Region& region, double crease_weight) {
  const auto part = Splitter(surface, sides, shapes, region, crease_weight).run();
  std::vector<Region> parts;
  for (const int which : {0, 1}) {
    std::vector<int> faces;
    for (size_t k = 0; k < part.size(); ++k)
      if (part[k] == which) faces.push_back(region.faces[k]);
    for (Region& piece : connected_regions(sides, faces)) parts.push_back(std::move(piece));
  }
  return parts;
}

}  // namespace anisomesh::detail
