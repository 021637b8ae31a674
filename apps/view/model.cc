#include "view/model.hh"

#include <algorithm>
#include <cmath>
#include <limits>

#include "anisomesh/charts.hh"
#include "anisomesh/features.hh"
#include "anisomesh/lines.hh"
#include "anisomesh/properties.hh"

namespace view {

using namespace anisomesh;
using OpenMesh::EdgeHandle;

namespace {

struct Box {
  Vec3d low{Vec3d::vectorized(std::numeric_limits<double>::infinity())}, high{-low};
  void add(const Vec3d& p) {
    low.minimize(p);
    high.maximize(p);
  }
  Frame frame() const {
    const double diagonal = (high - low).norm();
    return {0.5 * (low + high), diagonal > 0 && std::isfinite(diagonal) ? diagonal : 1};
  }
};

std::vector<float> floats(const std::vector<Vec3d>& points, const Frame& frame) {
  std::vector<float> out;
  out.reserve(3 * points.size());
  for (const auto& p : points)
    for (size_t i = 0; i < 3; ++i) out.push_back(static_cast<float>((p[i] - frame.centre[i]) / frame.scale));
  return out;
}

int16_t small(double x) { return static_cast<int16_t>(std::lround(32767 * std::clamp(x, -1.0, 1.0))); }
uint16_t share(double x) { return static_cast<uint16_t>(std::lround(65535 * std::clamp(x, 0.0, 1.0))); }
uint32_t number(int index) { return static_cast<uint32_t>(index); }

/// A property of vertices, one float a component; nothing where it is missing.
template <class T, class Components>
void add_vertex_floats(Model& model, const char* key, const OpenMesh::BaseKernel& mesh,
                       const PropertyDeclaration<OpenMesh::VPropHandleT<T>>& declaration, size_t components,
                       Components get) {
  OpenMesh::VPropHandleT<T> handle;
  if (!mesh.get_property_handle(handle, declaration.name)) return;
  std::vector<float> values;
  for (const auto& value : mesh.property(handle).data_vector())
    for (size_t i = 0; i < components; ++i) values.push_back(static_cast<float>(get(value, i)));
  model.sections[key] = section(values, components);
}

void add_direction(Model& model, const char* key, const OpenMesh::BaseKernel& mesh,
                   const property::OnVertices<Vec3d>& declaration) {
  OpenMesh::VPropHandleT<Vec3d> handle;
  if (!mesh.get_property_handle(handle, declaration.name)) return;
  std::vector<int16_t> values;
  for (const auto& d : mesh.property(handle).data_vector())
    for (size_t i = 0; i < 3; ++i) values.push_back(small(d[i]));
  model.sections[key] = section(values, 3);
}

/// Surface points: faces, and the first two barycentric coordinates in 1/65535.
class Points {
 public:
  void add(int face, const Vec3d& barycentric) {
    faces_.push_back(number(face));
    shares_.push_back(share(barycentric[0]));
    shares_.push_back(share(barycentric[1]));
  }
  size_t size() const { return faces_.size(); }
  void put(Model& model, const std::string& key) const {
    model.sections[key + "_faces"] = section(faces_, 1);
    model.sections[key + "_shares"] = section(shares_, 2);
  }

