#include "balance/far_moves.hh"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "fit/fit_samples.hh"

namespace anisomesh::detail {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

size_t at(int i) { return static_cast<size_t>(i); }

constexpr double far_share = 0.5;   // of the largest distance there is
constexpr double far_over_rms = 6;  // and so many times the rms
constexpr size_t most_places = 6;   // that are looked at
constexpr int divided = 3;          // sides of a triangle, for samples
constexpr double least_fullness = 0.01;
constexpr double much_less = 0.8;  // of the largest distance of a patch
}  // namespace

FarMoves::FarMoves(const ReferenceSurface& reference, const FitState& fit, const BalanceOptions& options)
    : reference_(reference),
      fit_(fit),
      quads_(options.max_degree == 4),
      triangle_cost_(options.triangle_cost * 0.5 * fit.energy() / fit.mesh().n_polygons()) {
  const FitTriangles& triangles = fit.triangles();
  far_.assign(at(fit.mesh().n_polygons()), 0);
  own_.resize(far_.size());
  const size_t n_input = fit.matching().samples().size();
  std::vector<int> polygon_of(triangles.corner.size());
  for (size_t p = 0; p < far_.size(); ++p)
    for (int t = triangles.first[p]; t < triangles.first[p + 1]; ++t) polygon_of[at(t)] = static_cast<int>(p);
  for (const double a : triangles.area) area_ += a;
  limit_ = far_over_rms * std::sqrt(0.5 * fit.energy());
  measure(polygon_of);
  for (const double far : far_) limit_ = std::max(limit_, far_share * far);
  for (size_t i = 0; i < n_input; ++i) {
    const int t = fit.pairs()[i].triangle;
    if (t >= 0) own_[at(polygon_of[at(t)])].push_back(static_cast<int>(i));
  }
}

// Of what the fit sees far off: a sample may be matched with one side of a crevice and lie on the other, as
// far from it as nothing really is, beside which no other place would be far.
void FarMoves::measure(const std::vector<int>& polygon_of) {
  const FitTriangles& triangles = fit_.triangles();
  const auto& samples = fit_.matching().samples();
  const TriangleTree result(fit_.points(), triangles.corner);
  std::vector<int> distant;
  for (size_t i = 0; i < fit_.pairs().size(); ++i)
    if (fit_.pairs()[i].triangle >= 0 && fit_.pairs()[i].distance > limit_)
      distant.push_back(static_cast<int>(i));
  for (const int i : distant) {
    const FitPair& pair = fit_.pairs()[at(i)];
    double squared = 0;
    if (at(i) < samples.size()) {
      squared = result.closest(samples[at(i)].place).squared_distance;
    } else {
      const Triangle& corner = triangles.corner[at(pair.triangle)];
      Vec3d place(0, 0, 0);
      for (size_t k = 0; k < 3; ++k) place += pair.barycentric[k] * fit_.points()[at(corner[k])];
      squared = reference_.tree.closest(place).squared_distance;
    }
    double& far = far_[at(polygon_of[at(pair.triangle)])];
    far = std::max(far, std::sqrt(squared));
  }
}

/// What is known of triangles that were asked for at one place: its patches have most of theirs in common.
struct FarMoves::Place {
  std::map<Triangle, double> known;
  std::map<Triangle, Error> measured;
  double most = 0;  // more than what is there costs no triangle may
};

// Polygons that are far and touch, the farthest first.
std::vector<std::vector<int>> FarMoves::places(const PatchMesh& mesh) const {
  std::vector<int> order;
  for (size_t p = 0; p < far_.size(); ++p)
    if (far_[p] > limit_) order.push_back(static_cast<int>(p));
  std::stable_sort(order.begin(), order.end(), [&](int p, int q) { return far_[at(p)] > far_[at(q)]; });
  std::vector<char> seen(far_.size(), 0);
  std::vector<std::vector<int>> found;
  for (const int start : order) {
    if (seen[at(start)]) continue;
    if (found.size() == most_places) break;
    std::vector<int> group{start};
    seen[at(start)] = 1;
    for (size_t i = 0; i < group.size(); ++i)
      for (const int q : mesh.around(group[i]))
        if (!seen[at(q)] && far_[at(q)] > limit_) seen[at(q)] = 1, group.push_back(q);
    std::sort(group.begin(), group.end());
    found.push_back(std::move(group));
  }
  return found;
}

