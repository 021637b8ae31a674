#include "balance/patch_moves.hh"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "balance/patch_groups.hh"
#include "fit/fit_guard.hh"
#include "surface/rounding.hh"

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double worth_a_look = 1.2;    // mean errors: better polygons are left alone
constexpr double tried_removals = 0.3;  // of all vertices, those that seem cheapest
constexpr double worth_adding = 2;      // mean errors: there a vertex may be added
constexpr double worth_adding_where_lacking = 1.2;
constexpr double lying_across = 0.3;    // mean errors: a side that costs more for how it lies is looked at
constexpr double worth_parting = 0.05;  // mean errors: a repartition gains that
/// How much more sides count that lie across, where two triangles become quads with what parts them: their
/// price alone would lay sides of a regular grid askew for it, and take places far off, of so many rms, too.
constexpr double sides_of_pairs = 3, farthest_for_pairs = 3;
constexpr double hanging = 3;  // times the error of the input beside it, or the mean one

// Of moves that gain the same but for rounding, as one quad parted alone or with what stays beside it, the
// first comes first.
void sort_by_gain(std::vector<PatchMove>& moves) {
  moves.erase(std::remove_if(moves.begin(), moves.end(), [](const PatchMove& m) { return m.pieces.empty(); }),
              moves.end());
  std::vector<double> gains;
  gains.reserve(moves.size());
  for (const PatchMove& move : moves) gains.push_back(move.gain);
  gains = in_steps(std::move(gains));
  std::vector<size_t> order(moves.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return gains[a] > gains[b]; });
  std::vector<PatchMove> sorted;
  sorted.reserve(moves.size());
  for (const size_t i : order) sorted.push_back(std::move(moves[i]));
  moves = std::move(sorted);
}

// What the sides inside a patch cost as they are.
double inner_chords(const PatchMesh& mesh, const PatchMesh::Patch& patch, const PatchView& view) {
  double sum = 0;
  for (const int p : patch.polygons) {
    const auto& polygon = mesh.polygons()[at(p)];
    for (size_t i = 0; i < polygon.size(); ++i) {
      const int v = polygon[i], w = polygon[(i + 1) % polygon.size()];
      const int q = v < w ? mesh.across(v, w) : -1;  // each once
      if (std::find(patch.polygons.begin(), patch.polygons.end(), q) != patch.polygons.end())
        sum += view.chord(mesh.point(v), mesh.point(w));
    }
  }
  return sum;
}

Vec3d area_of(const std::vector<Vec3d>& ring) {
  Vec3d area(0, 0, 0);
  for (size_t i = 1; i + 1 < ring.size(); ++i) area += cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
  return area;
}

Vec3d unit(const Vec3d& v) {
  const double length = v.norm();
  return length > 0 ? v / length : v;
}

// Whether a polygon is folded onto one beside the patch that was not so before.
bool folds(const PatchMesh& mesh, const PatchMove& move) {
  const auto& ring = move.patch.ring;
  const auto normal_of = [&](const std::vector<int>& polygon) {
    std::vector<Vec3d> places;
    places.reserve(polygon.size());
    for (const int v : polygon) places.push_back(v < 0 ? move.place : mesh.point(v));
    return unit(area_of(places));
  };
  const auto normal_at = [&](const std::vector<std::vector<int>>& polygons, int v, int w) {
    for (const auto& polygon : polygons)
      for (size_t i = 0; i < polygon.size(); ++i)
        if (polygon[i] == v && polygon[(i + 1) % polygon.size()] == w) return normal_of(polygon);
    return Vec3d(0, 0, 0);
  };
  std::vector<std::vector<int>> before;
  for (const int p : move.patch.polygons) before.push_back(mesh.polygons()[at(p)]);
  double lowest = 1, lowest_before = least_fold;
  for (size_t i = 0; i < ring.size(); ++i) {
    const int v = ring[i], w = ring[(i + 1) % ring.size()], beside = mesh.across(v, w);
    if (beside < 0) continue;
    const Vec3d other = normal_of(mesh.polygons()[at(beside)]);
    lowest = std::min(lowest, other | normal_at(move.pieces, v, w));
    lowest_before = std::min(lowest_before, other | normal_at(before, v, w));
  }
  return lowest < lowest_before;
}

}  // namespace

