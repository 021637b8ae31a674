#include <algorithm>

#include "io/scanner.hh"
#include "io/soup.hh"

namespace anisomesh::detail {

namespace {

/// An OBJ index, 1-based or counted back from the last vertex, as a 0-based one; may point ahead.
int vertex_index(Scanner& scanner, size_t n_points, const char* element) {
  const long long index = scanner.integer("a vertex index");
  if (index == 0) scanner.fail(std::string(element) + " names vertex 0, but OBJ counts from 1");
  const long long found = index > 0 ? index - 1 : static_cast<long long>(n_points) + index;
  if (found < 0 || found > 0x7ffffffe)
    scanner.fail(std::string(element) + " names vertex " + std::to_string(index) + ", which is not there");
  scanner.skip_to_blank();  // /texture/normal
  return static_cast<int>(found);
}

/// Joins lines that end in a backslash; the line count is kept by leaving the line ends behind the joined
/// text.
std::string join_continued_lines(const std::string& text) {
  std::string joined;
  joined.reserve(text.size());
  size_t owed = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool crlf = text.compare(i, 3, "\\\r\n") == 0;
    if (crlf || text.compare(i, 2, "\\\n") == 0) {
      joined += ' ';
      ++owed;
      i += crlf ? 2 : 1;
    } else {
      joined += text[i];
      if (text[i] == '\n') {
        joined.append(owed, '\n');
        owed = 0;
      }
    }
  }
  return joined;
}

}  // namespace

Soup read_obj(const std::string& text, const std::string& path) {
  const bool continued = text.find("\\\n") != std::string::npos || text.find("\\\r\n") != std::string::npos;
  const std::string joined = continued ? join_continued_lines(text) : std::string();
  Scanner scanner(continued ? joined : text, path);
  Soup soup;
  std::vector<size_t> face_lines;
  while (scanner.next_line()) {
    const auto keyword = scanner.word();
    if (keyword == "v") {
      const double x = scanner.number("a coordinate"), y = scanner.number("a coordinate");
      soup.points.emplace_back(x, y, scanner.number("a coordinate"));
    } else if (keyword == "f") {
      while (!scanner.at_end_of_line())
        soup.corners.push_back(vertex_index(scanner, soup.points.size(), "the face"));
      if (soup.corners.size() - soup.begins.back() < 3) scanner.fail("a face needs three corners");
      soup.end_face();
      face_lines.push_back(scanner.line());
    } else if (keyword == "l") {
      int last = vertex_index(scanner, soup.points.size(), "the line");
      while (!scanner.at_end_of_line()) {
        const int next = vertex_index(scanner, soup.points.size(), "the line");
        soup.segments.emplace_back(last, next);
        last = next;
      }
    }
  }
  for (size_t f = 0; f < soup.n_faces(); ++f) {
    const int largest = *std::max_element(soup.face(f), soup.face(f) + soup.degree(f));
    if (static_cast<size_t>(largest) >= soup.points.size())
      throw InvalidInput(path + ": line " + std::to_string(face_lines[f]) + ": the face names vertex " +
                         std::to_string(largest + 1) + ", but the file has " +
                         std::to_string(soup.points.size()) + " vertices");
  }
  return soup;
}

}  // namespace anisomesh::detail