 private:
  std::vector<uint32_t> faces_;
  std::vector<uint16_t> shares_;
};

/// The eigenvalues and eigenvectors in the tangent plane of the tensors smoothed on the surface itself.
void add_smoothed(Model& model, const OpenMesh::TriConnectivity& mesh) {
  OpenMesh::VPropHandleT<Vec6d> tensor;
  OpenMesh::VPropHandleT<Vec3d> normal;
  if (!mesh.get_property_handle(tensor, property::surface_tensor.name) ||
      !mesh.get_property_handle(normal, property::normal.name))
    return;
  std::vector<float> values;
  std::vector<int16_t> directions[2];
  for (const auto v : mesh.vertices()) {
    const Vec6d& t = mesh.property(tensor, v);
    const Vec3d n = mesh.property(normal, v);
    Vec3d a = cross(n, std::abs(n[0]) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0));
    if (a.sqrnorm() > 0) a.normalize();
    const Vec3d b = cross(n, a);
    const auto times = [&](const Vec3d& x) {
      return Vec3d(t[0] * x[0] + t[1] * x[1] + t[2] * x[2], t[1] * x[0] + t[3] * x[1] + t[4] * x[2],
                   t[2] * x[0] + t[4] * x[1] + t[5] * x[2]);
    };
    const double aa = a | times(a), ab = a | times(b), bb = b | times(b);
    const double mean = (aa + bb) / 2, half = (aa - bb) / 2, radius = std::hypot(half, ab);
    const double angle = std::atan2(ab, half) / 2;
    const Vec3d along[2] = {b * std::cos(angle) - a * std::sin(angle),
                            a * std::cos(angle) + b * std::sin(angle)};
    values.push_back(static_cast<float>(mean - radius));
    values.push_back(static_cast<float>(mean + radius));
    for (size_t k = 0; k < 2; ++k)
      for (size_t i = 0; i < 3; ++i) directions[k].push_back(small(along[k][i]));
  }
  model.sections["smoothed_k"] = section(values, 2);
  model.sections["smoothed_min"] = section(directions[0], 3);
  model.sections["smoothed_max"] = section(directions[1], 3);
}

void add_umbilics(Model& model, const OpenMesh::TriConnectivity& mesh) {
  OpenMesh::FPropHandleT<int> kind;
  OpenMesh::FPropHandleT<Vec3d> place;
  if (!mesh.get_property_handle(kind, property::umbilic.name) ||
      !mesh.get_property_handle(place, property::umbilic_position.name))
    return;
  Points points;
  std::vector<uint8_t> wedge;
  for (const auto f : mesh.faces()) {
    if (mesh.property(kind, f) == 0) continue;
    points.add(f.idx(), mesh.property(place, f));
    wedge.push_back(mesh.property(kind, f) > 0);
  }
  points.put(model, "umbilic");
  model.sections["umbilic_wedge"] = section(wedge, 1);
}

void add_lines(Model& model, const SurfaceRef& surface) {
  if (!has_property(surface.connectivity(), property::line_table)) return;
  const auto network = read_lines(surface);
  Points points;
  std::vector<uint32_t> table;
  for (const auto& line : network.lines) {
    for (const auto value : {static_cast<uint32_t>(line.kind), static_cast<uint32_t>(line.closed),
                             static_cast<uint32_t>(line.begin_reason), static_cast<uint32_t>(line.end_reason),
                             static_cast<uint32_t>(points.size())})
      table.push_back(value);
    for (const auto& p : line.points) points.add(p.face.idx(), p.barycentric);
  }
  points.put(model, "line");
  model.sections["line_table"] = section(table, 5);
  Points samples;
  for (const auto& p : network.isotropic_samples) samples.add(p.face.idx(), p.barycentric);
  if (has_property(surface.connectivity(), property::isotropic_faces)) samples.put(model, "sample");
}

/// Edge number and its two vertices.
template <class Mesh, class Condition>
std::vector<uint32_t> edges_where(const Mesh& mesh, Condition condition) {
  std::vector<uint32_t> out;
  for (const auto e : mesh.edges()) {
    if (!condition(e)) continue;
    const auto h = mesh.halfedge_handle(e, 0);
    for (const int i : {e.idx(), mesh.from_vertex_handle(h).idx(), mesh.to_vertex_handle(h).idx()})
      out.push_back(number(i));
  }
  return out;
}

}  // namespace

Frame frame_of(const SurfaceRef& surface) {
  Box box;
  for (const auto& p : surface.points()) box.add(p);
  return box.frame();
}

Frame frame_of(const OpenMesh::PolyMesh& mesh) {
  Box box;
  for (const auto v : mesh.vertices()) box.add(mesh.point(v));
  return box.frame();
}

