#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "anisomesh/io.hh"
#include "io/endings.hh"
#include "io/om.hh"
#include "io/scanner.hh"
#include "io/soup.hh"

namespace anisomesh {

namespace {

using detail::Soup;

std::string read_file(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw InvalidInput(path + ": is a directory, not a mesh file");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  const auto fail = [&] {
    throw InvalidInput(path + ": cannot be read" +
                       (errno ? ": " + std::generic_category().message(errno) : std::string()));
  };
  if (!file) fail();
  std::string text;
  const auto size = std::filesystem::file_size(path, error);  // an error for a pipe: it is read all the same
  if (!error) text.reserve(static_cast<size_t>(size));
  char block[1 << 16];
  while (file.read(block, sizeof block) || file.gcount() > 0)
    text.append(block, static_cast<size_t>(file.gcount()));
  if (file.bad()) fail();
  if (text.empty()) throw InvalidInput(path + ": the file is empty");
  return text;
}

Soup read_soup(const std::string& text, const std::string& ending, const std::string& path,
               ReadReport& report) {
  Soup soup = ending == ".obj"   ? detail::read_obj(text, path)
              : ending == ".off" ? detail::read_off(text, path)
              : ending == ".ply" ? detail::read_ply(text, path)
                                 : detail::read_stl(text, path, report);
  if (soup.points.empty()) throw InvalidInput(path + ": there are no vertices");
  if (soup.n_faces() == 0) throw InvalidInput(path + ": there are no faces, so this is no surface");
  return soup;
}

/// Faces that OpenMesh refuses even now (an edge whose two ends both run through further fans) stand on
/// vertices of their own.
template <class Mesh>
Mesh mesh_of(const Soup& soup, ReadReport& report) {
  Mesh mesh;
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  mesh.reserve(soup.points.size(), soup.points.size() + soup.n_faces(), soup.n_faces());
  for (const auto& p : soup.points) mesh.add_vertex(p);
  const detail::Quiet quiet;
  std::vector<OpenMesh::VertexHandle> corners;
  for (size_t f = 0; f < soup.n_faces(); ++f) {
    corners.clear();
    for (size_t k = 0; k < soup.degree(f); ++k) corners.emplace_back(soup.face(f)[k]);
    if (mesh.add_face(corners).is_valid()) continue;
    for (auto& corner : corners) {
      const auto place = mesh.point(corner);
      corner = mesh.add_vertex(place);
      ++report.duplicated_vertices;
    }
    mesh.add_face(corners);
  }
  return mesh;
}

OpenMesh::TriMesh surface_of(Soup soup, const std::string& path, const ReadOptions& options,
                             ReadReport& report) {
  const size_t n_points = soup.points.size();
  detail::drop_degenerate_faces(soup, report);
  detail::triangulate(soup, report);
  detail::DisjointSets places(n_points);
  detail::join_short_sides(soup, places, report);
  detail::take_places(soup, places);
  detail::drop_degenerate_faces(soup, report);
  detail::weld(soup, options.weld_fraction, places, report);
  detail::take_places(soup, places);
  detail::drop_degenerate_faces(soup, report);
  detail::drop_duplicate_faces(soup, report);
  if (soup.n_faces() == 0) throw InvalidInput(path + ": no face has three different corners");
  detail::drop_flat_pieces(soup, report);
  detail::orient(soup, report);
  detail::split_non_manifold(soup, report);
  detail::drop_isolated_vertices(soup, places, report);
  if (!report.vertex_of.empty()) report.vertex_of.resize(n_points);
  return mesh_of<OpenMesh::TriMesh>(soup, report);
}

Soup soup_of(const OpenMesh::PolyMesh& mesh) {
  Soup soup;
  for (const auto v : mesh.vertices()) soup.points.push_back(mesh.point(v));
  for (const auto f : mesh.faces()) {
    for (const auto v : f.vertices()) soup.corners.push_back(v.idx());
    soup.end_face();
  }
  return soup;
}

template <class Mesh>
void require_finite(const Mesh& mesh, const std::string& path) {
  for (const auto v : mesh.vertices())
    for (int i = 0; i < 3; ++i)
      if (!std::isfinite(mesh.point(v)[i]))
        throw InvalidInput(path + ": vertex " + std::to_string(v.idx()) +
                           " has a coordinate that is not finite");
}

}  // namespace

void ReadOptions::validate() const {
  if (!(weld_fraction >= 0 && weld_fraction <= 0.1))
    throw InvalidOption("weld_fraction is " + std::to_string(weld_fraction) + ", must be in [0, 0.1]");
}

OpenMesh::TriMesh read_surface(const std::string& path, ReadReport* report, const ReadOptions& options) {
  options.validate();
  const std::string ending = detail::require_ending(path, detail::readable_endings());
  const std::string text = read_file(path);
  ReadReport found;
  OpenMesh::TriMesh mesh;
  if (ending != ".om") {
    mesh = surface_of(read_soup(text, ending, path, found), path, options, found);
  } else if (detail::om_is_triangles(text, path)) {
    mesh = detail::read_om_triangles(text, path);
    if (mesh.n_faces() == 0) throw InvalidInput(path + ": there are no faces, so this is no surface");
    require_finite(mesh, path);
  } else {  // properties of polygons mean nothing on their triangles
    const auto polygons = detail::read_om_polygons(text, path);
    require_finite(polygons, path);
    mesh = surface_of(soup_of(polygons), path, options, found);
  }
  if (report) *report = std::move(found);
  return mesh;
}

OpenMesh::PolyMesh read_polygons(const std::string& path, ReadReport* report) {
  const std::string ending = detail::require_ending(path, detail::readable_endings());
  const std::string text = read_file(path);
  ReadReport found;
  OpenMesh::PolyMesh mesh;
  if (ending == ".om") {
    mesh = detail::read_om_polygons(text, path);
    require_finite(mesh, path);
  } else {
    Soup soup = read_soup(text, ending, path, found);
    detail::drop_degenerate_faces(soup, found);
    detail::split_non_manifold(soup, found);
    mesh = mesh_of<OpenMesh::PolyMesh>(soup, found);
  }
  if (mesh.n_faces() == 0) throw InvalidInput(path + ": there are no faces, so this is no surface");
  if (report) *report = std::move(found);
  return mesh;
}

std::vector<std::pair<int, int>> read_feature_edges(const std::string& path) {
  const std::string text = read_file(path);
  if (detail::ending_of(path) == ".obj") return detail::read_obj(text, path).segments;
  std::vector<std::pair<int, int>> edges;
  detail::Scanner scanner(text, path);
  while (scanner.next_line()) {
    const auto index = [&] {
      const long long i = scanner.integer("a vertex index");
      if (i < 0 || i > 0x7ffffffe) scanner.fail("a vertex index is out of range");
      return static_cast<int>(i);
    };
    const int from = index();
    edges.emplace_back(from, index());
    if (!scanner.at_end_of_line()) scanner.fail("expected two vertex indices, found more");
  }
  return edges;
}

}  // namespace anisomesh
