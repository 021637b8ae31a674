// Vertices that go from features and borders, and come to them: both sides of the curve are parted anew at
// once.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "balance/patch_moves.hh"
#include "numerics/segment.hh"
#include "prepare/feature_tolerance.hh"
#include "surface/recorded.hh"

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

constexpr double infinite = std::numeric_limits<double>::infinity();

constexpr double farthest_of_all = 3;  // rms distances that a curve may lie beside where a vertex goes
constexpr double irregular =
    3;  // triangles that a vertex costs more on each side of a curve: no line ends there
constexpr double straight = 1e-6;  // lengths of a side: its curve is nowhere farther from it

}  // namespace

void PatchMoves::sort_curves() {
  const FitMesh& mesh = fit_.mesh();
  on_side_.resize(mesh.sides.size());
  for (const auto& sample : fit_.curves().samples()) on_side_[at(sample.side)].push_back(&sample);
  double area = 0;
  for (const double a : fit_.triangles().area) area += a;
  if (area > 0) curve_weight_ = std::sqrt(area / mesh.n_polygons()) / area;
  const double tolerance =
      recorded(surface_.connectivity(), property::feature_tolerance, asked_feature_tolerance);
  const double asked = asked_feature_tolerance * surface_.extent(), rms = std::sqrt(0.5 * fit_.energy());
  farthest_from_curve_ = std::min(tolerance * surface_.extent(), std::max(asked, farthest_of_all * rms));
}

// What the curve itself costs more where a vertex goes from it, as the fit weighs it. Infinite where it would
// be left farther than somebody asked.
double PatchMoves::curve_cost(int vertex, const std::array<int, 2>& bridge) const {
  const auto& points = fit_.points();
  const FitMesh& mesh = fit_.mesh();
  double sum = 0;
  for (int i = mesh.first_side[at(vertex)]; i < mesh.first_side[at(vertex) + 1]; ++i) {
    const int side = mesh.sides_at[at(i)];
    for (const FitCurves::Sample* sample : on_side_[at(side)]) {
      const double distance = off_segment(sample->place, points[at(bridge[0])], points[at(bridge[1])]).norm();
      if (distance > std::max(farthest_from_curve_, sample->distance)) return infinite;
      sum += sample->length * (distance * distance - sample->distance * sample->distance);
    }
  }
  return curve_weight_ * sum;
}

// Each side of the curve is parted by itself.
bool PatchMoves::part_sides(const PatchMesh& mesh, const PatchMesh::CurveStar& star, PatchMove& move) const {
  move.patch = star.whole;
  for (const PatchMesh::Patch& side : star.sides) {
    const PatchMove part = best_partition(mesh, side, Aim::removal, move.place);
    if (part.pieces.empty()) return false;
    move.gain += part.gain;
    if (star.sides.size() == 2 && move.pieces.empty()) move.on_first_side = part.pieces.size();
    move.pieces.insert(move.pieces.end(), part.pieces.begin(), part.pieces.end());
  }
  return may_be_made(mesh, move);
}

PatchMove PatchMoves::curve_removal(const PatchMesh& mesh, int vertex) const {
  PatchMove move;
  const PatchMesh::CurveStar star = mesh.curve_star(vertex);
  if (star.sides.empty()) return move;
  move.gain = -curve_cost(vertex, star.whole.bridge);
  return std::isfinite(move.gain) && part_sides(mesh, star, move) ? move : PatchMove();
}

// At the place of the curve that is farthest from a side.
PatchMove PatchMoves::curve_addition(const PatchMesh& mesh, int side) const {
  PatchMove move;
  const auto& ends = fit_.mesh().sides[at(side)];
  const FitCurves::Sample* farthest = nullptr;
  for (const auto* sample : on_side_[at(side)])
    if (!farthest || sample->distance > farthest->distance) farthest = sample;
  const Vec3d &a = mesh.point(ends.from), &b = mesh.point(ends.to);
  if (!farthest || !(farthest->distance > straight * (b - a).norm())) return move;
  move.adds = true;
  move.place = farthest->place;
  move.between = {ends.from, ends.to};
  for (const auto* sample : on_side_[at(side)]) {
    const double distance = std::min(off_segment(sample->place, a, move.place).norm(),
                                     off_segment(sample->place, move.place, b).norm());
    move.gain += curve_weight_ * sample->length * (sample->distance * sample->distance - distance * distance);
  }
  const auto& input = surface_.connectivity();
  const OpenMesh::EdgeHandle edge(farthest->edge);
  auto face = input.face_handle(input.halfedge_handle(edge, 0));
  if (!face.is_valid()) face = input.face_handle(input.halfedge_handle(edge, 1));
  move.source = source_at(face, move.place);
  const PatchMesh::CurveStar star = mesh.curve_side(ends.from, ends.to);
  move.gain -= irregular * costs_.triangle * static_cast<double>(star.sides.size());
  return !star.sides.empty() && part_sides(mesh, star, move) ? move : PatchMove();
}

std::vector<PatchMove> PatchMoves::curve_removals(const PatchMesh& mesh) const {
  std::vector<char> stays(mesh.vertices().size(), 0);
  for (const auto& group : fit_.twins())  // they would have to go together
    for (const int v : group) stays[at(v)] = 1;
  std::vector<int> candidates;
  for (size_t v = 0; v < stays.size(); ++v)
    if (mesh.vertices()[v].on_curve && !stays[v]) candidates.push_back(static_cast<int>(v));
  std::vector<PatchMove> moves(candidates.size());
  tbb::parallel_for(size_t{0}, moves.size(),
                    [&](size_t i) { moves[i] = curve_removal(mesh, candidates[i]); });
  return moves;
}

std::vector<PatchMove> PatchMoves::curve_additions(const PatchMesh& mesh,
                                                   const std::vector<char>& wanted) const {
  const auto is_wanted = [&](int p) { return p >= 0 && wanted[at(p)] != 0; };
  std::vector<char> stays(mesh.vertices().size(), 0);
  for (const auto& group : fit_.twins())
    for (const int v : group) stays[at(v)] = 1;
  std::vector<int> candidates;
  for (size_t s = 0; s < on_side_.size(); ++s) {
    const auto& side = fit_.mesh().sides[s];
    const auto& beside = fit_.mesh().beside[s];
    const bool on_slit = stays[at(side.from)] && stays[at(side.to)];
    if (side.on_curve && !on_slit && (is_wanted(beside[0]) || is_wanted(beside[1])))
      candidates.push_back(static_cast<int>(s));
  }
  std::vector<PatchMove> moves(candidates.size());
  tbb::parallel_for(size_t{0}, moves.size(),
                    [&](size_t i) { moves[i] = curve_addition(mesh, candidates[i]); });
  return moves;
}

}  // namespace anisomesh::detail
