#include "anisomesh/io.hh"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "anisomesh/properties.hh"
#include "anisomesh/shapes.hh"
#include "catch.hh"
#include "data.hh"

using namespace anisomesh;
namespace fs = std::filesystem;

namespace {

void put(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary).write(text.data(), static_cast<std::streamsize>(text.size()));
}

std::string get(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// Coordinates that no float holds and no six digits print.
OpenMesh::TriMesh fine_tetrahedron() {
  OpenMesh::TriMesh mesh;
  const auto a = mesh.add_vertex({1.0 / 3, 0.1, 1e-17}), b = mesh.add_vertex({1e300 + 2e284, -1.0 / 7, 0}),
             c = mesh.add_vertex({123456789.123456789, 1e300, -1e-300}),
             d = mesh.add_vertex({0, 1 + 1e-15, 1e300});
  mesh.add_face(a, b, c);
  mesh.add_face(b, a, d);
  mesh.add_face(c, b, d);
  mesh.add_face(a, c, d);
  return mesh;
}

template <class A, class B>
bool same_mesh(const A& a, const B& b) {
  if (a.n_vertices() != b.n_vertices() || a.n_faces() != b.n_faces() || a.n_edges() != b.n_edges())
    return false;
  for (const auto v : a.vertices())
    if (a.point(v) != b.point(v)) return false;
  for (const auto f : a.faces()) {
    std::vector<int> in_a, in_b;
    for (const auto v : a.fv_range(f)) in_a.push_back(v.idx());
    for (const auto v : b.fv_range(f)) in_b.push_back(v.idx());
    if (in_a != in_b) return false;
  }
  return true;
}

/// The message of the InvalidInput that `call` throws.
template <class Call>
std::string message_of(Call call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "nothing was thrown";
}

std::string read_message(const std::string& path) {
  return message_of([&] { read_surface(path); });
}

const char* const two_triangles_off = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

}  // namespace

TEST_CASE("doubles survive every format that is written", "[io]") {
  const TemporaryFolder folder;
  const auto mesh = fine_tetrahedron();
  for (const char* name : {"t.obj", "t.off", "t.ply", "t.om", "T.OFF"}) {
    INFO(name);
    write_mesh(mesh, folder / name);
    ReadReport report;
    const auto back = read_surface(folder / name, &report);
    CHECK(same_mesh(mesh, back));
    CHECK((back.has_vertex_status() && back.has_edge_status() && back.has_face_status()));
    CHECK(report.vertex_of.empty());
    const OpenMesh::PolyMesh polygons = read_polygons(folder / name);
    CHECK(same_mesh(mesh, polygons));
  }
}

TEST_CASE("polygons are triangulated on reading, read_polygons leaves them", "[io]") {
  const TemporaryFolder folder;
  // An L of six corners: a fan from corner 0 would leave it.
  put(folder / "l.off", "OFF\n6 1 0\n2 0 0\n2 2 0\n1 2 0\n1 1 0\n0 1 0\n0 0 0\n6 0 1 2 3 4 5\n");
  ReadReport report;
  auto mesh = read_surface(folder / "l.off", &report);
  CHECK(mesh.n_faces() == 4);
  CHECK(report.triangulated_polygons == 1);
  double area = 0;
  for (const auto f : mesh.faces()) {
    const double z = mesh.calc_face_normal(f)[2] * mesh.calc_sector_area(mesh.halfedge_handle(f));
    CHECK(z > 0);
    area += z;
  }
  CHECK(area == Approx(3));
  const auto polygons = read_polygons(folder / "l.off");
  CHECK(polygons.n_faces() == 1);
  write_mesh(polygons, folder / "l.obj");
  write_mesh(polygons, folder / "l.ply");
  CHECK(same_mesh(polygons, read_polygons(folder / "l.obj")));
  CHECK(same_mesh(polygons, read_polygons(folder / "l.ply")));
  CHECK(read_surface(folder / "l.ply").n_faces() == 4);
}

TEST_CASE("polygons in an .om file are triangulated too", "[io]") {
  const TemporaryFolder folder;
  put(folder / "quad.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n");
  write_mesh(read_polygons(folder / "quad.off"), folder / "quad.om");
  CHECK(read_polygons(folder / "quad.om").n_faces() == 1);
  CHECK(read_surface(folder / "quad.om").n_faces() == 2);
}

