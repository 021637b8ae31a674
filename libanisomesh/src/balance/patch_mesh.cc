#include "balance/patch_mesh.hh"

#include <algorithm>

#include "anisomesh/mesher.hh"
#include "anisomesh/properties.hh"
#include "surface/on_segment.hh"

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

bool contains(const std::vector<int>& values, int value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

}  // namespace

PatchMesh::PatchMesh(const OpenMesh::PolyMesh& mesh) : vertices_(mesh.n_vertices()) {
  const auto origin = require_property(mesh, property::origin);
  const auto face = require_property(mesh, property::source_face);
  const auto barycentric = require_property(mesh, property::source_barycentric);
  const auto kind = require_property(mesh, property::edge_kind);
  for (const auto v : mesh.vertices())
    vertices_[at(v.idx())] = {mesh.point(v),
                              mesh.property(origin, v),
                              {OpenMesh::FaceHandle(mesh.property(face, v)), mesh.property(barycentric, v)},
                              false,
                              {}};
  for (const auto e : mesh.edges()) {
    const int v = e.v0().idx(), w = e.v1().idx();
    kind_[key(v, w)] = mesh.property(kind, e);
    if (!mesh.is_boundary(e) && !(mesh.has_edge_status() && mesh.status(e).feature())) continue;
    curve_[key(v, w)] = 1;
    vertices_[at(v)].on_curve = vertices_[at(w)].on_curve = true;
  }
  for (const auto f : mesh.faces()) {
    polygons_.emplace_back();
    for (const auto v : mesh.fv_range(f)) {
      polygons_.back().push_back(v.idx());
      vertices_[at(v.idx())].polygons.push_back(f.idx());
    }
    heirs_.push_back({f.idx(), f.idx() + 1});
  }
}

bool PatchMesh::is_on_curve(int v, int w) const {
  return vertices_[at(v)].on_curve && vertices_[at(w)].on_curve && curve_.count(key(v, w)) > 0;
}

int PatchMesh::across(int v, int w) const {
  if (is_on_curve(v, w)) return -1;
  for (const int p : vertices_[at(w)].polygons) {
    const auto& polygon = polygons_[at(p)];
    for (size_t i = 0; i < polygon.size(); ++i)
      if (polygon[i] == w && polygon[(i + 1) % polygon.size()] == v) return p;
  }
  return -1;
}

std::vector<int> PatchMesh::around(int polygon) const {
  const auto& corners = polygons_[static_cast<size_t>(polygon)];
  std::vector<int> result;
  for (size_t i = 0; i < corners.size(); ++i) {
    const int q = across(corners[i], corners[(i + 1) % corners.size()]);
    if (q >= 0 && std::find(result.begin(), result.end(), q) == result.end()) result.push_back(q);
  }
  return result;
}

PatchMesh::Patch PatchMesh::star(int vertex) const {
  if (vertices_[at(vertex)].on_curve || vertices_[at(vertex)].polygons.empty()) return {};
  Patch patch = with_ring(vertices_[at(vertex)].polygons);
  if (contains(patch.ring, vertex)) patch.ring.clear();
  return patch;
}

PatchMesh::Patch PatchMesh::join(const std::vector<int>& polygons) const { return with_ring(polygons); }

