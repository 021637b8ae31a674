#include "field/chart_field.hh"

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>

#include "anisomesh/properties.hh"
#include "numerics/tensor2d.hh"
#include "numerics/triangle_jacobian.hh"

namespace anisomesh::detail {

namespace {

using Turn = std::complex<double>;

Turn unit(const Turn& z) {
  const double length = std::abs(z);
  return length > 0 ? z / length : Turn(1);
}
Turn complex(const Vec2d& v) { return {v[0], v[1]}; }

// Turns the tensors of vertices into the planes of the charts they lie in.
class Turning {
 public:
  Turning(const SurfaceRef& surface, const SurfaceField& field, const ChartField& charts) : charts_(charts) {
    const auto into_face = turns_into_faces(surface, field);
    const size_t faces = charts.corner.size();
    turn_.resize(3 * faces);
    weight_.resize(faces);
    for (size_t f = 0; f < faces; ++f) {
      const auto c = surface.corners(OpenMesh::FaceHandle(static_cast<int>(f)));
      const auto& uv = charts.corner[f];
      const auto jacobian = triangle_jacobian(surface.point(c.vertex[0]), surface.point(c.vertex[1]),
                                              surface.point(c.vertex[2]), uv[0], uv[1], uv[2]);
      const Turn map = std::abs(jacobian.conformal) > 0 ? unit(jacobian.conformal) : complex(charts.axis(f));
      for (size_t i = 0; i < 3; ++i) turn_[3 * f + i] = complex(into_face[f][i]) * map;
      weight_[f] = jacobian.area;
    }
    result_.assign(turn_.size(), Turn(0));
    for (size_t c = 0; c < turn_.size(); ++c)
      if (result_[c] == Turn(0)) turn_sector(static_cast<int>(c));
  }

  Vec2d at(size_t corner) const { return {result_[corner].real(), result_[corner].imag()}; }

 private:
  // The next corner around the vertex, or -1 at a border or feature; the side that is crossed.
  int onward(int corner, bool left, int& side) const {
    side = left ? previous_side(corner) : corner;
    const int twin = charts_.sides.twin[static_cast<size_t>(side)];
    if (twin < 0 || charts_.sides.feature[static_cast<size_t>(side)]) return -1;
    return left ? twin : next_side(twin);
  }
  Turn along(int side) const { return charts_.along(side); }
  Turn weighted(int corner) const {
    return weight_[static_cast<size_t>(corner / 3)] * turn_[static_cast<size_t>(corner)];
  }

  // The corners around a vertex between two seams, and what lies beyond these.
  void turn_sector(int start) {
    std::vector<int> sector{start};
    int side = -1, end[2] = {start, start};  // the last corners to the right and to the left
    bool whole = false;
    for (const bool left : {true, false})
      for (int c = start; !whole;) {
        const int next = onward(c, left, side);
        if (next < 0 || charts_.seam[static_cast<size_t>(side)]) break;
        whole = next == start;
        if (whole) break;
        sector.push_back(next);
        end[left] = c = next;
      }
    Turn sum(0);
    for (const int c : sector) sum += weighted(c);
    if (!whole)
      for (const bool left : {true, false}) sum += beyond(end[left], end[!left], left);
    sum = std::abs(sum) > 0 ? unit(sum) : turn_[static_cast<size_t>(start)];
    for (const int c : sector) result_[static_cast<size_t>(c)] = sum;
  }

  // What is reached over the seam to one side of a sector, unfolded into its plane. Around a whole star it is
  // reached from the other side too.
  Turn beyond(int from, int other_end, bool left) const {
    Turn carry(1), sum(0);
    int side = -1;
    bool around = false;
    for (int c = from;;) {
      const int next = onward(c, left, side);
      if (next < 0) break;
      if (charts_.seam[static_cast<size_t>(side)])
        carry *= -unit(along(side)) * std::conj(unit(along(charts_.sides.twin[static_cast<size_t>(side)])));
      around = next == other_end;
      if (around) break;
      sum += carry * weighted(next);
      c = next;
    }
    return around ? 0.5 * sum : sum;
  }

