#include "balance/patch_partition.hh"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesher/polygon_judge.hh"
#include "numerics/tensor3d.hh"
#include "surface/rounding.hh"

namespace anisomesh::detail {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double least_fullness = 0.03;  // twice the area over the squared longest side
constexpr double least_cosine = 0.3;     // of a triangle's normal to the patch's
constexpr double least_bend = 0.6;       // of the normals of a quad's triangles
constexpr double damping = 0.05;
constexpr double on_spoke = 1e-9;         // barycentric
constexpr double least_anisotropy = 0.3;  // as where the ruler measures alignment

}  // namespace

PatchView::PatchView(const Vec3d& normal, std::vector<PatchSample> samples, const Vec6d& tensor,
                     const PatchCosts& costs)
    : normal_(normal), costs_(costs), samples_(std::move(samples)) {
  const TangentFrame frame(normal);
  u_ = frame.u;
  v_ = frame.v;
  lines_ = orientation(followed(in_frame(tensor, frame), costs.follow));
  cosine_ = std::cos(2 * lines_.angle);
  sine_ = std::sin(2 * lines_.angle);
  places_.reserve(samples_.size());
  for (const PatchSample& s : samples_) places_.push_back(seen(s.place));
}

Vec3d PatchView::fair_area(const Vec3d& a, const Vec3d& b, const Vec3d& c) const {
  const Vec3d n = cross(b - a, c - a);
  const double twice = n.norm();
  const double longest = std::max({(b - a).sqrnorm(), (c - b).sqrnorm(), (a - c).sqrnorm()});
  return twice > least_fullness * longest && (n | normal_) > least_cosine * twice ? n : Vec3d(0, 0, 0);
}

double PatchView::triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c) const {
  const Vec3d n = fair_area(a, b, c);
  const double twice = n.norm();
  if (!(twice > 0)) return infinite;
  const Place p = seen(a), q = seen(b), r = seen(c);
  double sum = 0;
  for (size_t i = 0; i < samples_.size(); ++i) {
    const Place& x = places_[i];
    if (side(p, q, x) < 0 || side(q, r, x) < 0 || side(r, p, x) < 0) continue;
    const double height = ((samples_[i].place - a) | n) / twice;
    if (std::abs(height) > costs_.limit) return infinite;
    sum += samples_[i].weight * height * height;
  }
  return sum;
}

double PatchView::triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c, const SampleSet* ab,
                           const SampleSet* bc, const SampleSet* ca) const {
  const Vec3d n = fair_area(a, b, c);
  const double twice = n.norm();
  if (!(twice > 0)) return infinite;
  double sum = 0;
  for (size_t word = 0; word < set_size(); ++word) {
    for (SampleSet left = ab[word] & bc[word] & ca[word]; left != 0; left &= left - 1) {
      const size_t i = 64 * word + static_cast<size_t>(__builtin_ctzll(left));
      const double height = ((samples_[i].place - a) | n) / twice;
      if (std::abs(height) > costs_.limit) return infinite;
      sum += samples_[i].weight * height * height;
    }
  }
  return sum;
}

void PatchView::part_samples(const Vec3d& from, const Vec3d& to, SampleSet* left, SampleSet* right) const {
  const Place p = seen(from), q = seen(to);
  for (size_t begin = 0; begin < places_.size(); begin += 64, ++left, ++right) {
    const size_t n = std::min<size_t>(64, places_.size() - begin);
    SampleSet not_right = 0, not_left = 0;
    for (size_t i = 0; i < n; ++i) {
      const double to_left = side(p, q, places_[begin + i]);
      not_right |= static_cast<SampleSet>(to_left >= 0) << i;
      not_left |= static_cast<SampleSet>(to_left <= 0) << i;
    }
    *left = not_right, *right = not_left;
  }
}

double PatchView::chord(const Vec3d& a, const Vec3d& b) const {
  if (!(lines_.anisotropy > least_anisotropy)) return 0;
  const Place p = seen(a), q = seen(b);
  const double x = q.x - p.x, y = q.y - p.y, squared = x * x + y * y;
  if (!(squared > 0)) return 0;
  // |sin| of twice the angle between
  const double turned = std::abs(2 * x * y * cosine_ - (x * x - y * y) * sine_) / squared;
  return costs_.chord * turned * (b - a).norm();
}

bool is_fair_quad(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  const bool first = (c - a).sqrnorm() <= (d - b).sqrnorm();
  const Vec3d n = first ? cross(b - a, c - a) : cross(b - a, d - a),
              m = first ? cross(c - a, d - a) : cross(c - b, d - b);
  return (n | m) > least_bend * n.norm() * m.norm() && PolygonJudge::is_convex({a, b, c, d});
}