PatchMesh::Patch PatchMesh::with_ring(std::vector<int> polygons) const {
  Patch patch{std::move(polygons), {}};
  std::vector<std::pair<int, int>> all, sides;
  for (const int p : patch.polygons) {
    const auto& polygon = polygons_[at(p)];
    for (size_t i = 0; i < polygon.size(); ++i)
      all.emplace_back(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  for (const auto& [v, w] : all)
    if (is_on_curve(v, w) || std::find(all.begin(), all.end(), std::make_pair(w, v)) == all.end())
      sides.emplace_back(v, w);
  if (sides.empty()) return patch;
  std::sort(sides.begin(), sides.end());
  std::vector<int> ring;
  for (int v = sides.front().first;;) {
    const auto next = std::lower_bound(sides.begin(), sides.end(), std::make_pair(v, -1));
    if (next == sides.end() || next->first != v) return patch;
    if (next + 1 != sides.end() && (next + 1)->first == v) return patch;  // passes the vertex twice
    ring.push_back(v);
    v = next->second;
    if (v == ring.front()) break;
    if (ring.size() > sides.size()) return patch;
  }
  if (ring.size() == sides.size()) patch.ring = std::move(ring);
  return patch;
}

bool PatchMesh::joined_outside(const Patch& patch, int v, int w) const {
  if (v < 0 || w < 0) return false;
  for (const int p : vertices_[at(v)].polygons) {
    if (contains(patch.polygons, p)) continue;
    const auto& polygon = polygons_[at(p)];
    for (size_t i = 0; i < polygon.size(); ++i) {
      const int a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      if ((a == v && b == w) || (a == w && b == v)) return true;
    }
  }
  return false;
}

// Along a straight feature, say: on both sides of a fin that ends in one its polygons would share that edge.
bool PatchMesh::passes_a_vertex(int v, int w, const std::vector<int>& but) const {
  const auto beside = [&](int u, const auto& visit) {
    for (const int p : vertices_[at(u)].polygons) {
      const auto& polygon = polygons_[at(p)];
      const size_t n = polygon.size(),
                   i = at(static_cast<int>(std::find(polygon.begin(), polygon.end(), u) - polygon.begin()));
      visit(polygon[(i + 1) % n]), visit(polygon[(i + n - 1) % n]);
    }
  };
  bool found = false;
  beside(v, [&](int m) {
    if (m == w || contains(but, m) || !is_on_segment(point(m), point(v), point(w))) return;
    beside(w, [&](int k) { found |= k == m; });
  });
  return found;
}

int PatchMesh::edges_outside(const Patch& patch, int v) const {
  std::vector<int> ends, inside;
  for (const int p : vertices_[at(v)].polygons) {
    const auto& polygon = polygons_[at(p)];
    auto& found = contains(patch.polygons, p) ? inside : ends;
    for (size_t i = 0; i < polygon.size(); ++i) {
      if (polygon[i] != v) continue;
      found.push_back(polygon[(i + 1) % polygon.size()]);
      found.push_back(polygon[(i + polygon.size() - 1) % polygon.size()]);
    }
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return static_cast<int>(
      std::count_if(ends.begin(), ends.end(), [&](int w) { return !contains(inside, w); }));
}

// Vertices of the polygons that are not of the ring, so that they go with them.
std::vector<int> PatchMesh::inner_vertices(const Patch& patch) const {
  std::vector<int> inside;
  for (const int p : patch.polygons)
    for (const int v : polygons_[at(p)])
      if (!contains(patch.ring, v) && !contains(inside, v)) inside.push_back(v);
  return inside;
}

std::vector<char> PatchMesh::forbidden_chords(const Patch& patch) const {
  const size_t n = patch.ring.size();
  std::vector<char> forbidden(n * n, 0);
  for (size_t i = 0; i < n; ++i)
    for (size_t j = i + 2; j < n; ++j)
      forbidden[i * n + j] = joined_outside(patch, patch.ring[i], patch.ring[j]);
  return forbidden;
}

bool PatchMesh::may_replace(const Patch& patch, const std::vector<std::vector<int>>& pieces) const {
  const size_t n = patch.ring.size();
  const std::vector<int> inside = inner_vertices(patch);
  const auto may_join = [&](int v, int w) {
    return !joined_outside(patch, v, w) && !passes_a_vertex(v, w, inside);
  };
  if (patch.bridge[0] >= 0 && !may_join(patch.bridge[0], patch.bridge[1])) return false;
  std::vector<int> edges(n, 1);  // of k pieces at a vertex of the ring: k + 1
  for (const auto& piece : pieces)
    for (size_t i = 0; i < piece.size(); ++i) {
      const int v = piece[i], w = piece[(i + 1) % piece.size()];
      const auto in_ring = std::find(patch.ring.begin(), patch.ring.end(), v);
      if (in_ring == patch.ring.end()) continue;
      const auto place = static_cast<size_t>(in_ring - patch.ring.begin());
      ++edges[place];
      const bool side = patch.ring[(place + 1) % n] == w || patch.ring[(place + n - 1) % n] == w;
      if (w >= 0 && !side && !may_join(v, w)) return false;
    }
  for (size_t i = 0; i < n; ++i)
    if (!vertices_[at(patch.ring[i])].on_curve && edges[i] + edges_outside(patch, patch.ring[i]) < 3)
      return false;
  return true;
}

int PatchMesh::add_vertex(const Vec3d& point, const SurfacePoint& source) {
  vertices_.push_back({point, static_cast<int>(Origin::isotropic), source, false, {}});
  return static_cast<int>(vertices_.size()) - 1;
}

void PatchMesh::replace(const Patch& patch, const std::vector<std::vector<int>>& pieces,
                        size_t on_first_side) {
  const int first = static_cast<int>(polygons_.size()), end = first + static_cast<int>(pieces.size()),
            middle = first + static_cast<int>(on_first_side);
  if (const auto [v, w] = patch.bridge; v >= 0) {
    const std::vector<int> gone = inner_vertices(patch);
    kind_[key(v, w)] = kind_.at(key(v, gone.front()));
    curve_[key(v, w)] = 1;
  }
  for (size_t i = 0; i < patch.polygons.size(); ++i) {
    const int p = patch.polygons[i];
    for (const int v : polygons_[at(p)]) {
      auto& at_vertex = vertices_[at(v)].polygons;
      at_vertex.erase(std::remove(at_vertex.begin(), at_vertex.end(), p), at_vertex.end());
    }
    polygons_[at(p)].clear();
    if (at(p) >= heirs_.size()) continue;
    if (patch.on_first_side == 0)
      heirs_[at(p)] = {first, end};
    else
      heirs_[at(p)] = i < patch.on_first_side ? PolygonRange{first, middle} : PolygonRange{middle, end};
  }
  for (const auto& piece : pieces) {
    const int p = static_cast<int>(polygons_.size());
    polygons_.push_back(piece);
    for (const int v : piece) vertices_[at(v)].polygons.push_back(p);
  }
}

std::vector<PolygonRange> PatchMesh::heirs() const {
  std::vector<int> number{0};
  for (const auto& polygon : polygons_) number.push_back(number.back() + !polygon.empty());
  std::vector<PolygonRange> heirs = heirs_;
  for (auto& range : heirs) range = {number[at(range.begin)], number[at(range.end)]};
  return heirs;
}

OpenMesh::PolyMesh PatchMesh::mesh() const {
  OpenMesh::PolyMesh mesh;
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  const auto origin = provide_property(mesh, property::origin);
  const auto face = provide_property(mesh, property::source_face);
  const auto barycentric = provide_property(mesh, property::source_barycentric);
  const auto kind = provide_property(mesh, property::edge_kind);
  std::vector<OpenMesh::VertexHandle> handle(vertices_.size());
  std::vector<int> number;
  for (size_t v = 0; v < vertices_.size(); ++v) {
    if (vertices_[v].polygons.empty()) continue;
    handle[v] = mesh.add_vertex(vertices_[v].point);
    number.push_back(static_cast<int>(v));
    mesh.property(origin, handle[v]) = vertices_[v].origin;
    mesh.property(face, handle[v]) = vertices_[v].source.face.idx();
    mesh.property(barycentric, handle[v]) = vertices_[v].source.barycentric;
  }
  std::vector<OpenMesh::VertexHandle> corners;
  for (const auto& polygon : polygons_) {
    if (polygon.empty()) continue;
    corners.clear();
    for (const int v : polygon) corners.push_back(handle[at(v)]);
    if (!mesh.add_face(corners).is_valid())
      throw CannotProcess("a polygon at vertex " + std::to_string(corners.front().idx()) +
                          " of the result would not be manifold");
  }
  for (const auto e : mesh.edges()) {
    const auto k = key(number[at(e.v0().idx())], number[at(e.v1().idx())]);
    const auto known = kind_.find(k);
    mesh.property(kind, e) = known != kind_.end() ? known->second : static_cast<int>(EdgeKind::conforming);
    mesh.status(e).set_feature(mesh.property(kind, e) == static_cast<int>(EdgeKind::feature));
  }
  return mesh;
}

}  // namespace anisomesh::detail