namespace {

// Some polygons alone, and with one and two of those around.
std::vector<std::vector<int>> with_those_around(const PatchMesh& mesh, const std::vector<int>& group) {
  std::vector<int> around;
  for (const int p : group)
    for (const int q : mesh.around(p))
      if (std::find(group.begin(), group.end(), q) == group.end() &&
          std::find(around.begin(), around.end(), q) == around.end())
        around.push_back(q);
  std::vector<std::vector<int>> groups{group};
  const auto add = [&](std::initializer_list<int> more) {
    groups.push_back(group);
    groups.back().insert(groups.back().end(), more);
  };
  for (size_t i = 0; i < around.size(); ++i) {
    add({around[i]});
    for (size_t j = 0; j < i && group.size() <= 2; ++j) add({around[j], around[i]});
  }
  return groups;
}

}  // namespace

// Squared distances of a triangle's samples, more where they are far; infinite if that is more than most.
double FarMoves::cost(const Vec3d& a, const Vec3d& b, const Vec3d& c, double most) const {
  const Vec3d n = cross(b - a, c - a);
  const double twice = n.norm();
  if (!(twice > least_fullness * std::max({(b - a).sqrnorm(), (c - b).sqrnorm(), (a - c).sqrnorm()})))
    return infinite;
  const double weight = 0.5 * twice / (divided * divided) / area_;
  double sum = 0;
  for_each_piece(divided, [&](const Vec3d& w) {
    if (!(sum < most)) return;
    const double squared = reference_.tree.closest(w[0] * a + w[1] * b + w[2] * c).squared_distance;
    sum += weight * squared * (1 + squared / (limit_ * limit_));
  });
  return sum < most ? sum : infinite;
}

namespace {

std::vector<Triangle> triangles_of(const std::vector<std::vector<int>>& pieces, const PatchMesh& mesh) {
  std::vector<Triangle> result;
  for (const auto& p : pieces) {
    if (p.size() == 3) {
      result.push_back({p[0], p[1], p[2]});
      continue;
    }
    const bool first =
        (mesh.point(p[2]) - mesh.point(p[0])).sqrnorm() <= (mesh.point(p[3]) - mesh.point(p[1])).sqrnorm();
    if (first)
      result.push_back({p[0], p[1], p[2]}), result.push_back({p[0], p[2], p[3]});
    else
      result.push_back({p[0], p[1], p[3]}), result.push_back({p[1], p[2], p[3]});
  }
  return result;
}

Triangle lowest_first(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

Vec3d area_of(const Triangle& t, const PatchMesh& mesh) {
  return cross(mesh.point(t[1]) - mesh.point(t[0]), mesh.point(t[2]) - mesh.point(t[0]));
}

// Of pieces and the polygons around them, those that are folded as the ruler judges it: the walls of a slit
// may face each other, as the input's do.
size_t folds_of(const ReferenceSurface& reference, const PatchMesh& mesh, const PatchMesh::Patch& patch,
                const std::vector<std::vector<int>>& pieces) {
  auto polygons = pieces;
  for (size_t i = 0; i < patch.ring.size(); ++i) {
    const int beside = mesh.across(patch.ring[i], patch.ring[(i + 1) % patch.ring.size()]);
    if (beside >= 0) polygons.push_back(mesh.polygons()[at(beside)]);
  }
  std::sort(polygons.begin(), polygons.end());
  polygons.erase(std::unique(polygons.begin(), polygons.end()), polygons.end());
  OpenMesh::PolyMesh part;
  std::map<int, OpenMesh::VertexHandle> number;
  for (const auto& polygon : polygons) {
    std::vector<OpenMesh::VertexHandle> corners;
    for (const int v : polygon) {
      const auto [known, is_new] = number.try_emplace(v);
      if (is_new) known->second = part.add_vertex(mesh.point(v));
      corners.push_back(known->second);
    }
    part.add_face(corners);
  }
  const auto folded = folded_faces(reference, PolygonSoup(part, FaceDiagonal::shorter));
  return static_cast<size_t>(std::count(folded.begin(), folded.end(), 1)) + polygons.size() - part.n_faces();
}

}  // namespace

// Of a triangle's own samples. \param t the lowest corner first
FarMoves::Error FarMoves::own_error(const PatchMesh& mesh, const Triangle& t, Place& place) const {
  const auto [known, is_new] = place.measured.try_emplace(t);
  Error& error = known->second;
  if (!is_new) return error;
  const Vec3d &a = mesh.point(t[0]), &b = mesh.point(t[1]), &c = mesh.point(t[2]);
  const double weight = 0.5 * area_of(t, mesh).norm() / area_ / 16;
  for_each_piece(4, [&](const Vec3d& w) {
    const double squared = reference_.tree.closest(w[0] * a + w[1] * b + w[2] * c).squared_distance;
    error.squared += weight * squared;
    error.largest = std::max(error.largest, squared);
  });
  for (const Vec3d& p : {0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)})
    error.largest = std::max(error.largest, reference_.tree.closest(p).squared_distance);
  return error;
}

