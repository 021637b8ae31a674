#include "numerics/conformal_map.hh"

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>

#include "numerics/sparse_solver.hh"

namespace anisomesh::detail {

namespace {

constexpr double pi = 3.14159265358979323846;

struct Edge {
  int from = 0, to = 0;
  double weight = 0;  ///< half the cotangent facing it, one entry for each side
};

std::vector<Edge> cotangent_edges(const Patch& patch, const std::vector<TriangleShape>& shapes) {
  std::vector<Edge> edges;
  edges.reserve(3 * shapes.size());
  for (size_t t = 0; t < shapes.size(); ++t)
    for (size_t i = 0; i < 3; ++i)
      edges.push_back(
          {patch.triangles[t][(i + 1) % 3], patch.triangles[t][(i + 2) % 3], 0.5 * shapes[t].cotangent[i]});
  return edges;
}

/// Both sides' weights in one entry, and none below `least`: positive weights keep Tutte's guarantee where
/// the triangulation is not Delaunay.
std::vector<Edge> positive_edges(std::vector<Edge> edges, double least) {
  for (Edge& e : edges)
    if (e.from > e.to) std::swap(e.from, e.to);
  std::sort(edges.begin(), edges.end(),
            [](const Edge& a, const Edge& b) { return std::tie(a.from, a.to) < std::tie(b.from, b.to); });
  std::vector<Edge> merged;
  for (const Edge& e : edges) {
    if (!merged.empty() && merged.back().from == e.from && merged.back().to == e.to)
      merged.back().weight += e.weight;
    else
      merged.push_back(e);
  }
  for (Edge& e : merged) e.weight = std::min(std::max(e.weight, least), 1 / least);
  return merged;
}

/// The Laplace equation with given values on the border.
class DirichletProblem {
 public:
  DirichletProblem(const Patch& patch, std::vector<Edge> edges)
      : edges_(std::move(edges)), unknown_(patch.points.size(), 0) {
    for (const int b : patch.border) unknown_[static_cast<size_t>(b)] = -1;
    for (int& u : unknown_)
      if (u == 0) u = unknowns_++;
    SymmetricEntries matrix(static_cast<size_t>(unknowns_));
    matrix.reserve(edges_.size());
    for (const Edge& e : edges_) {
      const int i = index(e.from), j = index(e.to);
      if (i >= 0) matrix.add(i, i, e.weight);
      if (j >= 0) matrix.add(j, j, e.weight);
      if (i >= 0 && j >= 0) matrix.add(i, j, -e.weight);
    }
    if (unknowns_ > 0) solver_ = std::make_unique<CholeskySolver>(matrix);
  }

  /// Overwrites the interior values by the solution of (A values)_i = source_i; no sources: harmonic.
  void solve(std::vector<double>& values, const std::vector<double>* source = nullptr) const {
    if (unknowns_ == 0) return;
    std::vector<double> right(static_cast<size_t>(unknowns_), 0.0);
    for (const Edge& e : edges_) {
      const int i = index(e.from), j = index(e.to);
      if (i >= 0 && j < 0) right[static_cast<size_t>(i)] += e.weight * values[static_cast<size_t>(e.to)];
      if (j >= 0 && i < 0) right[static_cast<size_t>(j)] += e.weight * values[static_cast<size_t>(e.from)];
    }
    for (size_t v = 0; source && v < unknown_.size(); ++v)
      if (unknown_[v] >= 0) right[static_cast<size_t>(unknown_[v])] += (*source)[v];
    const auto solution = solver_->solve(right);
    for (size_t v = 0; v < unknown_.size(); ++v)
      if (unknown_[v] >= 0) values[v] = solution[static_cast<size_t>(unknown_[v])];
  }

  /// A values, at every vertex.
  std::vector<double> apply(const std::vector<double>& values) const {
    std::vector<double> result(values.size(), 0.0);
    for (const Edge& e : edges_) {
      const double flow =
          e.weight * (values[static_cast<size_t>(e.from)] - values[static_cast<size_t>(e.to)]);
      result[static_cast<size_t>(e.from)] += flow;
      result[static_cast<size_t>(e.to)] -= flow;
    }
    return result;
  }