Model surface_model(const std::string& name, const SurfaceRef& surface, const Frame& frame) {
  const auto& mesh = surface.connectivity();
  Model model;
  model.role = "surface";
  model.name = name;
  model.sections["points"] = section(floats(surface.points(), frame), 3);
  std::vector<uint32_t> triangles;
  for (const auto f : mesh.faces())
    for (const auto v : surface.corners(f).vertex) triangles.push_back(number(v.idx()));
  model.sections["triangles"] = section(triangles, 3);

  const auto scalar = [](double value, size_t) { return value; };
  const auto component = [](const auto& value, size_t i) { return value[i]; };
  add_vertex_floats(model, "k_min", mesh, property::k_min, 1, scalar);
  add_vertex_floats(model, "k_max", mesh, property::k_max, 1, scalar);
  add_direction(model, "gamma_min", mesh, property::gamma_min);
  add_direction(model, "gamma_max", mesh, property::gamma_max);
  add_vertex_floats(model, "stretch", mesh, property::area_stretch, 1, scalar);
  add_vertex_floats(model, "tensor2d", mesh, property::tensor2d, 3, component);
  add_vertex_floats(model, "uv", mesh, property::uv, 2,
                    [&](const Vec2d& uv, size_t i) { return uv[i] / frame.scale; });
  add_smoothed(model, mesh);
  add_umbilics(model, mesh);
  add_lines(model, surface);
  model.sections["border"] = section(edges_where(mesh, [&](EdgeHandle e) { return mesh.is_boundary(e); }), 3);
  model.sections["features"] = section(
      edges_where(mesh, [&](EdgeHandle e) { return is_feature_or_border(mesh, e) && !mesh.is_boundary(e); }),
      3);
  if (has_charts(surface))
    model.sections["seams"] =
        section(edges_where(mesh, [&](EdgeHandle e) { return is_seam(surface, e); }), 3);
  OpenMesh::MPropHandleT<double> epsilon;
  if (mesh.get_property_handle(epsilon, property::epsilon.name))
    model.numbers["epsilon"] = mesh.property(epsilon);
  return model;
}

Model result_model(const std::string& name, const OpenMesh::PolyMesh& mesh, const Frame& frame) {
  Model model;
  model.role = "result";
  model.name = name;
  std::vector<Vec3d> points;
  for (const auto v : mesh.vertices()) points.push_back(mesh.point(v));
  model.sections["points"] = section(floats(points, frame), 3);
  std::vector<uint32_t> offsets{0}, corners;
  for (const auto f : mesh.faces()) {
    for (const auto v : mesh.fv_range(f)) corners.push_back(number(v.idx()));
    offsets.push_back(static_cast<uint32_t>(corners.size()));
  }
  model.sections["offsets"] = section(offsets, 1);
  model.sections["corners"] = section(corners, 1);
  model.sections["edges"] = section(edges_where(mesh, [](EdgeHandle) { return true; }), 3);

  OpenMesh::EPropHandleT<int> kind;
  if (mesh.get_property_handle(kind, property::edge_kind.name)) {
    std::vector<uint8_t> kinds;
    for (const auto e : mesh.edges()) kinds.push_back(static_cast<uint8_t>(mesh.property(kind, e)));
    model.sections["edge_kind"] = section(kinds, 1);
  }
  OpenMesh::VPropHandleT<int> origin, source;
  OpenMesh::VPropHandleT<Vec3d> place;
  if (mesh.get_property_handle(origin, property::origin.name)) {
    std::vector<uint8_t> origins;
    for (const auto v : mesh.vertices()) origins.push_back(static_cast<uint8_t>(mesh.property(origin, v)));
    model.sections["origin"] = section(origins, 1);
  }
  if (mesh.get_property_handle(source, property::source_face.name) &&
      mesh.get_property_handle(place, property::source_barycentric.name)) {
    Points sources;
    for (const auto v : mesh.vertices()) sources.add(mesh.property(source, v), mesh.property(place, v));
    sources.put(model, "source");
  }
  add_vertex_floats(model, "error", mesh, property::error, 1, [](double value, size_t) { return value; });
  OpenMesh::FPropHandleT<double> error;
  if (mesh.get_property_handle(error, property::face_error.name)) {
    std::vector<float> errors;
    for (const auto f : mesh.faces()) errors.push_back(static_cast<float>(mesh.property(error, f)));
    model.sections["face_error"] = section(errors, 1);
  }
  return model;
}

}  // namespace view
