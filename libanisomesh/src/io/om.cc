#include "io/om.hh"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <cstdint>
#include <cstring>
#include <sstream>

#include "anisomesh/errors.hh"

namespace anisomesh::detail {

namespace io = OpenMesh::IO;

namespace {

struct OmHeader {
  char kind = 0;  // 'T', 'Q' or 'P'
  std::uint32_t vertices = 0, faces = 0, edges = 0;
};

OmHeader read_header(const std::string& text, const std::string& path) {
  OmHeader header;
  if (text.size() < 16 || text[0] != 'O' || text[1] != 'M')
    throw InvalidInput(path + ": this is no .om file");
  header.kind = text[2];
  std::memcpy(&header.vertices, text.data() + 4, 4);
  std::memcpy(&header.faces, text.data() + 8, 4);
  std::memcpy(&header.edges, text.data() + 12, 4);
  // OpenMesh allocates what the header asks for: ask the file's size first. A vertex has 12 bytes at least, a
  // face a handle of one byte.
  if (text.size() / 12 < header.vertices || text.size() < header.faces)
    throw InvalidInput(path + ": the header promises " + std::to_string(header.vertices) + " vertices and " +
                       std::to_string(header.faces) + " faces, but the file is too short; is it complete?");
  return header;
}

template <class Mesh>
Mesh read_om(const std::string& text, const std::string& path) {
  const OmHeader header = read_header(text, path);
  Mesh mesh;
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_halfedge_status();
  mesh.request_face_status();
  mesh.request_vertex_texcoords2D();
  io::Options options = io::Options::Status | io::Options::VertexTexCoord;
  std::istringstream stream(text);
  bool read = false;
  try {
    const Quiet quiet;
    read = io::read_mesh(mesh, stream, ".om", options);
  } catch (const std::exception& error) {
    throw InvalidInput(path + ": OpenMesh cannot read it: " + error.what());
  }
  if (!read) throw InvalidInput(path + ": OpenMesh cannot read it; is the file complete?");
  if (mesh.n_vertices() != header.vertices || mesh.n_faces() != header.faces)
    throw InvalidInput(path + ": the header promises " + std::to_string(header.vertices) + " vertices and " +
                       std::to_string(header.faces) + " faces, but there are " +
                       std::to_string(mesh.n_vertices()) + " and " + std::to_string(mesh.n_faces()) +
                       "; the surface is not manifold or the file is damaged");
  if (!options.vertex_has_texcoord()) mesh.release_vertex_texcoords2D();
  return mesh;
}

template <class Mesh>
std::string write_om(const Mesh& mesh, const std::string& path) {
  io::Options options = io::Options::Binary;
  if (mesh.has_vertex_status() && mesh.has_edge_status() && mesh.has_face_status())
    options += io::Options::Status;
  if (mesh.has_vertex_texcoords2D()) options += io::Options::VertexTexCoord;
  std::ostringstream stream;
  bool written = false;
  {
    const Quiet quiet;
    written = io::write_mesh(mesh, stream, ".om", options);
  }
  if (!written) throw InvalidInput(path + ": OpenMesh cannot write the mesh as .om");
  return std::move(stream).str();
}

}  // namespace

Quiet::Quiet() : errors_(omerr().is_enabled()), log_(omlog().is_enabled()) {
  omerr().disable();
  omlog().disable();
}

Quiet::~Quiet() {
  if (errors_) omerr().enable();
  if (log_) omlog().enable();
}

bool om_is_triangles(const std::string& text, const std::string& path) {
  return read_header(text, path).kind == 'T';
}

OpenMesh::TriMesh read_om_triangles(const std::string& text, const std::string& path) {
  return read_om<OpenMesh::TriMesh>(text, path);
}
OpenMesh::PolyMesh read_om_polygons(const std::string& text, const std::string& path) {
  return read_om<OpenMesh::PolyMesh>(text, path);
}

std::string om_text(const OpenMesh::TriMesh& mesh, const std::string& path) { return write_om(mesh, path); }
std::string om_text(const OpenMesh::PolyMesh& mesh, const std::string& path) { return write_om(mesh, path); }

}  // namespace anisomesh::detail