  const ChartField& charts_;
  std::vector<Turn> turn_;  // of each corner: from the tangent plane of its node to the plane of its chart
  std::vector<double> weight_;  // of each face: its area
  std::vector<Turn> result_;
};

}  // namespace

Vec2d ChartField::axis(size_t face) const {
  const Vec2d edge = corner[face][1] - corner[face][0];
  const double length = edge.norm();
  return length > 0 ? Vec2d(edge / length) : Vec2d(1, 0);
}

Turn ChartField::along(int side) const {
  const auto& c = corner[static_cast<size_t>(side / 3)];
  return complex(c[static_cast<size_t>(next_side(side) % 3)] - c[static_cast<size_t>(side % 3)]);
}

ChartField chart_field(const SurfaceRef& surface, const SurfaceField& field) {
  const auto& mesh = surface.connectivity();
  const auto number = require_property(mesh, property::chart);
  const auto uv = require_property(mesh, property::chart_uv);
  ChartField charts{FaceSides(surface), {}, {}, {}, {}};
  charts.corner.resize(mesh.n_faces());
  for (const auto f : mesh.all_faces()) {
    auto h = mesh.halfedge_handle(f);  // to corner 0
    for (Vec2d& corner : charts.corner[static_cast<size_t>(f.idx())]) {
      corner = mesh.property(uv, h);
      h = mesh.next_halfedge_handle(h);
    }
  }
  const auto place = [&](int c) {
    return charts.corner[static_cast<size_t>(c / 3)][static_cast<size_t>(c % 3)];
  };
  charts.seam.assign(charts.sides.twin.size(), 0);
  for (int side = 0; side < static_cast<int>(charts.seam.size()); ++side) {
    const int twin = charts.sides.twin[static_cast<size_t>(side)];
    if (twin < 0) continue;
    charts.seam[static_cast<size_t>(side)] = mesh.property(number, OpenMesh::FaceHandle(side / 3)) !=
                                                 mesh.property(number, OpenMesh::FaceHandle(twin / 3)) ||
                                             place(side) != place(next_side(twin)) ||
                                             place(next_side(side)) != place(twin);
  }
  const Turning turning(surface, field, charts);
  charts.tensor.resize(charts.corner.size());
  charts.turn.resize(charts.corner.size());
  for (size_t f = 0; f < charts.tensor.size(); ++f)
    for (size_t i = 0; i < 3; ++i) {
      charts.turn[f][i] = turning.at(3 * f + i);
      charts.tensor[f][i] =
          rotated(field.tensor[static_cast<size_t>(field.cut.corner_node[f][i])], charts.turn[f][i]);
    }
  return charts;
}

namespace {

// What is around a vertex on seams.
struct SeamStar {
  double bends = 0, angles = 0;  // sums, radians
  bool closed = true;            // neither on a border nor on a feature
  std::vector<int> seams;        // sides that leave it
};

std::map<int, SeamStar> seam_stars(const ChartField& charts, const std::vector<double>& bends) {
  const auto& sides = charts.sides;
  std::map<int, SeamStar> stars;
  for (int side = 0; side < static_cast<int>(bends.size()); ++side)
    if (charts.seam[static_cast<size_t>(side)])
      stars[sides.vertex[static_cast<size_t>(side)]].seams.push_back(side);
  for (int side = 0; side < static_cast<int>(bends.size()); ++side) {
    const auto found = stars.find(sides.vertex[static_cast<size_t>(side)]);
    if (found == stars.end()) continue;
    SeamStar& star = found->second;
    const Turn ahead = charts.along(side), back = -charts.along(previous_side(side));
    star.angles += std::arg(back * std::conj(ahead));
    star.bends += bends[static_cast<size_t>(side)];
    for (const int spoke : {side, previous_side(side)})
      if (sides.twin[static_cast<size_t>(spoke)] < 0 || sides.feature[static_cast<size_t>(spoke)])
        star.closed = false;
  }
  return stars;
}

}  // namespace

std::vector<double> seam_bends(const ChartField& charts) {
  constexpr double kFullTurn = 2 * 3.14159265358979323846;
  const auto frame = [&](int c) {
    return complex(charts.turn[static_cast<size_t>(c / 3)][static_cast<size_t>(c % 3)]);
  };
  std::vector<double> bends(charts.seam.size(), 0.0);
  for (int side = 0; side < static_cast<int>(bends.size()); ++side) {
    const int twin = charts.sides.twin[static_cast<size_t>(side)];
    if (!charts.seam[static_cast<size_t>(side)] || charts.sides.feature[static_cast<size_t>(side)]) continue;
    const Turn frames = frame(next_side(twin)) * std::conj(frame(side));
    const Turn seam = -charts.along(twin) * std::conj(charts.along(side));
    bends[static_cast<size_t>(side)] = std::arg(frames * std::conj(seam));
  }
  // Each is known up to full turns. Where charts turn far, more than half a turn is wanted of one of them.
  for (const auto& [vertex, star] : seam_stars(charts, bends)) {
    if (!star.closed || !std::isfinite(star.bends + star.angles)) continue;
    const auto extra = std::lround((star.bends + star.angles) / kFullTurn) - 1;
    const auto less = [&](int a, int b) {
      return bends[static_cast<size_t>(a)] < bends[static_cast<size_t>(b)];
    };
    for (long k = std::abs(extra); k > 0; --k) {
      const auto& seams = star.seams;
      const int side = extra > 0 ? *std::max_element(seams.begin(), seams.end(), less)
                                 : *std::min_element(seams.begin(), seams.end(), less);
      bends[static_cast<size_t>(side)] += extra > 0 ? -kFullTurn : kFullTurn;
    }
  }
  return bends;
}

}  // namespace anisomesh::detail