Vec3d PatchView::best_middle(const Vec3d& start, const std::vector<Vec3d>& ring) const {
  const Place m = seen(start);
  double matrix[3][3] = {}, right[3] = {};
  double weight = 0;
  for (size_t k = 0; k < ring.size(); ++k) {
    const Vec3d &a = ring[k], &b = ring[(k + 1) % ring.size()];
    const Place p = seen(a), q = seen(b);
    const double area = (p.x - m.x) * (q.y - m.y) - (p.y - m.y) * (q.x - m.x);
    if (!(area > 0)) return start;
    const Vec3d cross_product = cross(a - start, b - start);
    const Vec3d n = cross_product / cross_product.norm();
    for (size_t i = 0; i < samples_.size(); ++i) {
      const Place& x = places_[i];
      const double of_b = ((p.x - m.x) * (x.y - m.y) - (p.y - m.y) * (x.x - m.x)) / area,
                   of_a = ((x.x - m.x) * (q.y - m.y) - (x.y - m.y) * (q.x - m.x)) / area;
      const double b_middle = 1 - of_a - of_b;
      // On a spoke it is on both sides; where the middle is, beside all.
      if (of_a < -on_spoke || of_b < -on_spoke || b_middle < -on_spoke) continue;
      const double height = (samples_[i].place - start) | n, w = samples_[i].weight;
      weight += w * b_middle * b_middle;
      for (int r = 0; r < 3; ++r) {
        right[r] += w * height * b_middle * n[r];
        for (int c = 0; c < 3; ++c) matrix[r][c] += w * b_middle * b_middle * n[r] * n[c];
      }
    }
  }
  if (!(weight > 0)) return start;
  for (int r = 0; r < 3; ++r) matrix[r][r] += damping * weight;
  // Cramer's rule: the damping keeps the matrix well away from singular.
  const Vec3d x(matrix[0][0], matrix[1][0], matrix[2][0]), y(matrix[0][1], matrix[1][1], matrix[2][1]),
      z(matrix[0][2], matrix[1][2], matrix[2][2]), b(right[0], right[1], right[2]);
  const double determinant = x | cross(y, z);
  return start + Vec3d(b | cross(y, z), x | cross(b, z), x | cross(y, b)) / determinant;
}

namespace {

/// Dynamic program over the chords of a ring. Where nothing tells directions, quads that pair the same
/// triangles differently cost the same, and the first is taken: rounding does not choose.
class RingProgram {
 public:
  RingProgram(const RingCosts& costs, const std::vector<Vec3d>& ring, const std::vector<char>& forbidden)
      : costs_(costs),
        ring_(ring),
        forbidden_(forbidden),
        n_(ring.size()),
        best_(n_ * n_, -1),
        choice_(n_ * n_),
        triangle_(n_ * n_ * n_, -1) {}

  PatchPieces run() {
    PatchPieces result;
    result.cost = cost(0, n_ - 1);
    if (result.cost < costs_.most)
      collect(0, n_ - 1, result.pieces);
    else
      result.cost = infinite;
    return result;
  }

 private:
  struct Choice {
    size_t k = 0, l = 0;  // corners of the piece on the chord; l is 0 for a triangle
  };

  bool may_join(size_t i, size_t j) const {
    return j == i + 1 || (i == 0 && j + 1 == n_) || !forbidden_[i * n_ + j];
  }
  double triangle(size_t i, size_t j, size_t k) {
    double& known = triangle_[(i * n_ + j) * n_ + k];
    if (known < 0) known = costs_.triangle(i, j, k);
    return known;
  }
  double quad(size_t i, size_t j, size_t k, size_t l) {
    const bool first = (ring_[k] - ring_[i]).sqrnorm() <= (ring_[l] - ring_[j]).sqrnorm();
    const double sum = first ? triangle(i, j, k) + triangle(i, k, l) : triangle(i, j, l) + triangle(j, k, l);
    if (!(sum < infinite)) return sum;
    return is_fair_quad(ring_[i], ring_[j], ring_[k], ring_[l]) ? sum : infinite;
  }
  double cost(size_t i, size_t j) {
    if (j == i + 1) return 0;
    const bool inner = i != 0 || j + 1 != n_;
    double& known = best_[i * n_ + j];
    if (known >= 0) return known;
    double best = costs_.most;  // what costs more is of no use, whatever is beside it
    if (may_join(i, j))
      for (size_t k = i + 1; k < j; ++k) {
        if (!may_join(i, k)) continue;
        const double left = cost(i, k);
        if (!(left < best)) continue;
        if (may_join(k, j)) {
          const double right = cost(k, j);
          if (left + right + costs_.each_triangle < best) {
            const double sum = left + right + costs_.each_triangle + triangle(i, k, j);
            if (is_surely_less(sum, best)) best = sum, choice_[i * n_ + j] = {k, 0};
          }
        }
        for (size_t l = k + 1; l < j && costs_.quads; ++l) {
          if (!may_join(k, l) || !may_join(l, j)) continue;
          const double rest = left + cost(k, l) + cost(l, j);
          if (!(rest < best)) continue;
          const double sum = rest + quad(i, k, l, j);
          if (is_surely_less(sum, best)) best = sum, choice_[i * n_ + j] = {k, l};
        }
      }
    return known = best + (inner ? costs_.chord(i, j) : 0);
  }
  void collect(size_t i, size_t j, std::vector<std::vector<int>>& pieces) const {
    if (j == i + 1) return;
    const Choice c = choice_[i * n_ + j];
    const auto number = [](size_t x) { return static_cast<int>(x); };
    if (c.l == 0) {
      pieces.push_back({number(i), number(c.k), number(j)});
    } else {
      pieces.push_back({number(i), number(c.k), number(c.l), number(j)});
      collect(c.k, c.l, pieces);
    }
    collect(i, c.k, pieces);
    collect(c.l == 0 ? c.k : c.l, j, pieces);
  }

