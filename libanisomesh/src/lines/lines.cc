#include "anisomesh/lines.hh"

#include <string>

#include "anisomesh/properties.hh"

namespace anisomesh {

namespace {

constexpr size_t kEntries = 5;  // of the line table, for each line

void append(std::vector<int>& faces, std::vector<double>& barycentrics, const SurfacePoint& point) {
  faces.push_back(point.face.idx());
  for (int i = 0; i < 3; ++i) barycentrics.push_back(point.barycentric[i]);
}

std::vector<SurfacePoint> unpack(const std::vector<int>& faces, const std::vector<double>& barycentrics,
                                 size_t n_faces, const char* what) {
  const auto refuse = [what](const std::string& problem) {
    throw InvalidInput(std::string("the ") + what + " kept on the mesh do not fit it (" + problem +
                       "); run trace_lines() again");
  };
  if (barycentrics.size() != 3 * faces.size()) refuse("three barycentric coordinates a point are needed");
  std::vector<SurfacePoint> points(faces.size());
  for (size_t i = 0; i < faces.size(); ++i) {
    if (faces[i] < 0 || static_cast<size_t>(faces[i]) >= n_faces)
      refuse("point " + std::to_string(i) + " lies in face " + std::to_string(faces[i]));
    points[i] = {OpenMesh::FaceHandle(faces[i]),
                 {barycentrics[3 * i], barycentrics[3 * i + 1], barycentrics[3 * i + 2]}};
  }
  return points;
}

Line unpack_line(const int* entry, size_t first, size_t last, const std::vector<SurfacePoint>& points) {
  Line line;
  line.kind = static_cast<LineKind>(entry[0]);
  line.closed = entry[1] != 0;
  line.begin_reason = static_cast<LineEnd>(entry[2]);
  line.end_reason = static_cast<LineEnd>(entry[3]);
  line.points.assign(points.begin() + static_cast<std::ptrdiff_t>(first),
                     points.begin() + static_cast<std::ptrdiff_t>(last));
  return line;
}

void check_entry(const std::vector<int>& table, size_t line, size_t n_points) {
  const int* entry = &table[line * kEntries];
  const auto reason_fits = [](int reason) {
    return reason >= 0 && reason <= static_cast<int>(LineEnd::step_limit);
  };
  const size_t first = static_cast<size_t>(entry[4]);
  const size_t before = line == 0 ? 0 : static_cast<size_t>(table[line * kEntries - 1]);
  const bool fits = (entry[0] == 0 || entry[0] == 1) && reason_fits(entry[2]) && reason_fits(entry[3]) &&
                    entry[4] >= 0 && first <= n_points && first >= before && (line > 0 || first == 0);
  if (!fits)
    throw InvalidInput("line " + std::to_string(line) +
                       " of the table kept on the mesh makes no sense; run trace_lines() again");
}

}  // namespace

LineNetwork read_lines(const SurfaceRef& surface) {
  auto& mesh = surface.connectivity();
  const auto& table = mesh.property(require_property(mesh, property::line_table));
  const auto& faces = mesh.property(require_property(mesh, property::line_faces));
  const auto& barycentrics = mesh.property(require_property(mesh, property::line_barycentrics));
  const auto points = unpack(faces, barycentrics, mesh.n_faces(), "lines");
  if (table.size() % kEntries != 0)
    throw InvalidInput("the table of lines kept on the mesh is cut off; run trace_lines() again");

  LineNetwork network;
  const size_t n_lines = table.size() / kEntries;
  for (size_t i = 0; i < n_lines; ++i) check_entry(table, i, points.size());
  for (size_t i = 0; i < n_lines; ++i) {
    const size_t first = static_cast<size_t>(table[i * kEntries + 4]);
    const size_t last = i + 1 < n_lines ? static_cast<size_t>(table[(i + 2) * kEntries - 1]) : points.size();
    network.lines.push_back(unpack_line(&table[i * kEntries], first, last, points));
  }
  if (has_property(mesh, property::isotropic_faces))
    network.isotropic_samples =
        unpack(mesh.property(require_property(mesh, property::isotropic_faces)),
               mesh.property(require_property(mesh, property::isotropic_barycentrics)), mesh.n_faces(),
               "isotropic samples");
  return network;
}

void write_lines(const SurfaceRef& surface, const LineNetwork& network) {
  std::vector<int> table, faces, isotropic_faces;
  std::vector<double> barycentrics, isotropic_barycentrics;
  for (const Line& line : network.lines) {
    table.insert(table.end(),
                 {static_cast<int>(line.kind), line.closed ? 1 : 0, static_cast<int>(line.begin_reason),
                  static_cast<int>(line.end_reason), static_cast<int>(faces.size())});
    for (const SurfacePoint& point : line.points) append(faces, barycentrics, point);
  }
  for (const SurfacePoint& point : network.isotropic_samples)
    append(isotropic_faces, isotropic_barycentrics, point);

  auto& mesh = surface.connectivity();
  mesh.property(provide_property(mesh, property::line_table)) = std::move(table);
  mesh.property(provide_property(mesh, property::line_faces)) = std::move(faces);
  mesh.property(provide_property(mesh, property::line_barycentrics)) = std::move(barycentrics);
  mesh.property(provide_property(mesh, property::isotropic_faces)) = std::move(isotropic_faces);
  mesh.property(provide_property(mesh, property::isotropic_barycentrics)) = std::move(isotropic_barycentrics);
}

}  // namespace anisomesh
