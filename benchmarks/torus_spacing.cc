// How many of the gaps between lines of curvature on the half torus (R = 1, r = 0.4) are within 25 % of what
// equation 6 asks for, and how many could be.
//
//   torus_spacing [--regular] [--epsilon E] [--max-slope S] [--stop-fraction F] [--seed-fraction F]
//     [--relax-passes N]
//
// Lines of curvature are circles there, known exactly, and so is what equation 6, bounded as docs/density.md
// says, wants between two of them. By surface: the share of the area that lies in gaps of the right width; by
// line: each gap counts by its length along the lines. The ceiling is that of lines which only end where they
// come close, so that the lines at one place are a part of those at any place that wants more: of all ways to
// divide gaps, found by dynamic programming.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "anisomesh/flatten.hh"
#include "anisomesh/lines.hh"
#include "anisomesh/shapes.hh"
#include "anisomesh/smoothing.hh"
#include "anisomesh/umbilics.hh"
#include "bench.hh"
#include "half_torus.hh"

using namespace anisomesh;

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double slit = 170 * pi / 180;  // the tube of make_shape("half-torus") runs from -slit to slit
constexpr double tube_radius = 0.4, tolerance = 0.25;

double axis_distance(double tube) { return 1 + tube_radius * std::cos(tube); }

/// What is wanted between two circles at a place of the tube: by equation 6, as docs/density.md bounds it, or
/// graded, which is what lines are placed by.
class Wanted {
 public:
  /// \param max_slope of the graded spacing; infinite: equation 6
  Wanted(const Density& density, double max_slope) {
    for (int i = 0; i <= places; ++i) {
      const double tube = angle(i), k_min = std::cos(tube) / axis_distance(tube), k_max = 1 / tube_radius;
      spacing_[0].push_back(density.min_line_spacing(k_min, k_max));
      spacing_[1].push_back(density.max_line_spacing(k_min, k_max));
    }
    // Nothing changes along the axis: the slope is along the tube.
    const double most = max_slope * tube_radius * 2 * slit / places;
    for (auto& s : spacing_) {
      for (size_t i = 1; i < s.size(); ++i) s[i] = std::min(s[i], s[i - 1] + most);
      for (size_t i = s.size() - 1; i-- > 0;) s[i] = std::min(s[i], s[i + 1] + most);
    }
  }
  double operator()(LineKind kind, double tube) const {
    const double place = std::clamp((tube / slit + 1) / 2, 0.0, 1.0) * places;
    return spacing_[static_cast<int>(kind)][static_cast<size_t>(place + 0.5)];
  }

 private:
  static constexpr int places = 4000;
  static double angle(int i) { return slit * (2.0 * i / places - 1); }
  std::vector<double> spacing_[2];
};

/// Width of a gap over what is wanted.
double ratio(const Wanted& wanted, LineKind kind, double gap_angle, double tube) {
  const double radius = kind == LineKind::min ? tube_radius : axis_distance(tube);
  return 2 * radius * std::sin(gap_angle / 2) / wanted(kind, tube);
}

struct Share {
  double good = 0, all = 0;
  void add(bool is_good, double weight) {
    all += weight;
    if (is_good) good += weight;
  }
  double percent() const { return 100 * good / all; }
};

struct Shares {
  Share by_surface, by_line;
};

/// Crosses the lines of a kind at many levels of the other angle; border lines count as lines.
Shares measure(const std::vector<CircleArc>& arcs, LineKind kind, const Wanted& wanted) {
  const double begin = kind == LineKind::max ? -slit : 0, end = kind == LineKind::max ? slit : pi;
  const double low = kind == LineKind::max ? 0 : -slit, high = kind == LineKind::max ? pi : slit;
  constexpr int levels = 2000;
  Shares shares;
  for (int i = 0; i < levels; ++i) {
    const double level = begin + (end - begin) * (i + 0.5) / levels;
    std::vector<double> cuts{low, high};
    for (const CircleArc& arc : arcs)
      if (arc.from <= level && level <= arc.to) cuts.push_back(std::clamp(arc.at, low, high));
    std::sort(cuts.begin(), cuts.end());
    for (size_t j = 1; j < cuts.size(); ++j) {
      const double gap = cuts[j] - cuts[j - 1];
      const double tube = kind == LineKind::max ? level : 0.5 * (cuts[j] + cuts[j - 1]);
      const bool good = std::abs(ratio(wanted, kind, gap, tube) - 1) <= tolerance;
      shares.by_surface.add(good, gap * axis_distance(tube));
      shares.by_line.add(
          good, kind == LineKind::max ? tube_radius * slit * 2 / levels : axis_distance(tube) * pi / levels);
    }
  }
  return shares;
}

/// The best that gaps between max lines can do if lines only end towards where fewer are wanted: from the
/// place that wants fewest, gaps are divided on the way to where most are wanted, in any proportion.
class Ceiling {
 public:
  explicit Ceiling(const Wanted& wanted) : wanted_(wanted) {}