TEST_CASE("the dialects of OBJ and OFF", "[io]") {
  const TemporaryFolder folder;
  put(folder / "plain.off", two_triangles_off);
  const auto plain = read_surface(folder / "plain.off");
  const auto same = [&](const std::string& name, const std::string& text) {
    INFO(name);
    put(folder / name, text);
    CHECK(same_mesh(plain, read_surface(folder / name)));
  };
  same("counts.off", "OFF 4 2 5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
  same("colour.off",
       "# a comment\nCOFF\n\n4 2 5\n0 0 0 9 9 9\n1 0 0 9 9 9\n1 1 0 1 1 1\n0 1 0 1 1 1\n"
       "3 0 1 2 1 0 0\n3 0 2 3 0.1\n");
  same("small.off",
       "\xef\xbb\xbf"
       "off\n4 2\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
  same("normals.off",
       "NCoff 4 2 5 # counts\n0 0 0 0 0 1\n1 0 0 0 0 1\n\n1 1 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n3 0 2 3\n");
  same("dos.off", "OFF\r\n4 2 0\r\n0 0 0\r\n1 0 0\r\n1 1 0\r\n0 1 0\r\n3 0 1 2\r\n3 0 2 3");
  same("mac.off", "OFF\r4 2 0\r# a comment\r0 0 0\r1 0 0\r1 1 0\r0 1 0\r3 0 1 2\r3 0 2 3\r");
  same("slashes.obj",
       "v 0 0 0\nv +1 0 0 1.0\nvt 0 0\nvn 0 0 1\ng x\nusemtl y\nv 1e0 1. 0\nv 0 1 0\n"
       "f 1/1/1 2//1 3/1\nf 1 3 4 # last\n");
  same("relative.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 \\\n -1\nv 0 1 0\nf -4 -2 -1\n");
}

TEST_CASE("PLY as text and as bytes of either order", "[io]") {
  const TemporaryFolder folder;
  put(folder / "plain.off", two_triangles_off);
  const auto plain = read_surface(folder / "plain.off");
  put(folder / "text.ply",
      "ply\nformat ascii 1.0\ncomment x\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
      "uchar red\n"
      "property float z\nelement face 2\nproperty list uchar int vertex_index\nelement edge 1\nproperty int "
      "a\n"
      "end_header\n0 0 7 0\n1 0 7 0\n1 1 7 0 0 1 7 0\n3 0 1 2\n3 0 2 3\n5\n");
  CHECK(same_mesh(plain, read_surface(folder / "text.ply")));

  std::string big =
      "ply\nformat binary_big_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
      "float z\n"
      "element face 2\nproperty list uchar ushort vertex_indices\nend_header\n";
  const auto append = [&](auto value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    for (size_t i = sizeof value; i > 0; --i) big += bytes[i - 1];
  };
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f}) append(x);
  for (const int k : {0, 1, 2, 0, 2, 3}) {
    if (k == 0) append(static_cast<unsigned char>(3));
    append(static_cast<std::uint16_t>(k));
  }
  put(folder / "big.ply", big);
  CHECK(same_mesh(plain, read_surface(folder / "big.ply")));
  const std::string unseen =
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty list uchar int vertex_index\nend_header\n"
      "0 0 0\nnan nan nan\n1 0 0\n1 1 0\n0 1 0\n";
  put(folder / "unseen.ply", unseen + "3 0 2 3\n3 0 3 4\n");
  CHECK(same_mesh(plain, read_surface(folder / "unseen.ply")));
  put(folder / "nan.ply", unseen + "3 0 1 3\n3 0 3 4\n");
  CHECK_THAT(read_message(folder / "nan.ply"), Catch::Contains("vertex 1: a coordinate is not finite"));
  put(folder / "unknown.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int corners\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  CHECK_THAT(read_message(folder / "unknown.ply"), Catch::Contains("'vertex_indices'"));
}

TEST_CASE("STL corners at one place become one vertex, in text and in bytes", "[io]") {
  const TemporaryFolder folder;
  std::string text = "solid a\n", bytes = std::string("solid, but binary").append(63, ' ');
  bytes += std::string("\2\0\0\0", 4);
  const float corners[2][3][3] = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{-0.f, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
  for (const auto& facet : corners) {
    text += "facet normal 0 0 1\nouter loop\n";
    bytes.append(12, '\0');
    for (const auto& p : facet) {
      text +=
          "vertex " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
      bytes.append(reinterpret_cast<const char*>(p), 12);
    }
    text += "endloop\nendfacet\n";
    bytes.append(2, '\0');
  }
  put(folder / "text.stl", text + "endsolid a\n");
  put(folder / "bytes.stl", bytes);
  for (const char* name : {"text.stl", "bytes.stl"}) {
    ReadReport report;
    const auto mesh = read_surface(folder / name, &report);
    CHECK(mesh.n_vertices() == 4);
    CHECK(mesh.n_faces() == 2);
    CHECK(report.merged_vertices == 2);
  }
  std::string capitals = text + "endsolid a\n";
  for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  put(folder / "capitals.stl", capitals);
  CHECK(read_surface(folder / "capitals.stl").n_faces() == 2);
  put(folder / "half.stl", bytes.substr(0, 150));
  CHECK_THAT(read_message(folder / "half.stl"), Catch::Contains("is it complete?"));
  put(folder / "half_text.stl", text);
  CHECK_THAT(read_message(folder / "half_text.stl"), Catch::Contains("endsolid"));
}

TEST_CASE("a soup is cleaned, and the report says how", "[io]") {
  const TemporaryFolder folder;
  ReadReport report;
  SECTION("one face turned over against its three neighbours") {
    put(folder / "x.off",
        "OFF\n5 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n.5 .5 1\n3 1 0 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n");
    const auto mesh = read_surface(folder / "x.off", &report);
    CHECK(report.reoriented_faces == 1);
    CHECK(report.duplicated_vertices == 0);
    CHECK(mesh.n_vertices() == 5);
    CHECK(mesh.n_edges() == 8);
  }
  SECTION("isolated vertices, duplicate and degenerate faces go; the numbers of the file are kept track of") {
    put(folder / "x.off",
        "OFF\n5 4 0\n9 9 9\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 1 2 3\n3 1 3 4\n3 4 3 1\n3 1 1 2\n");
    const auto mesh = read_surface(folder / "x.off", &report);
    CHECK(mesh.n_vertices() == 4);
    CHECK(mesh.n_faces() == 2);
    CHECK(report.isolated_vertices == 1);
    CHECK(report.duplicate_faces == 1);
    CHECK(report.degenerate_faces == 1);
    CHECK(report.vertex_of == std::vector<int>{-1, 0, 1, 2, 3});
  }
  SECTION("pieces without any area go; faces without area in a piece that has some stay") {
    put(folder / "x.off",
        "OFF\n9 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n.5 0 0\n5 5 5\n6 5 5\n7 5 5\n8 5 5\n"
        "3 5 6 7\n3 0 4 2\n3 4 1 2\n3 0 2 3\n3 5 7 8\n3 0 1 4\n");
    const auto mesh = read_surface(folder / "x.off", &report);
    CHECK(report.flat_faces == 2);
    CHECK(mesh.n_faces() == 4);
    CHECK(mesh.n_vertices() == 5);
    CHECK(report.vertex_of == std::vector<int>{0, 1, 2, 3, 4, -1, -1, -1, -1});
  }
  SECTION("a flat piece on the edge of a surface does not cut it open") {
    put(folder / "x.off",
        "OFF\n5 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n.5 .5 0\n3 0 1 2\n3 0 2 3\n3 0 2 4\n3 2 0 4\n");
    const auto mesh = read_surface(folder / "x.off", &report);
    CHECK(mesh.n_faces() == 2);
    CHECK(report.flat_faces + report.duplicate_faces == 2);
    CHECK(report.duplicated_vertices == 0);
  }
  SECTION("vertices that a side without length joins are one, also for those who name them") {
    // A seam closed with faces between vertices that differ in the last bits, as parametric sources make it.
    put(folder / "x.off",
        "OFF\n7 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n1e-16 0 0\n1.0000000000000002 0 0\n.5 -1 0\n"
        "3 0 1 2\n3 0 2 3\n3 4 1 0\n3 4 5 1\n3 4 6 5\n3 0 1 4\n");
    const auto mesh = read_surface(folder / "x.off", &report);
    CHECK(report.joined_vertices == 2);
    CHECK(report.isolated_vertices == 0);
    CHECK(report.degenerate_faces == 3);
    CHECK(mesh.n_vertices() == 5);
    CHECK(mesh.n_faces() == 3);
    CHECK(report.vertex_of == std::vector<int>{0, 1, 2, 3, 0, 1, 4});
  }
  SECTION("two cones that touch in their tips come apart") {
    put(folder / "x.off",
        "OFF\n7 6 0\n0 0 0\n1 0 1\n0 1 1\n-1 -1 1\n1 0 -1\n0 1 -1\n-1 -1 -1\n"
        "3 0 1 2\n3 0 2 3\n3 0 3 1\n3 0 5 4\n3 0 6 5\n3 0 4 6\n");
    const auto mesh = read_surface(folder / "x.off", &report);
    CHECK(report.duplicated_vertices == 1);
    CHECK(mesh.n_vertices() == 8);
    CHECK(mesh.point(mesh.vertex_handle(7)) == mesh.point(mesh.vertex_handle(0)));
  }
  SECTION("three faces at one edge come apart") {
    put(folder / "x.off", "OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 1 0 3\n3 0 1 4\n");
    const auto mesh = read_surface(folder / "x.off", &report);
    CHECK(mesh.n_faces() == 3);
    CHECK(report.duplicated_vertices == 4);
  }
  SECTION("a Moebius strip is cut open once") {
    std::string text = "OFF\n12 12 0\n";
    for (int i = 0; i < 6; ++i)
      for (int s = -1; s <= 1; s += 2) {
        const double t = i * M_PI / 3, w = 0.3 * s;
        text += std::to_string((1 + w * std::cos(t / 2)) * std::cos(t)) + " " +
                std::to_string((1 + w * std::cos(t / 2)) * std::sin(t)) + " " +
                std::to_string(w * std::sin(t / 2)) + "\n";
      }
    for (int i = 0; i < 6; ++i) {
      const int a = 2 * i, b = a + 1, c = i < 5 ? a + 2 : 1, d = i < 5 ? a + 3 : 0;
      text += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n3 " +
              std::to_string(b) + " " + std::to_string(d) + " " + std::to_string(c) + "\n";
    }
    put(folder / "x.off", text);
    const auto mesh = read_surface(folder / "x.off", &report);
    CHECK(mesh.n_faces() == 12);
    CHECK(report.duplicated_vertices == 2);
    CHECK(mesh.n_vertices() - mesh.n_edges() + mesh.n_faces() == 1);  // a disc
  }
}

TEST_CASE("what cannot be read is refused by file, element and way out", "[io]") {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& name, const std::string& text) {
    put(folder / name, text);
    const auto found = read_message(folder / name);
    CHECK_THAT(found, Catch::Contains(folder / name));
    CHECK_THAT(found, !Catch::Contains("\n"));
    return found;
  };
  using Catch::Contains;
  CHECK_THAT(read_message(folder / "absent.off"), Contains("No such file"));
  CHECK_THAT(read_message(folder.path().string() + "/."), Contains(".obj, .off, .ply, .stl or .om"));
  fs::create_directory(folder / "folder.off");
  CHECK_THAT(read_message(folder / "folder.off"), Contains("directory"));
  CHECK_THAT(read_message(folder / "x.xyz"), Contains("'.xyz'") && Contains(".obj, .off, .ply, .stl or .om"));
  for (const char* name : {"empty.off", "empty.obj", "empty.ply", "empty.stl", "empty.om"})
    CHECK_THAT(message(name, ""), Contains("empty"));
  for (const char* name : {"noise.off", "noise.ply", "noise.stl", "noise.om", "noise.obj"})
    CHECK(message(name, "\x01\x02garbage \xff\n more garbage") != "nothing was thrown");

  CHECK_THAT(message("early.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n"), Contains("2 of 4 vertices"));
  CHECK_THAT(message("early_faces.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
             Contains("1 of 2 faces"));
  CHECK_THAT(message("nan.off", "OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n"),
             Contains("line 4") && Contains("finite"));
  CHECK_THAT(message("word.off", "OFF\n3 1 0\n0 0 0\n1 zero 0\n0 1 0\n3 0 1 2\n"),
             Contains("line 4") && Contains("'zero 0'"));
  CHECK_THAT(message("range.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
             Contains("line 6") && Contains("vertex 3"));
  CHECK_THAT(message("huge.off", "OFF\n2000000000 1 0\n0 0 0\n"), Contains("1 of 2000000000 vertices"));
  CHECK_THAT(message("none.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n"), Contains("no faces"));
  CHECK_THAT(message("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n\nf 1 2 4\n"),
             Contains("line 5") && Contains("vertex 4"));
  CHECK_THAT(message("zero.obj", "v 0 0 0\nf 0 1 2\n"), Contains("line 2") && Contains("counts from 1"));
  CHECK_THAT(message("two.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n"),
             Contains("line 3") && Contains("three corners"));
  CHECK_THAT(message("inf.obj", "v 0 0 1e999\n"), Contains("line 1"));
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  CHECK_THAT(message("early.ply", ply + "0 0 0\n1 0 0\n"), Contains("vertex 2 of 3"));
  CHECK_THAT(message("range.ply", ply + "0 0 0\n1 0 0\n0 1 0\n3 0 1 9\n"), Contains("face 0"));
  CHECK_THAT(message("header.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"), Contains("end_header"));
}

TEST_CASE("a cut off .om file is refused, wherever it is cut", "[io]") {
  const TemporaryFolder folder;
  auto shape = make_shape("dome", {200});
  provide_property(shape, property::k_min);
  write_mesh(shape, folder / "whole.om");
  const std::string text = get(folder / "whole.om");
  for (size_t i = 1; i < 12; ++i) {
    put(folder / "cut.om", text.substr(0, text.size() * i / 12));
    INFO(i);
    CHECK_THROWS_AS(read_surface(folder / "cut.om"), InvalidInput);
  }
}

TEST_CASE("a file is replaced whole or not at all", "[io]") {
  const TemporaryFolder folder;
  const auto mesh = fine_tetrahedron();
  const auto only = [&](const std::vector<std::string>& names) {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder.path()))
      found.push_back(entry.path().filename().string());
    std::sort(found.begin(), found.end());
    CHECK(found == names);
  };
  SECTION("a file that is there is replaced and keeps its permissions") {
    put(folder / "a.off", "old");
    fs::permissions(folder / "a.off", fs::perms::owner_read | fs::perms::owner_write);
    write_mesh(mesh, folder / "a.off");
    CHECK(same_mesh(mesh, read_surface(folder / "a.off")));
    CHECK(fs::status(folder / "a.off").permissions() == (fs::perms::owner_read | fs::perms::owner_write));
    only({"a.off"});
  }
  SECTION("a link stays a link") {
    put(folder / "a.off", "old");
    fs::create_symlink("a.off", folder / "link.off");
    write_mesh(mesh, folder / "link.off");
    CHECK(fs::is_symlink(folder / "link.off"));
    CHECK(same_mesh(mesh, read_surface(folder / "a.off")));
    only({"a.off", "link.off"});
  }
  SECTION("no ending, an ending that is not written, a folder, no folder") {
    CHECK_THAT(message_of([&] { write_mesh(mesh, folder / "a"); }),
               Catch::Contains(".obj, .off, .ply or .om"));
    CHECK_THAT(message_of([&] { write_mesh(mesh, folder / "a.stl"); }),
               Catch::Contains(".obj, .off, .ply or .om"));
    CHECK_THAT(message_of([&] { write_mesh(mesh, folder / "no/a.off"); }), Catch::Contains("No such file"));
    only({});
    fs::create_directory(folder / "b.off");
    CHECK_THAT(message_of([&] { write_mesh(mesh, folder / "b.off"); }), Catch::Contains("directory"));
    CHECK_THAT(message_of([&] { require_writable_mesh(folder / "b.off"); }), Catch::Contains("directory"));
    only({"b.off"});
  }
  SECTION("a full disk") {
    if (fs::exists("/dev/full")) {
      fs::create_symlink("/dev/full", folder / "full.off");
      CHECK_THAT(message_of([&] { write_mesh(mesh, folder / "full.off"); }),
                 Catch::Contains("No space left"));
      CHECK(fs::exists("/dev/full"));
    }
  }
  SECTION("asking whether a place can be written leaves nothing") {
    put(folder / "a.off", "old");
    require_writable_mesh(folder / "a.off");
    require_writable_mesh(folder / "new.off");
    CHECK(get(folder / "a.off") == "old");
    only({"a.off"});
  }
}

TEST_CASE("all properties and the feature tags survive an .om file", "[io]") {
  const TemporaryFolder folder;
  auto mesh = make_shape("octa-flower", {400});
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  size_t features = 0;
  for (const auto e : mesh.edges()) features += mesh.status(e).feature();
  CHECK(features > 0);
  const auto third = [](int i, int k) { return (i + 1) / 3.0 + k; };
  for (const auto v : mesh.vertices()) {
    mesh.property(provide_property(mesh, property::normal), v) = Vec3d(third(v.idx(), 0), 1, 2);
    mesh.property(provide_property(mesh, property::tensor), v) = Vec6d(third(v.idx(), 0), 1, 2, 3, 4, 5);
    mesh.property(provide_property(mesh, property::k_min), v) = third(v.idx(), 7);
    mesh.property(provide_property(mesh, property::uv), v) = Vec2d(third(v.idx(), 0), 1);
  }
  for (const auto f : mesh.faces()) {
    mesh.property(provide_property(mesh, property::umbilic), f) = f.idx() % 3 - 1;
    mesh.property(provide_property(mesh, property::umbilic_position), f) = Vec3d(third(f.idx(), 0), 0, 0);
  }
  for (const auto e : mesh.edges())
    mesh.property(provide_property(mesh, property::edge_kind), e) = e.idx() % 5;
  const auto table = provide_property(mesh, property::line_table);
  const auto barycentrics = provide_property(mesh, property::line_barycentrics);
  for (int i = 0; i < 1000; ++i) {
    mesh.property(table).push_back(i);
    mesh.property(barycentrics).push_back(third(i, 0));
  }
  provide_property(mesh, property::isotropic_faces);  // stays empty
  write_mesh(mesh, folder / "a.om");
  auto back = read_surface(folder / "a.om");

  CHECK(same_mesh(mesh, back));
  // Not only the surface, each handle is the same: faces begin at the same halfedge, so barycentrics fit.
  for (const auto h : mesh.halfedges()) {
    CHECK(mesh.to_vertex_handle(h) == back.to_vertex_handle(h));
    CHECK(mesh.next_halfedge_handle(h) == back.next_halfedge_handle(h));
    CHECK(mesh.face_handle(h) == back.face_handle(h));
  }
  for (const auto f : mesh.faces()) CHECK(mesh.halfedge_handle(f) == back.halfedge_handle(f));
  for (const auto v : mesh.vertices()) CHECK(mesh.halfedge_handle(v) == back.halfedge_handle(v));
  for (const auto e : mesh.edges()) CHECK(mesh.status(e).feature() == back.status(e).feature());
  const auto same = [&](const auto& declaration, const auto& range) {
    const auto handle = require_property(mesh, declaration);
    const auto back_handle = require_property(back, declaration);
    for (const auto element : range)
      CHECK(mesh.property(handle, element) == back.property(back_handle, element));
  };
  same(property::normal, mesh.vertices());
  same(property::tensor, mesh.vertices());
  same(property::k_min, mesh.vertices());
  same(property::uv, mesh.vertices());
  same(property::umbilic, mesh.faces());
  same(property::umbilic_position, mesh.faces());
  same(property::edge_kind, mesh.edges());
  CHECK(mesh.property(table) == back.property(require_property(back, property::line_table)));
  CHECK(mesh.property(barycentrics) == back.property(require_property(back, property::line_barycentrics)));
  CHECK(back.property(require_property(back, property::isotropic_faces)).empty());
  // A second passage changes no byte.
  write_mesh(back, folder / "b.om");
  CHECK((get(folder / "a.om") == get(folder / "b.om")));
}

TEST_CASE("feature edges from OBJ lines and from index pairs", "[io]") {
  const TemporaryFolder folder;
  put(folder / "a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\nl -1 1\n");
  CHECK(read_feature_edges(folder / "a.obj") == std::vector<std::pair<int, int>>{{0, 1}, {1, 2}, {2, 0}});
  put(folder / "a.txt", "# pairs\n0 1\n\n 7   3\n");
  CHECK(read_feature_edges(folder / "a.txt") == std::vector<std::pair<int, int>>{{0, 1}, {7, 3}});
  put(folder / "b.txt", "0 1\n2\n");
  CHECK_THAT(message_of([&] { read_feature_edges(folder / "b.txt"); }), Catch::Contains("line 2"));
}

TEST_CASE("the real meshes are read whole", "[io][data]") {
  for (const auto& name : demo_discs()) {
    const auto path = demo_mesh(name);
    if (!path) return skip(name);
    INFO(name);
    ReadReport report;
    const auto mesh = read_surface(*path, &report);
    CHECK(static_cast<long>(mesh.n_vertices()) - static_cast<long>(mesh.n_edges()) +
              static_cast<long>(mesh.n_faces()) ==
          1);
    CHECK(report.duplicated_vertices == 0);
    CHECK(report.duplicate_faces + report.degenerate_faces == 0);
  }
}
