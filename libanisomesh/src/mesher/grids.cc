#include "mesher/grids.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "anisomesh/properties.hh"
#include "compare/compare_parts.hh"
#include "mesher/quad_rows.hh"
#include "numerics/shorter_diagonal.hh"
#include "remesh/epsilon_search.hh"

namespace anisomesh::detail {

namespace {

using OpenMesh::EdgeHandle, OpenMesh::FaceHandle, OpenMesh::HalfedgeHandle, OpenMesh::PolyMesh,
    OpenMesh::VertexHandle;

constexpr double kMostAbove = 1.03;  ///< times what is wanted
/// Angles that are the same but for rounding, radians.
constexpr double kSame = 1e-6;
/// Sines of angles to the plane of a flat quad; radians by which it turns at a corner at least.
constexpr double kFlat = 1e-4, kLeastTurn = 0.1;

size_t at(int i) { return static_cast<size_t>(i); }

Origin origin_on(EdgeKind kind) {
  if (kind == EdgeKind::feature) return Origin::feature;
  return kind == EdgeKind::border ? Origin::border : Origin::crossing;
}

/// What build_polygons() writes on a result.
struct ResultProperties {
  explicit ResultProperties(PolyMesh& mesh)
      : origin(provide_property(mesh, property::origin)),
        source_face(provide_property(mesh, property::source_face)),
        source_barycentric(provide_property(mesh, property::source_barycentric)),
        edge_kind(provide_property(mesh, property::edge_kind)) {}
  explicit ResultProperties(const PolyMesh& mesh)
      : origin(require_property(mesh, property::origin)),
        source_face(require_property(mesh, property::source_face)),
        source_barycentric(require_property(mesh, property::source_barycentric)),
        edge_kind(require_property(mesh, property::edge_kind)) {}

  OpenMesh::VPropHandleT<int> origin, source_face;
  OpenMesh::VPropHandleT<Vec3d> source_barycentric;
  OpenMesh::EPropHandleT<int> edge_kind;
};

/// The same to the last bit from the one end and from the other.
Vec3d between(const Vec3d& a, const Vec3d& b, size_t i, size_t parts) {
  if (b < a) return between(b, a, parts - i, parts);
  const double t = static_cast<double>(i) / static_cast<double>(parts);
  return (1 - t) * a + t * b;
}

/// The mesh with its sides divided. Sources of new vertices are those of a corner, to be looked for from
/// there.
class Divided {
 public:
  Divided(const PolyMesh& mesh, QuadRows& rows) : mesh_(mesh), rows_(rows), of_(mesh), of_fine_(fine_) {
    fine_.request_vertex_status();
    fine_.request_edge_status();
    fine_.request_face_status();
    for (const auto v : mesh.vertices()) add(mesh.point(v), mesh.property(of_.origin, v), v);
    for (const auto e : mesh.edges()) divide(e);
    for (const auto f : mesh.faces()) divide(f);
    for (const auto e : fine_.edges())
      fine_.property(of_fine_.edge_kind, e) = static_cast<int>(EdgeKind::conforming);
    for (const auto e : mesh.edges()) hand_down(e);
  }
  PolyMesh take() { return std::move(fine_); }

 private:
  VertexHandle add(const Vec3d& point, int origin, VertexHandle beside) {
    const auto v = fine_.add_vertex(point);
    fine_.property(of_fine_.origin, v) = origin;
    fine_.property(of_fine_.source_face, v) = mesh_.property(of_.source_face, beside);
    fine_.property(of_fine_.source_barycentric, v) = mesh_.property(of_.source_barycentric, beside);
    return v;
  }

  void divide(OpenMesh::SmartEdgeHandle e) {
    const size_t parts = rows_.parts(e);
    std::vector<VertexHandle>& on = on_edge_.emplace_back();
    on.push_back(e.v0());
    const auto of_kind = static_cast<EdgeKind>(mesh_.property(of_.edge_kind, e));
    for (size_t i = 1; i < parts; ++i) {
      on.push_back(add(between(mesh_.point(e.v0()), mesh_.point(e.v1()), i, parts),
                       static_cast<int>(origin_on(of_kind)), 2 * i < parts ? e.v0() : e.v1()));
    }
    on.push_back(e.v1());
  }
  /// From the vertex that a halfedge comes from.
  std::vector<VertexHandle> along(OpenMesh::SmartHalfedgeHandle h) const {
    std::vector<VertexHandle> result = on_edge_[at(h.edge().idx())];
    if (h.edge().v0() != h.from()) std::reverse(result.begin(), result.end());
    return result;
  }

