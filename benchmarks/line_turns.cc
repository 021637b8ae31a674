// Where lines of curvature turn sharply: hooks, seen on foreheads.
//
//   line_turns MESH FACES
//
// A piece of a line is hooked where the line turns by more than 60 degrees within half a spacing on either
// side. Prints the share of the length that is, how many lines and ends have such a piece (ends: within 1.5
// spacings), and the share of all length and of hooked length that is near an umbilic.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <vector>

#include "anisomesh/io.hh"
#include "anisomesh/lines.hh"
#include "anisomesh/remesh.hh"
#include "lines/make_domain.hh"

using namespace anisomesh;

namespace {

constexpr double hook = M_PI / 3, near_end = 1.5;
constexpr std::array<double, 3> near_umbilic = {1, 2, 3};  // spacings

struct Turns {
  size_t lines = 0, hooked_lines = 0, ends = 0, hooked_ends = 0;
  double length = 0, hooked_length = 0;
  std::array<double, 3> length_near{}, hooked_near{};
};

/// The angle from one step to the next in the tangent plane of a face.
double turning(const SurfaceRef& surface, OpenMesh::FaceHandle face, Vec3d a, Vec3d b) {
  const auto corners = surface.corners(face);
  const Vec3d origin = surface.point(corners.vertex[0]);
  const Vec3d normal =
      ((surface.point(corners.vertex[1]) - origin) % (surface.point(corners.vertex[2]) - origin))
          .normalized();
  a -= normal * (a | normal);
  b -= normal * (b | normal);
  return std::atan2(normal | (a % b), a | b);
}

class Course {
 public:
  Course(const SurfaceRef& surface, const detail::FaceDomain& domain, const Line& line) {
    for (const SurfacePoint& point : line.points) places_.push_back(position(surface, point));
    arc_.assign(size(), 0);
    turned_.assign(size(), 0);
    for (size_t i = 1; i < size(); ++i) {
      const SurfacePoint& point = line.points[i];
      spacing_.push_back(domain.spacing(line.kind, point));
      arc_[i] = arc_[i - 1] + length(i) / spacing_.back();
      turned_[i] = turned_[i - 1];
      if (i >= 2)
        turned_[i] += turning(surface, line.points[i - 1].face, places_[i - 1] - places_[i - 2],
                              places_[i] - places_[i - 1]);
    }
  }
  size_t size() const { return places_.size(); }
  /// Of the piece from point i - 1 to point i.
  double length(size_t i) const { return (places_[i] - places_[i - 1]).norm(); }
  double spacing(size_t i) const { return spacing_[i - 1]; }
  const Vec3d& place(size_t i) const { return places_[i]; }
  bool is_at_begin(size_t i) const { return arc_[i - 1] < near_end; }
  bool is_at_end(size_t i) const { return arc_.back() - arc_[i] < near_end; }
  bool is_hooked(size_t i) const {
    const double middle = 0.5 * (arc_[i] + arc_[i - 1]);
    size_t first = i, last = i;
    while (first > 1 && middle - arc_[first - 1] < 0.5) --first;
    while (last + 1 < size() && arc_[last] - middle < 0.5) ++last;
    return std::abs(turned_[last] - turned_[first]) > hook;
  }

 private:
  std::vector<Vec3d> places_;
  std::vector<double> spacing_, arc_, turned_;
};

void add(Turns& turns, const Course& course, bool closed, const std::vector<Vec3d>& umbilics) {
  bool any = false, begin = false, end = false;
  for (size_t i = 1; i < course.size(); ++i) {
    const double length = course.length(i);
    const bool hooked = course.is_hooked(i);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3d& umbilic : umbilics) nearest = std::min(nearest, (umbilic - course.place(i)).norm());
    turns.length += length;
    for (size_t k = 0; k < near_umbilic.size(); ++k)
      if (nearest < near_umbilic[k] * course.spacing(i)) {
        turns.length_near[k] += length;
        if (hooked) turns.hooked_near[k] += length;
      }
    if (!hooked) continue;
    turns.hooked_length += length;
    any = true;
    begin = begin || course.is_at_begin(i);
    end = end || course.is_at_end(i);
  }
  ++turns.lines;
  turns.hooked_lines += any ? 1 : 0;
  if (closed) return;
  turns.ends += 2;
  turns.hooked_ends += (begin ? 1u : 0u) + (end ? 1u : 0u);
}

void print(const char* kind, const Turns& turns) {
  std::printf("%s lines: %zu of %zu are hooked, %zu of %zu ends, %.1f %% of the length\n", kind,
              turns.hooked_lines, turns.lines, turns.hooked_ends, turns.ends,
              100 * turns.hooked_length / turns.length);
  for (size_t k = 0; k < near_umbilic.size(); ++k)
    std::printf("  within %g spacings of an umbilic: %.0f %% of hooked length, %.0f %% of all\n",
                near_umbilic[k], 100 * turns.hooked_near[k] / turns.hooked_length,
                100 * turns.length_near[k] / turns.length);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "line_turns MESH FACES\n"), 2;
  auto mesh = read_surface(argv[1]);
  RemeshOptions options;
  options.fit.enabled = false;
  options.target_faces = static_cast<size_t>(std::atol(argv[2]));
  RemeshReport report;
  remesh(mesh, options, &report);

  const SurfaceRef surface(mesh);
  options.trace.density.epsilon_fraction = report.epsilon_fraction;
  const auto domain = detail::make_domain(surface, options.trace.density);
  std::vector<Vec3d> umbilics;
  for (const auto& umbilic : domain->umbilics()) umbilics.push_back(position(surface, umbilic.point));
  std::array<Turns, 2> turns;
  for (const Line& line : read_lines(surface).lines)
    add(turns[static_cast<size_t>(line.kind)], Course(surface, *domain, line), line.closed, umbilics);
  print("min", turns[0]);
  print("max", turns[1]);
  return 0;
}