/// A patch, and what has to be known to change it.
struct PatchMoves::Situation {
  std::vector<Vec3d> ring;
  Vec3d normal{0, 0, 0};
  std::vector<PatchSample> samples;
  std::vector<int> numbers;  // of the samples
  std::vector<char> forbidden;
  double error = 0, worst = 0;
  double costs = 0;  // of what is there
  Vec6d tensor{0, 0, 0, 0, 0, 0};
  bool possible = false;
};

/// A place of the input that stands beside a polygon.
struct PatchMoves::Sample {
  Vec3d place{0, 0, 0};
  double weight = 0, distance = 0;
  int face = -1;
};

// Of the result, samples stand for their feet on the input.
PatchMoves::Sample PatchMoves::sample_of(int index) const {
  const FitPair& pair = fit_.pairs()[at(index)];
  if (at(index) < fit_.matching().samples().size())
    return {fit_.matching().samples()[at(index)].place, pair.weight, pair.distance, pair.face};
  Vec3d foot = pair.distance * pair.direction;
  const Triangle& corner = fit_.triangles().corner[at(pair.triangle)];
  for (int k = 0; k < 3; ++k) foot += pair.barycentric[k] * fit_.points()[at(corner[at(k)])];
  return {foot, pair.weight, pair.distance, pair.face};
}

PatchMoves::PatchMoves(const SurfaceRef& surface, const FitInput& input, const FitState& fit,
                       const BalanceOptions& options)
    : surface_(surface), input_(input), fit_(fit) {
  const auto& mesh = fit.mesh();
  const auto& triangles = fit.triangles();
  std::vector<int> polygon_of(triangles.corner.size());
  for (int p = 0; p < mesh.n_polygons(); ++p)
    for (int t = triangles.first[at(p)]; t < triangles.first[at(p) + 1]; ++t) polygon_of[at(t)] = p;
  sort_samples(polygon_of);
  sort_curves();
  costs_.triangle = options.triangle_cost * mean_error_;
  costs_.quads = options.max_degree == 4;
  costs_.follow = input.follow;
  double length = 0;
  for (const auto& side : mesh.sides)
    length += (fit.points()[at(side.to)] - fit.points()[at(side.from)]).norm();
  if (length > 0)
    costs_.chord = options.alignment_cost * fit.alignment_factor() * mean_error_ *
                   static_cast<double>(mesh.sides.size()) / length;
}

// A polygon that hangs in the air, as over a fold, is far from the input while little of the input is beside
// it: what stands beside it are the feet of its own samples too.
void PatchMoves::sort_samples(const std::vector<int>& polygon_of) {
  const size_t n = at(fit_.mesh().n_polygons()), n_input = fit_.matching().samples().size();
  const auto& pairs = fit_.pairs();
  const auto polygon = [&](size_t i) { return at(polygon_of[at(pairs[i].triangle)]); };
  const auto squared = [&](size_t i) { return pairs[i].weight * pairs[i].distance * pairs[i].distance; };
  error_.assign(n, 0);
  worst_.assign(n, 0);
  std::vector<double> own(n, 0);
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (pairs[i].triangle < 0) continue;
    (i < n_input ? error_ : own)[polygon(i)] += squared(i);
    worst_[polygon(i)] = std::max(worst_[polygon(i)], pairs[i].distance);
  }
  double total = 0;
  for (const double error : error_) total += error;
  mean_error_ = total / static_cast<double>(std::max<size_t>(1, n));
  hangs_.assign(n, 0);
  for (size_t p = 0; p < n; ++p) {
    hangs_[p] = own[p] > hanging * std::max(error_[p], mean_error_);
    if (hangs_[p]) error_[p] += own[p];
  }
  first_sample_.assign(n + 1, 0);
  const auto counts = [&](size_t i) { return pairs[i].triangle >= 0 && (i < n_input || hangs_[polygon(i)]); };
  for (size_t i = 0; i < pairs.size(); ++i)
    if (counts(i)) ++first_sample_[polygon(i) + 1];
  for (size_t p = 0; p < n; ++p) first_sample_[p + 1] += first_sample_[p];
  sample_.resize(at(first_sample_.back()));
  std::vector<int> next(first_sample_.begin(), first_sample_.end() - 1);
  for (size_t i = 0; i < pairs.size(); ++i)
    if (counts(i)) sample_[at(next[polygon(i)]++)] = static_cast<int>(i);
  placed_.resize(sample_.size());
  normal_.assign(n, Vec3d(0, 0, 0));
  if (!input_.tensor.empty()) tensor_.assign(n, Vec6d(0.0));
  tbb::parallel_for(size_t{0}, n, [&](size_t p) {
    for (size_t i = at(first_sample_[p]); i < at(first_sample_[p + 1]); ++i) {
      const Sample sample = sample_of(sample_[i]);
      placed_[i] = {sample.place, sample.weight};
      normal_[p] += sample.weight * input_.normal[at(sample.face)];
      if (!tensor_.empty()) tensor_[p] += sample.weight * input_.tensor[at(sample.face)];
    }
  });
}

