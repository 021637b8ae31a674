#include "surface/canonical_copy.hh"

#include <algorithm>

#include "anisomesh/properties.hh"
#include "surface/unfit_mesh.hh"

namespace anisomesh::detail {

namespace {

using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::TriConnectivity;
using OpenMesh::VertexHandle;

Vec3d shifted(const Vec3d& barycentric, int shift) {
  Vec3d there;
  for (int k = 0; k < 3; ++k)
    there[static_cast<size_t>((k + shift) % 3)] = barycentric[static_cast<size_t>(k)];
  return there;
}

/// Diagonals away from which on rounding of coordinates would be felt.
constexpr double kFar = 16;

/// Copies properties from one mesh to another; those that are not there are removed.
class PropertyCopier {
 public:
  PropertyCopier(TriConnectivity& from, TriConnectivity& to) : from_(from), to_(to) {}

  /// \param transport copies all values from the first handle to the second
  template <class PropertyHandle, class Transport>
  void copy(const PropertyDeclaration<PropertyHandle>& declaration, Transport transport) {
    if (has_property(from_, declaration)) {
      transport(require_property(from_, declaration), provide_property(to_, declaration));
    } else if (has_property(to_, declaration)) {
      auto handle = require_property(to_, declaration);
      to_.remove_property(handle);
    }
  }