// Looked at no further once either figure is no less than it may be at most.
FarMoves::Error FarMoves::error(const PatchMesh& mesh, const PatchMesh::Patch& patch,
                                const std::vector<std::vector<int>>& pieces, const Error& most,
                                Place& place) const {
  Error error;
  const auto triangles = triangles_of(pieces, mesh);
  for (const Triangle& t : triangles) {
    const Error own = own_error(mesh, lowest_first(t), place);
    error.squared += own.squared;
    error.largest = std::max(error.largest, own.largest);
    if (!(error < most)) return error;
  }
  for (const int p : patch.polygons)
    for (const int i : own_[at(p)]) {
      const Vec3d& there = fit_.matching().samples()[at(i)].place;
      double least = infinite;
      for (const Triangle& t : triangles) {
        const Vec3d &a = mesh.point(t[0]), &b = mesh.point(t[1]), &c = mesh.point(t[2]);
        const Vec3d w = closest_barycentric(there, a, b, c);
        least = std::min(least, (w[0] * a + w[1] * b + w[2] * c - there).sqrnorm());
      }
      error.squared += fit_.pairs()[at(i)].weight * least;
      error.largest = std::max(error.largest, least);
      if (!(error < most)) return error;
    }
  return error;
}

PatchMove FarMoves::partition(const PatchMesh& mesh, const PatchMesh::Patch& patch, Place& place) const {
  PatchMove move;
  const size_t n = patch.ring.size();
  if (n < 4 || n > most_corners) return move;
  std::vector<Vec3d> ring;
  for (const int v : patch.ring) ring.push_back(mesh.point(v));
  std::vector<std::vector<int>> before;
  for (const int p : patch.polygons) before.push_back(mesh.polygons()[at(p)]);
  const auto known_cost = [&](const Triangle& t) {
    const auto [known, is_new] = place.known.try_emplace(lowest_first(t), 0);
    if (is_new) known->second = cost(mesh.point(t[0]), mesh.point(t[1]), mesh.point(t[2]), place.most);
    return known->second;
  };
  double now_costs = 0;
  for (const auto& piece : before) now_costs += piece.size() == 3 ? triangle_cost_ : 0;
  for (const Triangle& t : triangles_of(before, mesh)) now_costs += known_cost(t);
  const auto triangle = [&](size_t i, size_t j, size_t k) {
    return known_cost({patch.ring[i], patch.ring[j], patch.ring[k]});
  };
  const auto free = [](size_t, size_t) { return 0.0; };
  PatchPieces found =
      partition_ring({triangle, free, triangle_cost_, quads_, now_costs}, ring, mesh.forbidden_chords(patch));
  if (!std::isfinite(found.cost)) return move;
  for (auto& piece : found.pieces)
    for (int& i : piece) i = patch.ring[at(i)];
  if (!mesh.may_replace(patch, found.pieces)) return move;
  const Error old = error(mesh, patch, before, {infinite, infinite}, place),
              most{old.squared, much_less * much_less * old.largest};
  const Error now = error(mesh, patch, found.pieces, most, place);
  if (!(now < most)) return move;
  const size_t folded = folds_of(reference_, mesh, patch, found.pieces);
  if (folded > 0 && folded > folds_of(reference_, mesh, patch, before)) return move;
  move.patch = patch;
  move.pieces = std::move(found.pieces);
  move.gain = old.squared - now.squared;
  return move;
}

std::vector<PatchMove> FarMoves::repartitions(const PatchMesh& mesh) const {
  const auto far = places(mesh);
  std::vector<PatchMove> best(far.size());
  tbb::parallel_for(size_t{0}, far.size(), [&](size_t i) {
    Place place;
    const auto groups = with_those_around(mesh, far[i]);
    std::set<int> polygons;
    for (const auto& group : groups) polygons.insert(group.begin(), group.end());
    for (const int p : polygons) {
      for (const Triangle& t : triangles_of({mesh.polygons()[at(p)]}, mesh))
        place.most += cost(mesh.point(t[0]), mesh.point(t[1]), mesh.point(t[2]), infinite);
      for (const int k : own_[at(p)]) {
        const FitPair& pair = fit_.pairs()[at(k)];
        place.most += pair.weight * pair.distance * pair.distance;
      }
    }
    for (const auto& group : groups) {
      PatchMove move = partition(mesh, mesh.join(group), place);
      if (!move.pieces.empty() && is_surely_less(best[i].gain, move.gain)) best[i] = std::move(move);
    }
  });
  best.erase(std::remove_if(best.begin(), best.end(), [](const PatchMove& m) { return m.pieces.empty(); }),
             best.end());
  return best;
}

}  // namespace anisomesh::detail