// Unit, or zero. What stands beside a polygon that hangs faces all ways: the border of the patch knows
// better.
Vec3d PatchMoves::normal_of(const std::vector<int>& polygons, const std::vector<Vec3d>& ring) const {
  if (std::any_of(polygons.begin(), polygons.end(), [&](int p) { return hangs_[at(p)]; }))
    return unit(area_of(ring));
  Vec3d sum(0, 0, 0);
  for (const int p : polygons) sum += normal_[at(p)];
  return unit(sum);
}

Vec6d PatchMoves::tensor_of(const std::vector<int>& polygons) const {
  Vec6d sum(0.0);
  if (!tensor_.empty())
    for (const int p : polygons) sum += tensor_[at(p)];
  return sum;
}

// \param place of a vertex that is to come
PatchMoves::Situation PatchMoves::look_at(const PatchMesh& mesh, const PatchMesh::Patch& patch,
                                          const Vec3d& place) const {
  Situation s;
  const size_t n = patch.ring.size();
  if (n < 3 || n > most_corners) return s;
  for (const int p : patch.polygons) {
    s.error += error_[at(p)];
    s.worst = std::max(s.worst, worst_[at(p)]);
    if (mesh.polygons()[at(p)].size() == 3) s.costs += costs_.triangle;
    const auto first = first_sample_[at(p)], end = first_sample_[at(p) + 1];
    s.samples.insert(s.samples.end(), placed_.begin() + first, placed_.begin() + end);
    s.numbers.insert(s.numbers.end(), sample_.begin() + first, sample_.begin() + end);
  }
  for (const int v : patch.ring) s.ring.push_back(v < 0 ? place : mesh.point(v));
  s.normal = normal_of(patch.polygons, s.ring);
  if (!(s.normal.sqrnorm() > 0)) return s;
  s.tensor = tensor_of(patch.polygons);
  s.forbidden = mesh.forbidden_chords(patch);
  s.possible = true;
  return s;
}

PatchMove PatchMoves::best_partition(const PatchMesh& mesh, const PatchMesh::Patch& patch, Aim aim,
                                     const Vec3d& place) const {
  PatchMove move;
  const Situation s = look_at(mesh, patch, place);
  if (!s.possible) return move;
  PatchCosts costs = costs_;
  const bool keeps_vertices = aim != Aim::removal;
  if (keeps_vertices) costs.limit = std::max(costs.limit, s.worst);
  if (aim == Aim::quads_of_pairs) {
    const double rms = std::sqrt(mean_error_ * static_cast<double>(error_.size()));
    costs.chord *= sides_of_pairs;
    costs.limit = (1 + kRounding) * std::max(s.worst, farthest_for_pairs * rms);
  }
  const PatchView view(s.normal, s.samples, s.tensor, costs);
  const double now = s.error + s.costs + inner_chords(mesh, patch, view);
  const double most = keeps_vertices ? now - worth_parting * mean_error_ : infinite;
  PatchPieces found = partition_ring(view, s.ring, s.forbidden, most);
  if (!std::isfinite(found.cost)) return move;
  move.patch = patch;
  move.gain = now - found.cost;
  for (auto& piece : found.pieces) {
    for (int& i : piece) i = patch.ring[at(i)];
    move.pieces.push_back(std::move(piece));
  }
  return move;
}

bool PatchMoves::may_be_made(const PatchMesh& mesh, const PatchMove& move) {
  return !move.pieces.empty() && mesh.may_replace(move.patch, move.pieces) && !folds(mesh, move);
}

PatchMove PatchMoves::partition(const PatchMesh& mesh, const PatchMesh::Patch& patch, Aim aim) const {
  PatchMove move = best_partition(mesh, patch, aim);
  if (!may_be_made(mesh, move)) move.pieces.clear();
  return move;
}