 private:
  TriConnectivity &from_, &to_;
};

}  // namespace

CanonicalCopy::CanonicalCopy(const SurfaceRef& given)
    : given_(unchanged(given)), order_(canonical_order(given)), copy_(given) {
  make_connectivity();
  map_faces();
  copy_properties(given.connectivity(), connectivity_, false);
  copy_.connectivity_ = &connectivity_;
  copy_.canonical_copy_ = this;
  choose_origin();
  for (size_t i = 0; i < order_.vertices.size(); ++i)
    copy_.points_[i] = given.point(order_.vertices[i]) - origin_;
}

// A coordinate of the surface itself along each axis that it is far off on: numbers so near to each other
// have an exact difference.
void CanonicalCopy::choose_origin() {
  Vec3d low = given_.points().front(), high = low;
  for (const Vec3d& p : given_.points()) {
    low.minimize(p);
    high.maximize(p);
  }
  const Vec3d& first = given_.point(order_.vertices.front());
  for (size_t k = 0; k < 3; ++k)
    if (low[k] > kFar * given_.diagonal() || high[k] < -kFar * given_.diagonal()) origin_[k] = first[k];
}

// Element by element instead of face by face: what several fans have in common is left as it is.
void CanonicalCopy::make_connectivity() {
  const auto& given = given_.connectivity();
  auto& mesh = connectivity_;
  mesh.reserve(given.n_vertices(), given.n_edges(), given.n_faces());
  std::vector<VertexHandle> vertex(given.n_vertices());
  std::vector<HalfedgeHandle> halfedge(given.n_halfedges());
  for (const auto v : order_.vertices) vertex[at(v)] = mesh.new_vertex();
  for (const auto h : order_.edges) {
    const auto made =
        mesh.new_edge(vertex[at(given.from_vertex_handle(h))], vertex[at(given.to_vertex_handle(h))]);
    halfedge[at(h)] = made;
    halfedge[at(given.opposite_halfedge_handle(h))] = mesh.opposite_halfedge_handle(made);
  }
  for (const auto h : given.all_halfedges())
    if (given.next_halfedge_handle(h).is_valid())
      mesh.set_next_halfedge_handle(halfedge[at(h)], halfedge[at(given.next_halfedge_handle(h))]);
  for (const auto first : order_.faces) {
    const auto face = mesh.new_face();
    mesh.set_halfedge_handle(face, halfedge[at(first)]);
    auto h = first;
    for (int k = 0; k < 3; ++k, h = given.next_halfedge_handle(h))
      mesh.set_face_handle(halfedge[at(h)], face);
  }
  // The first that leaves a vertex, or at the border the first there.
  for (const bool border : {true, false})
    for (const auto h : mesh.all_halfedges()) {
      const auto v = mesh.from_vertex_handle(h);
      if (mesh.is_boundary(h) == border && !mesh.halfedge_handle(v).is_valid())
        mesh.set_halfedge_handle(v, h);
    }
}

void CanonicalCopy::map_faces() {
  const auto& given = given_.connectivity();
  to_given_.resize(given.n_faces());
  to_copy_.resize(given.n_faces());
  for (size_t i = 0; i < order_.faces.size(); ++i) {
    const auto face = given.face_handle(order_.faces[i]);
    int shift = 0;  // the first corner here, among those of the given face
    for (auto h = given.halfedge_handle(face); h != order_.faces[i]; h = given.next_halfedge_handle(h))
      ++shift;
    to_given_[i] = {face.idx(), shift};
    to_copy_[at(face)] = {static_cast<int>(i), (3 - shift) % 3};
  }
}

void CanonicalCopy::copy_properties(TriConnectivity& from, TriConnectivity& to, bool back) const {
  PropertyCopier copier(from, to);
  const auto& there = back ? to_given_ : to_copy_;
  const auto on_vertices = [&](auto source, auto target) {
    for (size_t i = 0; i < order_.vertices.size(); ++i) {
      const VertexHandle here(static_cast<int>(i)), given = order_.vertices[i];
      to.property(target, back ? given : here) = from.property(source, back ? here : given);
    }
  };
  const auto on_faces = [&](auto source, auto target) {
    for (size_t i = 0; i < there.size(); ++i)
      to.property(target, FaceHandle(there[i].face)) = from.property(source, FaceHandle(static_cast<int>(i)));
  };
  const auto on_edges_sides = [&](auto source, auto target) {
    for (size_t i = 0; i < order_.edges.size(); ++i)
      for (unsigned k = 0; k < 2; ++k) {
        const auto here = connectivity_.halfedge_handle(EdgeHandle(static_cast<int>(i)), k);
        const auto given =
            k == 0 ? order_.edges[i] : given_.connectivity().opposite_halfedge_handle(order_.edges[i]);
        to.property(target, back ? given : here) = from.property(source, back ? here : given);
      }
  };
  const auto positions = [&](auto source, auto target) {
    for (size_t i = 0; i < there.size(); ++i)
      to.property(target, FaceHandle(there[i].face)) =
          shifted(from.property(source, FaceHandle(static_cast<int>(i))), there[i].shift);
  };
  const auto on_mesh = [&](auto source, auto target) { to.property(target) = from.property(source); };
  // Faces that are not there stay what they are, for read_lines() to refuse.
  const auto face_list = [&](auto source, auto target) {
    to.property(target) = from.property(source);
    for (int& f : to.property(target))
      if (f >= 0 && static_cast<size_t>(f) < there.size()) f = there[static_cast<size_t>(f)].face;
  };
  const auto copy_points = [&](const auto& faces, const auto& barycentrics) {
    copier.copy(faces, face_list);
    copier.copy(barycentrics, [&](auto source, auto target) {
      auto values = from.property(source);
      const auto& of =
          has_property(from, faces) ? from.property(require_property(from, faces)) : std::vector<int>();
      for (size_t i = 0; i < of.size() && 3 * i + 2 < values.size(); ++i) {
        if (of[i] < 0 || static_cast<size_t>(of[i]) >= there.size()) continue;
        const Vec3d moved = shifted({values[3 * i], values[3 * i + 1], values[3 * i + 2]},
                                    there[static_cast<size_t>(of[i])].shift);
        std::copy(moved.data(), moved.data() + 3, values.begin() + static_cast<std::ptrdiff_t>(3 * i));
      }
      to.property(target) = std::move(values);
    });
  };
  namespace p = property;
  for (const auto& d : {p::normal, p::gamma_min, p::gamma_max, p::tensor2d}) copier.copy(d, on_vertices);
  for (const auto& d : {p::tensor, p::surface_tensor}) copier.copy(d, on_vertices);
  for (const auto& d : {p::k_min, p::k_max, p::area_stretch}) copier.copy(d, on_vertices);
  for (const auto& d : {p::chart, p::umbilic}) copier.copy(d, on_faces);
  for (const auto& d : {p::feature_tolerance, p::epsilon, p::cell_tolerance}) copier.copy(d, on_mesh);
  copier.copy(p::uv, on_vertices);
  const auto texture = [&](auto handle) {  // OpenMesh's own, which flatten() writes where they are there
    auto target = handle;
    if (!from.get_property_handle(handle, "v:texcoords2D")) return;
    if (!to.get_property_handle(target, "v:texcoords2D")) to.add_property(target, "v:texcoords2D");
    on_vertices(handle, target);
  };
  texture(OpenMesh::VPropHandleT<OpenMesh::Vec2f>());
  texture(OpenMesh::VPropHandleT<Vec2d>());
  copier.copy(p::umbilic_position, positions);
  copier.copy(p::chart_uv, on_edges_sides);
  for (const auto& d : {p::follow, p::target_vertices, p::target_faces}) copier.copy(d, on_mesh);
  copier.copy(p::line_table, on_mesh);
  copy_points(p::line_faces, p::line_barycentrics);
  copy_points(p::isotropic_faces, p::isotropic_barycentrics);
  if (!from.has_edge_status()) return;
  if (!to.has_edge_status()) to.request_edge_status();
  for (size_t i = 0; i < order_.edges.size(); ++i) {
    const EdgeHandle here(static_cast<int>(i)), given = given_.connectivity().edge_handle(order_.edges[i]);
    to.status(back ? given : here).set_feature(from.status(back ? here : given).feature());
  }
}

void CanonicalCopy::write_back() const { copy_properties(copy_.connectivity(), given_.connectivity(), true); }

void CanonicalCopy::move(OpenMesh::PolyMesh& result, const std::vector<FaceThere>& there,
                         const SurfaceRef& from, const SurfaceRef& to, const Vec3d& by) {
  if (!has_property(result, property::source_face)) return;
  const auto face = require_property(result, property::source_face);
  const auto barycentric = require_property(result, property::source_barycentric);
  const bool elsewhere = by != Vec3d(0, 0, 0);
  for (const auto v : result.all_vertices()) {
    const int f = result.property(face, v);
    const bool known = f >= 0 && static_cast<size_t>(f) < there.size();
    Vec3d& b = result.property(barycentric, v);
    // What lies on the surface is to lie on it there as well, to the last bit.
    const bool on = known && elsewhere && result.point(v) == position(from, {FaceHandle(f), b});
    if (known) {
      b = shifted(b, there[static_cast<size_t>(f)].shift);
      result.property(face, v) = there[static_cast<size_t>(f)].face;
    }
    if (on)
      result.set_point(v, position(to, {FaceHandle(result.property(face, v)), b}));
    else if (elsewhere)
      result.set_point(v, result.point(v) + by);
  }
}

}  // namespace anisomesh::detail