  void divide(OpenMesh::SmartFaceHandle f) {
    if (rows_.is_quad(f)) {
      make_grid(f);
      return;
    }
    PolygonCorners corners;
    size_t middles = 0;
    for (const auto h : f.halfedges()) {
      const auto side = along(h);
      corners.push_back({side[0], false});
      if (side.size() > 2) corners.push_back({side[1], true}), ++middles;
    }
    if (2 * middles == corners.size()) {
      const auto centre =
          add(mesh_.calc_face_centroid(f), static_cast<int>(Origin::isotropic), f.halfedge().from());
      for (size_t i = 1; i < corners.size(); i += 2)
        fine_.add_face(corners[i].vertex, corners[(i + 1) % corners.size()].vertex,
                       corners[(i + 2) % corners.size()].vertex, centre);
      return;
    }
    std::vector<PolygonCorners> pieces;
    part_at_middles(corners, pieces);
    for (const PolygonCorners& piece : pieces) {
      std::vector<VertexHandle> vertices;
      for (const PolygonCorner& corner : piece) vertices.push_back(corner.vertex);
      fine_.add_face(vertices);
    }
  }

  void make_grid(OpenMesh::SmartFaceHandle f) {
    const auto h = f.halfedge();
    const auto low = along(h), right = along(h.next()), high = along(h.next().next().opp()),
               left = along(h.prev().opp());
    const size_t columns = low.size() - 1, rows = right.size() - 1;
    std::vector<VertexHandle> below = low;
    for (size_t j = 1; j <= rows; ++j) {
      std::vector<VertexHandle> here = high;
      if (j < rows) {
        here.front() = left[j];
        here.back() = right[j];
        const double t = static_cast<double>(j) / static_cast<double>(rows);
        for (size_t i = 1; i < columns; ++i)
          here[i] = add((1 - t) * fine_.point(low[i]) + t * fine_.point(high[i]),
                        static_cast<int>(Origin::crossing), nearest_corner(f, i, columns, j, rows));
      }
      for (size_t i = 0; i < columns; ++i) add_quad({below[i], below[i + 1], here[i + 1], here[i]});
      below = here;
    }
  }
  static VertexHandle nearest_corner(OpenMesh::SmartFaceHandle f, size_t i, size_t columns, size_t j,
                                     size_t rows) {
    const auto h = f.halfedge();
    if (2 * j < rows) return 2 * i < columns ? h.from() : h.to();
    return 2 * i < columns ? h.prev().from() : h.next().to();
  }
  void add_quad(const std::array<VertexHandle, 4>& corners) {
    std::vector<int> numbers = {0, 1, 2, 3};
    std::vector<Vec3d> points;
    for (const auto v : corners) points.push_back(fine_.point(v));
    const size_t first = shorter_diagonal(numbers, points);
    fine_.add_face({corners[first], corners[first + 1], corners[(first + 2) % 4], corners[(first + 3) % 4]});
  }

  void hand_down(OpenMesh::SmartEdgeHandle e) {
    const auto& on = on_edge_[at(e.idx())];
    const int of_kind = mesh_.property(of_.edge_kind, e);
    for (size_t i = 0; i + 1 < on.size(); ++i) {
      const auto piece = fine_.edge_handle(fine_.find_halfedge(on[i], on[i + 1]));
      fine_.property(of_fine_.edge_kind, piece) = of_kind;
      fine_.status(piece).set_feature(of_kind == static_cast<int>(EdgeKind::feature));
    }
  }