SurfacePoint PatchMoves::source_at(OpenMesh::FaceHandle face, const Vec3d& place) const {
  const auto c = surface_.corners(face);
  return {face, closest_barycentric(place, surface_.point(c.vertex[0]), surface_.point(c.vertex[1]),
                                    surface_.point(c.vertex[2]))};
}

PatchMove PatchMoves::addition(const PatchMesh& mesh, const PatchMesh::Patch& patch) const {
  PatchMove move;
  const Situation s = look_at(mesh, patch);
  if (!s.possible || s.samples.empty()) return move;
  PatchCosts costs = costs_;
  costs.limit = infinite;
  const PatchView view(s.normal, s.samples, s.tensor, costs);
  size_t worst = 0;
  double largest = -1;
  for (size_t i = 0; i < s.numbers.size(); ++i) {
    const double distance = fit_.pairs()[at(s.numbers[i])].distance;
    if (distance > largest) largest = distance, worst = i;
  }
  const Sample sample = sample_of(s.numbers[worst]);
  Vec3d middle = view.best_middle(view.best_middle(sample.place, s.ring), s.ring);
  PatchPieces found = partition_around(view, s.ring, middle);
  if (!std::isfinite(found.cost)) {
    middle = sample.place;
    found = partition_around(view, s.ring, middle);
  }
  if (!std::isfinite(found.cost)) return move;
  move.patch = patch;
  move.gain = s.error + s.costs + inner_chords(mesh, patch, view) - found.cost;
  move.adds = true;
  move.place = middle;
  move.source = source_at(OpenMesh::FaceHandle(sample.face), sample.place);
  for (auto& piece : found.pieces) {
    for (int& i : piece) i = at(i) < patch.ring.size() ? patch.ring[at(i)] : -1;
    move.pieces.push_back(std::move(piece));
  }
  if (!may_be_made(mesh, move)) move.pieces.clear();
  return move;
}

// Whether the sides inside a patch lie diagonally to the principal directions.
bool PatchMoves::is_across(const PatchMesh& mesh, const PatchMesh::Patch& patch) const {
  if (patch.ring.size() < 3 || patch.ring.size() > most_corners) return false;
  std::vector<Vec3d> ring;
  for (const int v : patch.ring) ring.push_back(mesh.point(v));
  const Vec3d normal = normal_of(patch.polygons, ring);
  if (!(normal.sqrnorm() > 0)) return false;
  const PatchView view(normal, {}, tensor_of(patch.polygons), costs_);
  return inner_chords(mesh, patch, view) > lying_across * mean_error_;
}

// Those that gain, in the order of the groups.
std::vector<PatchMove> PatchMoves::partitions(const PatchMesh& mesh, const PatchGroups& groups) const {
  std::vector<PatchMove> moves(groups.all().size());
  tbb::parallel_for(size_t{0}, moves.size(), [&](size_t i) {
    const Aim aim = i < groups.first_for_pairs() ? Aim::repartition : Aim::quads_of_pairs;
    moves[i] = partition(mesh, mesh.join(groups.all()[i]), aim);
  });
  return moves;
}

// Single polygons; neighbours that are far off, or triangles, or on both sides of an edge that lies
// diagonally to the principal directions; these also with each polygon beside them, as often it takes another
// to lay the edge better. Triangles that quads part.
std::vector<PatchMove> PatchMoves::repartitions(const PatchMesh& mesh) const {
  PatchGroups groups(mesh);
  std::vector<std::vector<int>> pairs;
  for (size_t p = 0; p < error_.size(); ++p) {
    if (mesh.polygons()[p].size() > 3 && error_[p] > worth_a_look * mean_error_)
      groups.add({static_cast<int>(p)});
    for (const int q : mesh.around(static_cast<int>(p)))
      if (q > static_cast<int>(p)) pairs.push_back({static_cast<int>(p), q});
    if (hangs_[p]) groups.add_around(static_cast<int>(p));
  }
  std::vector<char> across(pairs.size(), 0);
  tbb::parallel_for(size_t{0}, pairs.size(),
                    [&](size_t i) { across[i] = is_across(mesh, mesh.join(pairs[i])); });
  for (size_t i = 0; i < pairs.size(); ++i) {
    const int p = pairs[i][0], q = pairs[i][1];
    const bool triangles = mesh.polygons()[at(p)].size() + mesh.polygons()[at(q)].size() == 6;
    if (across[i] || triangles || error_[at(p)] + error_[at(q)] > 2 * worth_a_look * mean_error_)
      groups.add(pairs[i]);
    if (!across[i]) continue;
    for (const auto& [one, other] : {std::pair(p, q), std::pair(q, p)})
      for (const int beside : mesh.around(one))
        if (beside != other) groups.add_three(p, q, beside);
  }
  if (costs_.quads) groups.add_between_triangles(pairs);
  auto moves = partitions(mesh, groups);
  sort_by_gain(moves);
  return moves;
}