 private:
  int index(int vertex) const { return unknown_[static_cast<size_t>(vertex)]; }
  std::vector<Edge> edges_;
  std::vector<int> unknown_;
  int unknowns_ = 0;
  std::unique_ptr<CholeskySolver> solver_;
};

/// Gaussian curvature of the interior vertices (2 pi minus the angles around them), geodesic curvature of the
/// border vertices (pi minus the angles).
std::vector<double> angle_defects(const Patch& patch, const std::vector<TriangleShape>& shapes) {
  std::vector<double> defect(patch.points.size(), 2 * pi);
  for (const int b : patch.border) defect[static_cast<size_t>(b)] = pi;
  for (size_t t = 0; t < shapes.size(); ++t)
    for (size_t i = 0; i < 3; ++i) defect[static_cast<size_t>(patch.triangles[t][i])] -= shapes[t].angle[i];
  return defect;
}

/// Length of the border edge from border[i] to border[i + 1].
std::vector<double> border_lengths(const Patch& patch) {
  const size_t n = patch.border.size();
  std::vector<double> lengths(n);
  double sum = 0;
  for (size_t i = 0; i < n; ++i)
    sum += lengths[i] = (patch.points[static_cast<size_t>(patch.border[(i + 1) % n])] -
                         patch.points[static_cast<size_t>(patch.border[i])])
                            .norm();
  for (double& length : lengths) length = std::max(length, 1e-9 * sum / static_cast<double>(n));
  return lengths;
}

/// The closed curve with these turning angles at its vertices (their sum is 2 pi) whose edge lengths differ
/// least from the given ones.
std::vector<Vec2d> closed_curve(const std::vector<double>& turning, std::vector<double> lengths) {
  const size_t n = turning.size();
  std::vector<Vec2d> tangent(n);
  double angle = 0, xx = 0, xy = 0, yy = 0;
  Vec2d gap(0, 0);
  for (size_t i = 0; i < n; ++i) {
    if (i > 0) angle += turning[i];
    const Vec2d t(std::cos(angle), std::sin(angle));
    tangent[i] = t;
    gap += lengths[i] * t;
    xx += lengths[i] * t[0] * t[0];
    xy += lengths[i] * t[0] * t[1];
    yy += lengths[i] * t[1] * t[1];
  }
  // Least squares with edges weighed by 1 / length [Sawhney and Crane 2017, section 4.3.1].
  const double determinant = xx * yy - xy * xy;
  const Vec2d multiplier((yy * gap[0] - xy * gap[1]) / determinant,
                         (xx * gap[1] - xy * gap[0]) / determinant);
  std::vector<Vec2d> curve(n);
  Vec2d place(0, 0);
  for (size_t i = 0; i < n; ++i) {
    curve[i] = place;
    place += lengths[i] * (1 - (tangent[i] | multiplier)) * tangent[i];
  }
  return curve;
}

/// Turning angles of a border that a conformal map of the disc gives where the scale factor on the border is
/// 1 (the Yamabe equation with Dirichlet data 0).
std::vector<double> isometric_turning(const Patch& patch, const DirichletProblem& problem,
                                      const std::vector<double>& defects) {
  std::vector<double> source(defects), scale(defects.size(), 0.0);
  for (double& s : source) s = -s;
  problem.solve(scale, &source);
  const auto flow = problem.apply(scale);
  std::vector<double> turning;
  turning.reserve(patch.border.size());
  for (const int b : patch.border)
    turning.push_back(defects[static_cast<size_t>(b)] + flow[static_cast<size_t>(b)]);
  return turning;
}

/// Scale factors (logarithms) on the border for given turning angles: the Yamabe equation with Neumann data.
class NeumannProblem {
 public:
  NeumannProblem(const Patch& patch, const std::vector<Edge>& edges, const std::vector<double>& defects)
      : patch_(patch), defects_(defects) {
    // The last vertex is pinned to 0: only differences of the result matter.
    SymmetricEntries matrix(defects.size() - 1);
    matrix.reserve(edges.size());
    const int pinned = static_cast<int>(matrix.size());
    for (const Edge& e : edges) {
      if (e.from != pinned) matrix.add(e.from, e.from, e.weight);
      if (e.to != pinned) matrix.add(e.to, e.to, e.weight);
      if (e.from != pinned && e.to != pinned) matrix.add(e.from, e.to, -e.weight);
    }
    solver_ = std::make_unique<CholeskySolver>(matrix);
  }