  const RingCosts& costs_;
  const std::vector<Vec3d>& ring_;
  const std::vector<char>& forbidden_;
  size_t n_;
  std::vector<double> best_;
  std::vector<Choice> choice_;
  std::vector<double> triangle_;
};

/// Of the samples, those to the left of each chord of a ring, from corner to corner.
class LeftOfChords {
 public:
  LeftOfChords(const PatchView& view, const std::vector<Vec3d>& ring)
      : view_(view),
        ring_(ring),
        known_(ring.size() * ring.size(), 0),
        sets_(ring.size() * ring.size() * view.set_size(), 0) {}

  const SampleSet* operator()(size_t from, size_t to) {
    if (!known_[chord(from, to)]) {
      const size_t a = std::min(from, to), b = std::max(from, to);
      view_.part_samples(ring_[a], ring_[b], set(a, b), set(b, a));
      known_[chord(a, b)] = known_[chord(b, a)] = 1;
    }
    return set(from, to);
  }

 private:
  size_t chord(size_t from, size_t to) const { return from * ring_.size() + to; }
  SampleSet* set(size_t from, size_t to) { return sets_.data() + chord(from, to) * view_.set_size(); }

  const PatchView& view_;
  const std::vector<Vec3d>& ring_;
  std::vector<char> known_;
  std::vector<SampleSet> sets_;
};

}  // namespace

PatchPieces partition_ring(const RingCosts& costs, const std::vector<Vec3d>& ring,
                           const std::vector<char>& forbidden) {
  return RingProgram(costs, ring, forbidden).run();
}

PatchPieces partition_ring(const PatchView& view, const std::vector<Vec3d>& ring,
                           const std::vector<char>& forbidden, double most) {
  LeftOfChords left(view, ring);
  const auto triangle = [&](size_t i, size_t j, size_t k) {
    return view.triangle(ring[i], ring[j], ring[k], left(i, j), left(j, k), left(k, i));
  };
  const auto chord = [&](size_t i, size_t j) { return view.chord(ring[i], ring[j]); };
  return partition_ring({triangle, chord, view.costs().triangle, view.costs().quads, most}, ring, forbidden);
}

PatchPieces partition_around(const PatchView& view, const std::vector<Vec3d>& ring, const Vec3d& middle) {
  const size_t n = ring.size();
  const int center = static_cast<int>(n);
  const auto place = [&](size_t i) -> const Vec3d& { return ring[i % n]; };
  const auto number = [&](size_t i) { return static_cast<int>(i % n); };
  std::vector<double> fan(n), triangle(n), quad(n);
  for (size_t i = 0; i < n; ++i) fan[i] = view.triangle(middle, place(i), place(i + 1));
  for (size_t i = 0; i < n; ++i) {
    const double chord = view.chord(middle, place(i));
    triangle[i] = fan[i] + view.costs().triangle + chord;
    const Vec3d &a = place(i), &b = place(i + 1), &c = place(i + 2);
    if (!is_fair_quad(middle, a, b, c))
      quad[i] = infinite;
    else if ((b - middle).sqrnorm() <= (c - a).sqrnorm())
      quad[i] = fan[i] + fan[(i + 1) % n] + chord;
    else
      quad[i] = view.triangle(middle, a, c) + view.triangle(a, b, c) + chord;
  }
  PatchPieces best;
  best.cost = infinite;
  // A quad takes two sides of the ring, so it is enough to begin at either of the first two.
  for (size_t start = 0; start < 2; ++start) {
    std::vector<double> cost(n + 1, infinite);
    std::vector<char> by_quad(n + 1, 0);
    cost[0] = 0;
    for (size_t i = 1; i <= n; ++i) {
      cost[i] = cost[i - 1] + triangle[(start + i - 1) % n];
      if (i >= 2 && view.costs().quads && is_surely_less(cost[i - 2] + quad[(start + i - 2) % n], cost[i])) {
        cost[i] = cost[i - 2] + quad[(start + i - 2) % n];
        by_quad[i] = 1;
      }
    }
    if (!is_surely_less(cost[n], best.cost)) continue;
    std::vector<std::vector<int>> pieces;
    for (size_t i = n; i > 0;) {
      const size_t first = start + i - (by_quad[i] ? 2 : 1);
      pieces.push_back({center, number(first), number(first + 1)});
      if (by_quad[i]) pieces.back().push_back(number(first + 2));
      i -= by_quad[i] ? 2 : 1;
    }
    if (pieces.size() < 3) continue;
    best.cost = cost[n];
    best.pieces = std::move(pieces);
  }
  return best;
}

}  // namespace anisomesh::detail