// A guess at what the removal of a vertex costs: its squared height over the vertices around it, by the area.
double PatchMoves::guess(const PatchMesh& mesh, const PatchMesh::Patch& star, int vertex) const {
  Vec3d middle(0, 0, 0), normal(0, 0, 0);
  const size_t n = star.ring.size();
  for (size_t i = 0; i < n; ++i) {
    const Vec3d &a = mesh.point(star.ring[i]), &b = mesh.point(star.ring[(i + 1) % n]);
    middle += a / static_cast<double>(n);
    normal += cross(a - mesh.point(vertex), b - mesh.point(vertex));
  }
  const double length = normal.norm();
  if (!(length > 0)) return infinite;
  const double height = ((mesh.point(vertex) - middle) | normal) / length;
  return length * height * height;
}

std::vector<PatchMove> PatchMoves::removals(const PatchMesh& mesh, bool of_all) const {
  const size_t n = mesh.vertices().size();
  std::vector<PatchMesh::Patch> stars(n);
  std::vector<std::pair<double, int>> guesses(n);
  tbb::parallel_for(size_t{0}, n, [&](size_t v) {
    stars[v] = mesh.star(static_cast<int>(v));
    guesses[v] = {stars[v].ring.empty() ? infinite : guess(mesh, stars[v], static_cast<int>(v)),
                  static_cast<int>(v)};
  });
  std::sort(guesses.begin(), guesses.end());
  std::vector<PatchMove> moves(of_all ? n : static_cast<size_t>(tried_removals * static_cast<double>(n)));
  tbb::parallel_for(size_t{0}, moves.size(), [&](size_t i) {
    const auto& star = stars[at(guesses[i].second)];
    if (!star.ring.empty()) moves[i] = partition(mesh, star, Aim::removal);
  });
  std::vector<PatchMove> on_curves = curve_removals(mesh);
  std::move(on_curves.begin(), on_curves.end(), std::back_inserter(moves));
  sort_by_gain(moves);
  return moves;
}

std::vector<PatchMove> PatchMoves::additions(const PatchMesh& mesh, bool lacking, bool at_any_cost) const {
  const double worth = lacking ? worth_adding_where_lacking : worth_adding;
  std::vector<char> wanted;
  for (const double error : error_) wanted.push_back(error > worth * mean_error_);
  return additions_to(mesh, wanted, lacking && at_any_cost ? -infinite : 0);
}

std::vector<PatchMove> PatchMoves::additions_beyond(const PatchMesh& mesh, double distance) const {
  std::vector<char> wanted;
  for (const double worst : worst_) wanted.push_back(worst > distance);
  return additions_to(mesh, wanted, -infinite);
}

std::vector<PatchMove> PatchMoves::additions_to(const PatchMesh& mesh, const std::vector<char>& wanted,
                                                double least_gain) const {
  std::vector<std::vector<int>> groups;
  for (size_t p = 0; p < error_.size(); ++p) {
    if (!wanted[p]) continue;
    const auto& polygon = mesh.polygons()[p];
    groups.push_back({static_cast<int>(p)});
    for (size_t i = 0; i < polygon.size(); ++i) {
      const int q = mesh.across(polygon[i], polygon[(i + 1) % polygon.size()]);
      const bool again = q >= 0 && q < static_cast<int>(p) && wanted[at(q)];
      if (q >= 0 && !again) groups.push_back({static_cast<int>(p), q});
    }
  }
  std::vector<PatchMove> moves(groups.size());
  tbb::parallel_for(size_t{0}, groups.size(), [&](size_t i) {
    PatchMove move = addition(mesh, mesh.join(groups[i]));
    if (move.gain > least_gain) moves[i] = std::move(move);
  });
  for (PatchMove& move : curve_additions(mesh, wanted))
    if (move.gain > least_gain) moves.push_back(std::move(move));
  sort_by_gain(moves);
  return moves;
}

}  // namespace anisomesh::detail