  double percent() {
    double best = 0, area = 0;
    for (int t = 0; t <= steps; ++t) area += axis_distance(slit * t / steps);
    for (int top = steps * 4 / 10; top <= steps * 7 / 10; top += steps / 100) {
      const auto inward = values(top, 0), outward = values(top + 1, steps);
      for (int g = 0; g < sizes; ++g)
        best = std::max(best, (inward[static_cast<size_t>(g)] + outward[static_cast<size_t>(g)]) / area);
    }
    return 100 * best;
  }

 private:
  static constexpr int steps = 600, octave = 48, sizes = 6 * octave;  // gaps from the whole of pi downward
  static double gap(int g) { return pi * std::exp2(-static_cast<double>(g) / octave); }

  /// For each size of a gap at step `from`: the good area up to step `to`, over the gap's angle.
  std::array<double, sizes> values(int from, int to) const {
    std::array<double, sizes> value{};
    const int step = from <= to ? 1 : -1;
    for (int t = to; t != from - step; t -= step) {
      const double tube = slit * t / steps;
      for (int g = sizes; g-- > 0;) {
        auto& here = value[static_cast<size_t>(g)];
        if (std::abs(ratio(wanted_, LineKind::max, gap(g), tube) - 1) <= tolerance)
          here += axis_distance(tube);
        here = std::max(here, divided(value, g));
      }
    }
    return value;
  }

  /// The best way to divide a gap in two: sizes between those of the table count by interpolation.
  static double divided(const std::array<double, sizes>& value, int g) {
    double best = 0;
    for (int larger = 1; larger <= octave && g + larger < sizes; ++larger) {
      const double share = std::exp2(-static_cast<double>(larger) / octave), rest = 1 - share;
      const double other = g - octave * std::log2(rest);
      const int below = static_cast<int>(other);
      if (below + 1 >= sizes) continue;
      const double t = other - below;
      best = std::max(best, share * value[static_cast<size_t>(g + larger)] +
                                rest * ((1 - t) * value[static_cast<size_t>(below)] +
                                        t * value[static_cast<size_t>(below) + 1]));
    }
    return best;
  }

  const Wanted& wanted_;
};

}  // namespace

int main(int argc, char** argv) {
  TraceOptions options;
  options.density.epsilon_fraction = 0.0015;
  bool irregular = true;
  for (int i = 1; i < argc; ++i) {
    const auto value = [&](const char* name) { return std::strcmp(argv[i], name) == 0 && i + 1 < argc; };
    if (std::strcmp(argv[i], "--regular") == 0) irregular = false;
    if (value("--epsilon")) options.density.epsilon_fraction = std::atof(argv[i + 1]);
    if (value("--max-slope")) options.density.max_slope = std::atof(argv[i + 1]);
    if (value("--stop-fraction")) options.stop_fraction = std::atof(argv[i + 1]);
    if (value("--relax-passes")) options.relax_passes = static_cast<size_t>(std::atoi(argv[i + 1]));
    if (value("--seed-fraction")) options.seed_fraction = std::atof(argv[i + 1]);
  }
  auto mesh = make_shape("half-torus", {20000, irregular});
  estimate_curvature(mesh);
  flatten(mesh);
  smooth_tensors(mesh);
  find_umbilics(mesh);
  trace_lines(mesh, options);
  const SurfaceRef surface = mesh;
  const Density density(options.density, surface.diagonal(), surface.extent(), 0);

  std::vector<CircleArc> arcs[2];
  for (const Line& line : read_lines(mesh).lines)
    arcs[static_cast<int>(line.kind)].push_back(circle_arc(surface, line));
  std::printf("| wanted by | lines | number | within 25 %%, by surface | by line |\n|---|---|---|---|---|\n");
  const double equation6 = std::numeric_limits<double>::infinity();
  for (const double slope : {equation6, options.density.max_slope}) {
    const Wanted wanted(density, slope);
    const char* name = slope == equation6 ? "equation 6" : "graded";
    Shares both;
    for (const LineKind kind : {LineKind::min, LineKind::max}) {
      const auto& of_kind = arcs[static_cast<int>(kind)];
      const Shares s = measure(of_kind, kind, wanted);
      std::printf("| %s | %s | %zu | %.1f %% | %.1f %% |\n", name, kind == LineKind::min ? "min" : "max",
                  of_kind.size(), s.by_surface.percent(), s.by_line.percent());
      both.by_line.good += s.by_line.good, both.by_line.all += s.by_line.all;
      // Each kind covers the whole surface.
      both.by_surface.good += s.by_surface.good / s.by_surface.all, both.by_surface.all += 1;
    }
    std::printf("| %s | both | %zu | %.1f %% | %.1f %% |\n", name, arcs[0].size() + arcs[1].size(),
                both.by_surface.percent(), both.by_line.percent());
    std::printf("| %s | max, ceiling | | %.1f %% | |\n", name, Ceiling(wanted).percent());
  }
  return 0;
}
