#include "mesher/plane_cells.hh"

#include <algorithm>

#include "anisomesh/errors.hh"
#include "numerics/arrangement.hh"

namespace anisomesh::detail {

namespace {

using Triangle = Arrangement::Triangle;
size_t at(int i) { return static_cast<size_t>(i); }

double turn(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

class PlaneCells {
 public:
  PlaneCells(const NetworkGraph& network, const SurfaceRef& surface, const UvLocator& locator)
      : network_(network), surface_(surface), locator_(locator) {}

  std::vector<Cell> run(bool probes) {
    triangulate();
    flood_all();
    gather_samples();
    if (probes) gather_probes();
    return std::move(cells_);
  }

 private:
  static constexpr int unseen = -2, outside = -1;

  void triangulate();
  void flood_all();
  std::vector<int> flood(int start, int cell);
  void add_cell(const std::vector<int>& triangles);
  int cell_at(const Vec2d& uv);
  int locate(const Vec2d& uv);
  const Vec2d& uv_of(int node) const { return node < 0 ? box_[at(-1 - node)] : network_.graph.uv(node); }
  void gather_samples();
  void gather_probes();
  // A sample that no edge leads to; others are part of the network already.
  bool is_free_sample(int node) const { return network_.fixed[at(node)] && network_.graph.degree(node) == 0; }

  const NetworkGraph& network_;
  const SurfaceRef& surface_;
  const UvLocator& locator_;
  // Their nodes are those of the network, edge >= 0 says it is a constraint.
  std::vector<Triangle> triangles_;
  std::array<Vec2d, 4> box_;
  std::vector<int> cell_of_;
  std::vector<Cell> cells_;
  int last_ = 0;
};

void PlaneCells::triangulate() {
  const PlanarGraph& graph = network_.graph;
  std::vector<int> used;
  for (int n = 0; n < static_cast<int>(graph.n_nodes()); ++n)
    if (graph.degree(n) > 0) used.push_back(n);
  Vec2d low = graph.uv(used.front()), high = low;
  for (const int n : used) {
    low.minimize(graph.uv(n));
    high.maximize(graph.uv(n));
  }
  Arrangement arrangement(low, high);
  std::vector<int> local(graph.n_nodes(), -1);
  for (const int n : used) local[at(n)] = arrangement.insert_point(graph.uv(n));
  for (size_t e = 0; e < graph.n_edges(); ++e) {
    const auto& edge = graph.edge(static_cast<int>(e));
    if (edge.alive)
      arrangement.insert_segment(local[at(edge.node[0])], local[at(edge.node[1])], edge.kind, 0);
  }
  if (arrangement.graph().n_nodes() != used.size())
    throw CannotProcess("the decimated network of lines is not planar; the parameterization is degenerate");
  triangles_ = arrangement.triangles();
  for (Triangle& t : triangles_)
    for (int& n : t.node) n = n < 0 ? n : used[at(n)];
  for (int i = 0; i < 4; ++i) box_[at(i)] = arrangement.box_corner(-1 - i);
}

// Outside is what is connected to the corners of the box.
void PlaneCells::flood_all() {
  cell_of_.assign(triangles_.size(), unseen);
  for (size_t t = 0; t < triangles_.size(); ++t) {
    const auto& node = triangles_[t].node;
    if (cell_of_[t] == unseen && *std::min_element(node.begin(), node.end()) < 0)
      flood(static_cast<int>(t), outside);
  }
  for (size_t t = 0; t < triangles_.size(); ++t)
    if (cell_of_[t] == unseen) add_cell(flood(static_cast<int>(t), static_cast<int>(cells_.size())));
}

void PlaneCells::add_cell(const std::vector<int>& triangles) {
  Cell cell;
  for (const int i : triangles) {
    const Triangle& t = triangles_[at(i)];
    cell.triangles.push_back(t.node);
    for (size_t k = 0; k < 3; ++k)
      if (t.edge[k] >= 0) cell.sides.push_back({t.node[(k + 1) % 3], t.node[(k + 2) % 3]});
  }
  cells_.push_back(std::move(cell));
}

std::vector<int> PlaneCells::flood(int start, int cell) {
  std::vector<int> found{start};
  cell_of_[at(start)] = cell;
  for (size_t i = 0; i < found.size(); ++i) {
    const Triangle& t = triangles_[at(found[i])];
    for (size_t k = 0; k < 3; ++k) {
      const int next = t.neighbor[k];
      if (next < 0 || t.edge[k] >= 0 || cell_of_[at(next)] != unseen) continue;
      cell_of_[at(next)] = cell;
      found.push_back(next);
    }
  }
  return found;
}

// The triangle at a point, by walking from the last one found; -1 outside the box.
int PlaneCells::locate(const Vec2d& uv) {
  int t = last_;
  for (size_t step = 0; step <= triangles_.size(); ++step) {
    const Triangle& triangle = triangles_[at(t)];
    int next = -2;
    for (size_t i = 0; i < 3 && next == -2; ++i) {
      const size_t k = (i + step) % 3;
      if (turn(uv_of(triangle.node[(k + 1) % 3]), uv_of(triangle.node[(k + 2) % 3]), uv) < 0)
        next = triangle.neighbor[k];
    }
    if (next == -2) break;
    if (next < 0) return -1;
    t = next;
  }
  last_ = t;
  return t;
}

int PlaneCells::cell_at(const Vec2d& uv) {
  const int t = locate(uv);
  return t < 0 ? outside : cell_of_[at(t)];
}

void PlaneCells::gather_samples() {
  for (int n = 0; n < static_cast<int>(network_.graph.n_nodes()); ++n) {
    if (!is_free_sample(n)) continue;
    const int cell = cell_at(network_.graph.uv(n));
    if (cell >= 0) cells_[at(cell)].samples.push_back(n);
  }
}

// The surface is linear between its vertices, so they are where it is farthest from a polygon.
void PlaneCells::gather_probes() {
  const auto& mesh = surface_.connectivity();
  for (const auto f : mesh.faces()) {  // by faces: neighbours are near each other, and vertices in no order
    const auto corners = surface_.corners(f);
    for (size_t k = 0; k < 3; ++k) {
      const auto v = corners.vertex[k];
      if (mesh.is_boundary(v) || mesh.face_handle(mesh.halfedge_handle(v)) != f) continue;
      const int cell = cell_at(locator_.uv(v));
      if (cell < 0) continue;
      Probe probe;
      probe.uv = locator_.uv(v);
      probe.position = surface_.point(v);
      probe.point.face = f;
      probe.point.barycentric[k] = 1;
      cells_[at(cell)].probes.push_back(probe);
    }
  }
}

}  // namespace

std::vector<Cell> plane_cells(const NetworkGraph& network, const SurfaceRef& surface,
                              const UvLocator& locator, bool probes) {
  return PlaneCells(network, surface, locator).run(probes);
}

}  // namespace anisomesh::detail
