#include <cstdint>
#include <cstring>
#include <unordered_map>

#include "io/scanner.hh"
#include "io/soup.hh"

namespace anisomesh::detail {

namespace {

struct ByCoordinates {
  static std::uint64_t bits(double x) {
    std::uint64_t b;
    x += 0.0;  // -0 and 0 are the same place
    std::memcpy(&b, &x, sizeof b);
    return b;
  }
  size_t operator()(const Vec3d& p) const {
    std::uint64_t h = 0;
    for (int i = 0; i < 3; ++i) {
      h = (h ^ bits(p[i])) * 0x9e3779b97f4a7c15u;
      h ^= h >> 32;
    }
    return static_cast<size_t>(h);
  }
};

/// Collects corners; equal coordinates are one vertex, numbered by first appearance.
class Merger {
 public:
  explicit Merger(Soup& soup) : soup_(soup) {}
  void add(const Vec3d& p) {
    const auto [found, is_new] = vertices_.emplace(p, static_cast<int>(soup_.points.size()));
    if (is_new) soup_.points.push_back(p);
    soup_.corners.push_back(found->second);
    ++corners_;
  }
  size_t merged() const { return corners_ - soup_.points.size(); }

 private:
  Soup& soup_;
  std::unordered_map<Vec3d, int, ByCoordinates> vertices_;
  size_t corners_ = 0;
};

/// Keywords may be in capitals.
std::string lower(std::string_view word) {
  std::string result(word);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

/// Whether a file that is no binary one by its size begins as a text one, with anything in it.
bool is_text(const std::string& text) {
  const size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos || lower(std::string_view(text).substr(begin, 5)) != "solid") return false;
  const std::string all = lower(text);
  return all.find("facet", begin) != std::string::npos || all.find("endsolid", begin) != std::string::npos;
}

void read_ascii(const std::string& text, const std::string& path, Soup& soup, Merger& merger) {
  Scanner scanner(text, path, '\0');
  size_t corners = 0;
  bool ended = false;
  while (scanner.next_line()) {
    const std::string keyword = lower(scanner.word());
    if (keyword == "vertex") {
      const double x = scanner.number("a coordinate"), y = scanner.number("a coordinate");
      merger.add({x, y, scanner.number("a coordinate")});
      ++corners;
    } else if (keyword == "endloop") {
      if (corners != 3)
        scanner.fail("facet " + std::to_string(soup.n_faces()) + " has " + std::to_string(corners) +
                     " vertices, not 3");
      soup.end_face();
      corners = 0;
    } else if (keyword == "endsolid") {
      ended = true;
    } else if (keyword == "solid") {
      ended = false;
    } else if (keyword != "facet" && keyword != "outer" && keyword != "endfacet") {
      scanner.fail("expected a keyword of STL, found '" + keyword.substr(0, 24) + "'");
    }
  }
  if (!ended) scanner.fail_at_end("there is no 'endsolid'");
}

void read_binary(const std::string& text, const std::string& path, Soup& soup, Merger& merger) {
  const size_t n = (text.size() - 84) / 50;
  for (size_t f = 0; f < n; ++f) {
    const char* facet = text.data() + 84 + 50 * f + 12;  // behind the normal
    for (size_t k = 0; k < 3; ++k) {
      float p[3];
      std::memcpy(p, facet + 12 * k, sizeof p);
      if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
        throw InvalidInput(path + ": facet " + std::to_string(f) + " has a coordinate that is not finite");
      merger.add({p[0], p[1], p[2]});
    }
    soup.end_face();
  }
}

}  // namespace

Soup read_stl(const std::string& text, const std::string& path, ReadReport& report) {
  Soup soup;
  Merger merger(soup);
  std::uint32_t facets = 0;
  if (text.size() >= 84) std::memcpy(&facets, text.data() + 80, sizeof facets);
  // A binary file may begin with "solid" too: its size decides.
  if (text.size() >= 84 && text.size() == 84 + 50 * static_cast<size_t>(facets)) {
    read_binary(text, path, soup, merger);
  } else if (is_text(text)) {
    read_ascii(text, path, soup, merger);
  } else if (text.size() >= 84) {
    throw InvalidInput(path + ": the size is " + std::to_string(text.size()) +
                       " bytes, but a binary STL with " + std::to_string(facets) + " facets has " +
                       std::to_string(84 + 50 * static_cast<size_t>(facets)) + "; is it complete?");
  } else {
    throw InvalidInput(path + ": neither a text nor a binary STL file");
  }
  report.merged_vertices = merger.merged();
  return soup;
}

}  // namespace anisomesh::detail
