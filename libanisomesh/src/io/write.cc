#include <charconv>
#include <cstdint>
#include <cstring>

#include "anisomesh/io.hh"
#include "io/endings.hh"
#include "io/om.hh"
#include "io/safe_file.hh"

namespace anisomesh {

namespace {

void append(std::string& text, double value) {
  char digits[32];
  const auto [end, error] = std::to_chars(digits, digits + sizeof digits, value);  // shortest that reads back
  static_cast<void>(error);
  text.append(digits, end);
}

void append(std::string& text, long long value) {
  char digits[24];
  const auto [end, error] = std::to_chars(digits, digits + sizeof digits, value);
  static_cast<void>(error);
  text.append(digits, end);
}

template <class Mesh>
void append_points(std::string& text, const Mesh& mesh, const char* keyword) {
  for (const auto v : mesh.vertices()) {
    text += keyword;
    for (int i = 0; i < 3; ++i) {
      append(text, mesh.point(v)[i]);
      text += i < 2 ? ' ' : '\n';
    }
  }
}

template <class Mesh>
std::string obj_text(const Mesh& mesh) {
  std::string text = "# made by anisomesh\n";
  append_points(text, mesh, "v ");
  const bool uv = mesh.has_vertex_texcoords2D();
  if (uv)
    for (const auto v : mesh.vertices()) {
      text += "vt ";
      append(text, static_cast<double>(mesh.texcoord2D(v)[0]));
      text += ' ';
      append(text, static_cast<double>(mesh.texcoord2D(v)[1]));
      text += '\n';
    }
  for (const auto f : mesh.faces()) {
    text += 'f';
    for (const auto v : f.vertices()) {
      text += ' ';
      append(text, static_cast<long long>(v.idx()) + 1);
      if (!uv) continue;
      text += '/';
      append(text, static_cast<long long>(v.idx()) + 1);
    }
    text += '\n';
  }
  return text;
}

template <class Mesh>
std::string off_text(const Mesh& mesh) {
  std::string text = "OFF\n";
  append(text, static_cast<long long>(mesh.n_vertices()));
  text += ' ';
  append(text, static_cast<long long>(mesh.n_faces()));
  text += " 0\n";
  append_points(text, mesh, "");
  for (const auto f : mesh.faces()) {
    append(text, static_cast<long long>(mesh.valence(f)));
    for (const auto v : f.vertices()) {
      text += ' ';
      append(text, static_cast<long long>(v.idx()));
    }
    text += '\n';
  }
  return text;
}

template <class T>
void append_bytes(std::string& text, T value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  text.append(bytes, sizeof value);
}

template <class Mesh>
std::string ply_text(const Mesh& mesh) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment made by anisomesh\nelement vertex " +
                     std::to_string(mesh.n_vertices()) +
                     "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                     std::to_string(mesh.n_faces());
  size_t largest = 0;
  for (const auto f : mesh.faces()) largest = std::max<size_t>(largest, mesh.valence(f));
  const bool small = largest < 256;  // most readers expect uchar here
  text += small ? "\nproperty list uchar int vertex_indices\nend_header\n"
                : "\nproperty list int int vertex_indices\nend_header\n";
  for (const auto v : mesh.vertices())
    for (int i = 0; i < 3; ++i) append_bytes(text, mesh.point(v)[i]);
  for (const auto f : mesh.faces()) {
    if (small)
      append_bytes(text, static_cast<std::uint8_t>(mesh.valence(f)));
    else
      append_bytes(text, static_cast<std::int32_t>(mesh.valence(f)));
    for (const auto v : f.vertices()) append_bytes(text, static_cast<std::int32_t>(v.idx()));
  }
  return text;
}

template <class Mesh>
void write_any(const Mesh& mesh, const std::string& path) {
  const std::string ending = detail::require_ending(path, detail::writable_endings());
  write_text(ending == ".obj"   ? obj_text(mesh)
             : ending == ".off" ? off_text(mesh)
             : ending == ".ply" ? ply_text(mesh)
                                : detail::om_text(mesh, path),
             path);
}

}  // namespace

void write_mesh(const OpenMesh::TriMesh& mesh, const std::string& path) { write_any(mesh, path); }
void write_mesh(const OpenMesh::PolyMesh& mesh, const std::string& path) { write_any(mesh, path); }

void write_text(const std::string& text, const std::string& path) {
  detail::SafeFile file(path);
  file.write(text);
  file.commit();
}

void require_writable(const std::string& path) { const detail::SafeFile trial(path); }

void require_writable_mesh(const std::string& path) {
  detail::require_ending(path, detail::writable_endings());
  require_writable(path);
}

}  // namespace anisomesh