  const PolyMesh& mesh_;
  QuadRows& rows_;
  PolyMesh fine_;
  const ResultProperties of_, of_fine_;
  std::vector<std::vector<VertexHandle>> on_edge_;  // from v0 to v1 of each edge, these included
};

size_t count_of(const PolyMesh& mesh, bool faces) { return faces ? mesh.n_faces() : mesh.n_vertices(); }

/// A quad may turn in at a corner by a few degrees (PolygonJudge::is_convex()). As a polygon that does no
/// harm, but the rows of its grid would cross there: it is cut from that corner to the one across.
void cut_concave_quads(PolyMesh& mesh) {
  const ResultProperties of(mesh);
  const size_t n = mesh.n_faces();
  for (size_t i = 0; i < n; ++i) {
    const auto f = OpenMesh::make_smart(FaceHandle(static_cast<int>(i)), mesh);
    if (f.valence() != 4) continue;
    const Vec3d normal = mesh.calc_normal(f);
    double least = -kSame;
    OpenMesh::SmartHalfedgeHandle into;  // the corner that turns in most
    for (const auto h : f.halfedges()) {
      const Vec3d in = mesh.calc_edge_vector(h).normalized(),
                  out = mesh.calc_edge_vector(h.next()).normalized();
      const double turn = cross(in, out) | normal;
      if (turn < least) least = turn, into = h;
    }
    if (!into.is_valid() || mesh.find_halfedge(into.to(), into.prev().from()).is_valid()) continue;
    const auto cut = mesh.edge_handle(mesh.insert_edge(into, into.prev()));
    mesh.property(of.edge_kind, cut) = static_cast<int>(EdgeKind::conforming);
    mesh.status(cut).set_feature(false);
  }
}

/// How far the corners of the quad that two triangles make are from right angles at most, radians; infinite
/// where they make none that is convex and flat.
double askew(const PolyMesh& mesh, HalfedgeHandle h) {
  const auto other = mesh.opposite_halfedge_handle(h);
  const std::array corners = {mesh.point(mesh.from_vertex_handle(h)),
                              mesh.point(mesh.to_vertex_handle(mesh.next_halfedge_handle(other))),
                              mesh.point(mesh.to_vertex_handle(h)),
                              mesh.point(mesh.to_vertex_handle(mesh.next_halfedge_handle(h)))};
  const Vec3d normal = cross(corners[2] - corners[0], corners[3] - corners[1]).normalized();
  double most = 0;
  for (size_t i = 0; i < 4; ++i) {
    const Vec3d in = (corners[i] - corners[(i + 3) % 4]).normalized(),
                out = (corners[(i + 1) % 4] - corners[i]).normalized();
    const double turn = std::atan2(cross(in, out) | normal, in | out);
    const bool flat = std::max(std::abs(in | normal), std::abs(out | normal)) < kFlat;
    if (!flat || !(turn > kLeastTurn)) return std::numeric_limits<double>::infinity();
    most = std::max(most, std::abs(turn - 0.5 * M_PI));
  }
  return most;
}

/// Flat pairs of triangles, nothing but a cut between them, become quads, the most rectangular first.
void pair_flat_triangles(PolyMesh& mesh) {
  const ResultProperties of(mesh);
  std::vector<std::pair<double, EdgeHandle>> cuts;
  for (const auto e : mesh.edges()) {
    const auto kind = static_cast<EdgeKind>(mesh.property(of.edge_kind, e));
    if (e.is_boundary() || kind == EdgeKind::feature || kind == EdgeKind::border) continue;
    if (e.h0().face().valence() != 3 || e.h1().face().valence() != 3) continue;
    const double askew_by = askew(mesh, e.h0());
    if (std::isfinite(askew_by)) cuts.emplace_back(std::round(askew_by / kSame) * kSame, e);
  }
  std::sort(cuts.begin(), cuts.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : a.second.idx() < b.second.idx();
  });
  std::vector<char> paired(mesh.n_faces(), 0);
  for (const auto& [askew_by, e] : cuts) {
    const auto a = at(mesh.face_handle(mesh.halfedge_handle(e, 0)).idx()),
               b = at(mesh.face_handle(mesh.halfedge_handle(e, 1)).idx());
    if (paired[a] || paired[b]) continue;
    paired[a] = paired[b] = 1;
    mesh.remove_edge(e);
  }
  mesh.garbage_collection();
}

/// Vertices from `first` on are moved to the surface.
void put_on_surface(const ReferenceSurface& reference, size_t first, PolyMesh& mesh) {
  const ResultProperties of(mesh);
  for (size_t i = first; i < mesh.n_vertices(); ++i) {
    const VertexHandle v(static_cast<int>(i));
    const auto foot = reference.tree.closest(mesh.point(v));
    mesh.property(of.source_face, v) = foot.triangle;
    mesh.property(of.source_barycentric, v) = foot.barycentric;
    mesh.set_point(v, foot.point);
  }
}

}  // namespace

bool divide_into_grids(const SurfaceRef& surface, const MeshOptions& options, size_t faces, size_t vertices,
                       PolyMesh& result, MeshReport& report) {
  const bool by_faces = faces > 0;
  const auto wanted = static_cast<double>(by_faces ? faces : vertices);
  if (options.max_degree != 4 || !options.convex) return false;
  if (static_cast<double>(count_of(result, by_faces)) >= (1 - kMet) * wanted) return false;
  const auto most = static_cast<size_t>(kMostAbove * wanted);
  PolyMesh fine = result;
  cut_concave_quads(fine);
  pair_flat_triangles(fine);
  const auto divide = [&](auto choose) {
    QuadRows rows(fine);
    if (!choose(rows)) return;
    PolyMesh divided = Divided(fine, rows).take();
    fine = std::move(divided);
  };
  divide([&](QuadRows& rows) {  // all of it into quads, where there may be as many
    rows.halve_all();
    return rows.has_others() && rows.count(by_faces) <= most;
  });
  divide([&](QuadRows& rows) {
    rows.divide(most, by_faces);
    return true;
  });
  const ReferenceSurface reference(surface);
  put_on_surface(reference, result.n_vertices(), fine);
  const auto folded = folded_faces(reference, PolygonSoup(fine, FaceDiagonal::shorter));
  if (std::find(folded.begin(), folded.end(), 1) != folded.end()) return false;
  result = std::move(fine);
  report.vertices = result.n_vertices();
  report.faces = result.n_faces();
  report.triangles = report.quads = 0;
  for (const auto f : result.faces()) {
    report.triangles += f.valence() == 3;
    report.quads += f.valence() == 4;
  }
  return true;
}

}  // namespace anisomesh::detail
