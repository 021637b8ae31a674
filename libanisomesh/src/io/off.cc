#include "io/scanner.hh"
#include "io/soup.hh"

namespace anisomesh::detail {

namespace {

/// Whether a word is OFF's keyword, in capitals or not: [ST][C][N]OFF says what follows the place in the line
/// of a vertex, which is skipped.
bool is_keyword(std::string word) {
  for (char& c : word)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  if (word.size() < 3 || word.compare(word.size() - 3, 3, "OFF") != 0) return false;
  word.resize(word.size() - 3);
  if (word.compare(0, 2, "ST") == 0) word.erase(0, 2);
  return word.find_first_not_of("CN") == std::string::npos;
}

/// Reads the header's keyword if there is one, and leaves the scanner in front of the counts.
void read_keyword(Scanner& scanner, const std::string& path) {
  if (!scanner.next_line()) throw InvalidInput(path + ": the file is empty");
  Scanner ahead = scanner;
  const std::string keyword(ahead.word());
  if (!keyword.empty() && keyword.find_first_not_of("0123456789") == std::string::npos) return;
  if (!is_keyword(keyword))
    scanner.fail("expected 'OFF' (three dimensions), so this is no OFF file that can be read");
  scanner = ahead;
  if (scanner.at_end_of_line()) {
    if (!scanner.next_line()) scanner.fail_at_end("there are no counts");
    return;
  }
  ahead = scanner;
  if (ahead.word() == "BINARY") scanner.fail("binary OFF is not read; convert it to text, PLY or OBJ");
}

size_t count(Scanner& scanner, const char* what) {
  const long long value = scanner.integer(what);
  if (value < 0 || value > 0x7ffffffe) scanner.fail(std::string(what) + " is out of range");
  return static_cast<size_t>(value);
}

}  // namespace

Soup read_off(const std::string& text, const std::string& path) {
  Scanner scanner(text, path);
  read_keyword(scanner, path);
  const size_t n_points = count(scanner, "the number of vertices");
  const size_t n_faces = count(scanner, "the number of faces");

  Soup soup;
  // A line needs two bytes at least: a wrong count does not reserve the moon.
  soup.points.reserve(std::min(n_points, text.size() / 2));
  soup.begins.reserve(std::min(n_faces, text.size() / 2) + 1);
  for (size_t i = 0; i < n_points; ++i) {
    if (!scanner.next_line())
      scanner.fail_at_end("it has " + std::to_string(i) + " of " + std::to_string(n_points) + " vertices");
    const double x = scanner.number("a coordinate"), y = scanner.number("a coordinate");
    soup.points.emplace_back(x, y, scanner.number("a coordinate"));
  }
  for (size_t f = 0; f < n_faces; ++f) {
    if (!scanner.next_line())
      scanner.fail_at_end("it has " + std::to_string(f) + " of " + std::to_string(n_faces) + " faces");
    const long long degree = scanner.integer("the number of corners");
    // Geomview's OFF allows points and segments as faces; a surface has no use for them.
    if (degree < 1) scanner.fail("face " + std::to_string(f) + " has " + std::to_string(degree) + " corners");
    for (long long k = 0; k < degree; ++k) {
      const long long index = scanner.integer("a vertex index");
      if (index < 0 || static_cast<size_t>(index) >= n_points)
        scanner.fail("face " + std::to_string(f) + " names vertex " + std::to_string(index) +
                     ", but vertices count from 0 to " +
                     std::to_string(static_cast<long long>(n_points) - 1));
      soup.corners.push_back(static_cast<int>(index));
    }
    if (degree < 3)
      soup.corners.resize(soup.begins.back());
    else
      soup.end_face();
  }
  return soup;
}

}  // namespace anisomesh::detail
