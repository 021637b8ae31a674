#include "io/om.hh"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <streambuf>
#include <vector>

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

/// Notices when more is asked for than there is: OpenMesh does not, and leaves properties half filled. At the
/// end of a whole file it looks once for the two bytes of a further chunk.
class WatchedBuffer : public std::streambuf {
 public:
  explicit WatchedBuffer(const std::string& text) {
    char* begin = const_cast<char*>(text.data());  // the interface of streambuf; nothing is written
    setg(begin, begin, begin + text.size());
  }
  bool fell_short() const { return fell_short_; }

 protected:
  std::streamsize xsgetn(char* to, std::streamsize wanted) override {
    const std::streamsize found = std::min<std::streamsize>(wanted, egptr() - gptr());
    if (found < wanted && (found > 0 || wanted != 2)) fell_short_ = true;
    std::memcpy(to, gptr(), static_cast<size_t>(found));
    setg(eback(), gptr() + found, egptr());
    return found;
  }

 private:
  bool fell_short_ = false;
};

/// OpenMesh takes the indices of a file as they come; following a wrong one would leave the arrays.
template <class Mesh>
bool indices_are_sound(const Mesh& mesh) {
  const auto in = [](int index, size_t size) { return index >= 0 && static_cast<size_t>(index) < size; };
  for (const auto h : mesh.halfedges())
    if (!in(mesh.to_vertex_handle(h).idx(), mesh.n_vertices()) ||
        !in(mesh.next_halfedge_handle(h).idx(), mesh.n_halfedges()) ||
        !(mesh.is_boundary(h) || in(mesh.face_handle(h).idx(), mesh.n_faces())))
      return false;
  for (const auto v : mesh.vertices()) {
    const auto h = mesh.halfedge_handle(v);
    if (h.is_valid() && (!in(h.idx(), mesh.n_halfedges()) || mesh.from_vertex_handle(h) != v)) return false;
  }
  for (const auto f : mesh.faces())
    if (!in(mesh.halfedge_handle(f).idx(), mesh.n_halfedges())) return false;
  // The walks around faces and vertices must close: next is a permutation that agrees with faces and
  // vertices.
  std::vector<char> entered(mesh.n_halfedges(), 0);
  for (const auto h : mesh.halfedges()) {
    const auto next = mesh.next_halfedge_handle(h);
    if (entered[static_cast<size_t>(next.idx())]++ || mesh.face_handle(next) != mesh.face_handle(h) ||
        mesh.from_vertex_handle(next) != mesh.to_vertex_handle(h))
      return false;
  }
  for (const auto f : mesh.faces())
    if (mesh.face_handle(mesh.halfedge_handle(f)) != f) return false;
  return true;
}

/// What came out of a file shall go into the next one: the reader leaves its properties transient.
template <class Mesh>
void keep_properties(Mesh& mesh) {
  const auto keep = [](auto begin, auto end) {
    for (auto property = begin; property != end; ++property) {
      if (!*property) continue;
      const std::string& name = (*property)->name();
      const bool of_openmesh = name.size() < 2 || name[1] == ':' || name[0] == '<';
      if (!of_openmesh) (*property)->set_persistent(true);
    }
  };
  keep(mesh.vprops_begin(), mesh.vprops_end());
  keep(mesh.hprops_begin(), mesh.hprops_end());
  keep(mesh.eprops_begin(), mesh.eprops_end());
  keep(mesh.fprops_begin(), mesh.fprops_end());
  keep(mesh.mprops_begin(), mesh.mprops_end());
}

template <class Mesh>
Mesh read_om(const std::string& text, const std::string& path) {
  const OmHeader header = read_header(text, path);
  Mesh mesh;
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  mesh.request_vertex_texcoords2D();
  // Custom: OpenMesh 11 asks for it where 9 always reads and writes custom properties.
  io::Options options = io::Options::Status | io::Options::VertexTexCoord | io::Options::Custom;
  WatchedBuffer buffer(text);
  std::istream stream(&buffer);
  bool read = false;
  try {
    const Quiet quiet;
    read = io::read_mesh(mesh, stream, ".om", options);
  } catch (const std::exception& error) {
    throw InvalidInput(path + ": OpenMesh cannot read it: " + error.what());
  }
  if (!read || buffer.fell_short())
    throw InvalidInput(path + ": OpenMesh cannot read it to the end; is the file complete?");
  if (mesh.n_vertices() != header.vertices || mesh.n_faces() != header.faces)
    throw InvalidInput(path + ": the header promises " + std::to_string(header.vertices) + " vertices and " +
                       std::to_string(header.faces) + " faces, but there are " +
                       std::to_string(mesh.n_vertices()) + " and " + std::to_string(mesh.n_faces()) +
                       "; the surface is not manifold or the file is damaged");
  if (!indices_are_sound(mesh))
    throw InvalidInput(path + ": the connectivity is damaged; write the file anew");
  if (!options.vertex_has_texcoord()) mesh.release_vertex_texcoords2D();
  keep_properties(mesh);
  return mesh;
}

template <class Mesh>
std::string write_om(const Mesh& mesh, const std::string& path) {
  io::Options options = io::Options::Binary | io::Options::Custom;
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