  /// One value a border vertex, their mean 0.
  std::vector<double> border_scale(const std::vector<double>& turning) const {
    std::vector<double> right(defects_);
    for (double& r : right) r = -r;
    for (size_t i = 0; i < turning.size(); ++i) right[static_cast<size_t>(patch_.border[i])] += turning[i];
    right.pop_back();
    auto solution = solver_->solve(right);
    solution.push_back(0);
    std::vector<double> scale;
    double sum = 0;
    for (const int b : patch_.border) {
      scale.push_back(solution[static_cast<size_t>(b)]);
      sum += scale.back();
    }
    for (double& s : scale) s -= sum / static_cast<double>(scale.size());
    return scale;
  }

 private:
  const Patch& patch_;
  const std::vector<double>& defects_;
  std::unique_ptr<CholeskySolver> solver_;
};

std::vector<double> scaled_lengths(const std::vector<double>& lengths, const std::vector<double>& scale) {
  const size_t n = lengths.size();
  std::vector<double> result(n);
  for (size_t i = 0; i < n; ++i) result[i] = lengths[i] * std::exp(0.5 * (scale[i] + scale[(i + 1) % n]));
  return result;
}

/// Turning proportional to length: that of a circle.
std::vector<double> circular_turning(const std::vector<double>& lengths) {
  const size_t n = lengths.size();
  double sum = 0;
  for (const double length : lengths) sum += length;
  std::vector<double> turning(n);
  for (size_t i = 0; i < n; ++i) turning[i] = pi * (lengths[i] + lengths[(i + n - 1) % n]) / sum;
  return turning;
}

/// Lengths the border edges have in a conformal map to the disc, by iteration: curvature from lengths, scale
/// from curvature. [Sawhney and Crane 2017, section 6.2]
std::vector<double> disc_lengths(const std::vector<double>& lengths, const NeumannProblem& neumann) {
  std::vector<double> current = lengths;
  for (int i = 0; i < 10; ++i)
    current = scaled_lengths(lengths, neumann.border_scale(circular_turning(current)));
  return current;
}

std::vector<Vec2d> harmonic_map(const Patch& patch, const DirichletProblem& problem,
                                const std::vector<Vec2d>& border) {
  std::vector<double> coordinate[2];
  for (int k = 0; k < 2; ++k) {
    coordinate[k].assign(patch.points.size(), 0.0);
    for (size_t i = 0; i < border.size(); ++i)
      coordinate[k][static_cast<size_t>(patch.border[i])] = border[i][k];
    problem.solve(coordinate[k]);
  }
  std::vector<Vec2d> map(patch.points.size());
  for (size_t v = 0; v < map.size(); ++v) map[v] = {coordinate[0][v], coordinate[1][v]};
  return map;
}

}  // namespace

std::vector<Vec2d> boundary_first_map(const Patch& patch, const std::vector<TriangleShape>& shapes,
                                      double roundness) {
  const auto edges = cotangent_edges(patch, shapes);
  const auto defects = angle_defects(patch, shapes);
  const DirichletProblem problem(patch, edges);
  auto turning = isometric_turning(patch, problem, defects);
  auto lengths = border_lengths(patch);
  if (roundness > 0) {
    const NeumannProblem neumann(patch, edges, defects);
    const auto circle = circular_turning(disc_lengths(lengths, neumann));
    for (size_t i = 0; i < turning.size(); ++i) turning[i] += roundness * (circle[i] - turning[i]);
    lengths = scaled_lengths(lengths, neumann.border_scale(turning));
  }
  return harmonic_map(patch, problem, closed_curve(turning, lengths));
}

std::vector<Vec2d> disc_map(const Patch& patch, const std::vector<TriangleShape>& shapes) {
  const auto edges = cotangent_edges(patch, shapes);
  const auto defects = angle_defects(patch, shapes);
  const auto lengths = disc_lengths(border_lengths(patch), NeumannProblem(patch, edges, defects));
  double sum = 0;
  for (const double length : lengths) sum += length;
  std::vector<Vec2d> circle;
  double arc = 0;
  for (const double length : lengths) {
    circle.emplace_back(std::cos(2 * pi * arc / sum), std::sin(2 * pi * arc / sum));
    arc += length;
  }
  return harmonic_map(patch, DirichletProblem(patch, positive_edges(edges, 0.02)), circle);
}

}  // namespace anisomesh::detail
