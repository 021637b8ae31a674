#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

#include "io/scanner.hh"
#include "io/soup.hh"

namespace anisomesh::detail {

namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

constexpr size_t size_of(Type type) {
  switch (type) {
    case Type::int8:
    case Type::uint8:
      return 1;
    case Type::int16:
    case Type::uint16:
      return 2;
    case Type::int32:
    case Type::uint32:
    case Type::float32:
      return 4;
    case Type::float64:
      return 8;
  }
  return 0;
}

struct PlyProperty {
  std::string name;
  Type type;
  bool is_list = false;
  Type count_type = Type::uint8;
};

struct Element {
  std::string name;
  size_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class Encoding { ascii, little, big };

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
};

Type type_of(std::string_view word, const Scanner& scanner) {
  static const std::pair<const char*, Type> names[] = {
      {"char", Type::int8},      {"int8", Type::int8},       {"uchar", Type::uint8},
      {"uint8", Type::uint8},    {"short", Type::int16},     {"int16", Type::int16},
      {"ushort", Type::uint16},  {"uint16", Type::uint16},   {"int", Type::int32},
      {"int32", Type::int32},    {"uint", Type::uint32},     {"uint32", Type::uint32},
      {"float", Type::float32},  {"float32", Type::float32}, {"double", Type::float64},
      {"float64", Type::float64}};
  for (const auto& [name, type] : names)
    if (word == name) return type;
  scanner.fail("'" + std::string(word.substr(0, 24)) + "' is no type of PLY");
}

void read_header_line(Scanner& scanner, Header& header) {
  const auto keyword = scanner.word();
  if (keyword == "format") {
    const auto name = scanner.word();
    if (name == "ascii")
      header.encoding = Encoding::ascii;
    else if (name == "binary_little_endian")
      header.encoding = Encoding::little;
    else if (name == "binary_big_endian")
      header.encoding = Encoding::big;
    else
      scanner.fail("unknown format '" + std::string(name.substr(0, 24)) + "'");
  } else if (keyword == "element") {
    Element element;
    element.name = scanner.word();
    const long long count = scanner.integer("a number of elements");
    if (count < 0 || count > 0x7ffffffe) scanner.fail("the number of elements is out of range");
    element.count = static_cast<size_t>(count);
    header.elements.push_back(std::move(element));
  } else if (keyword == "property") {
    if (header.elements.empty()) scanner.fail("a property in front of the first element");
    PlyProperty property;
    auto word = scanner.word();
    if (word == "list") {
      property.is_list = true;
      property.count_type = type_of(scanner.word(), scanner);
      word = scanner.word();
    }
    property.type = type_of(word, scanner);
    property.name = scanner.word();
    header.elements.back().properties.push_back(std::move(property));
  } else if (keyword != "comment" && keyword != "obj_info") {
    scanner.fail("'" + std::string(keyword.substr(0, 24)) + "' is no keyword of PLY");
  }
}

/// One number after the other, as text or bytes.
class Body {
 public:
  Body(Scanner& scanner, Encoding encoding, const std::string& path)
      : scanner_(scanner), encoding_(encoding), path_(path), bytes_(scanner.remainder()) {}

  void begin(const Element& element, size_t index) {
    element_ = &element;
    index_ = index;
  }
  double read(Type type) { return encoding_ == Encoding::ascii ? read_text() : read_bytes(type); }

  [[noreturn]] void fail(const std::string& message) const {
    throw InvalidInput(path_ + ": " + element_->name + " " + std::to_string(index_) + ": " + message);
  }

 private:
  double read_text() {
    while (scanner_.at_end_of_line())
      if (!scanner_.next_line()) fail_at_end();
    return scanner_.any_number("a number");
  }

  double read_bytes(Type type) {
    const size_t n = size_of(type);
    if (at_ + n > bytes_.size()) fail_at_end();
    unsigned char b[8];
    for (size_t i = 0; i < n; ++i)
      b[encoding_ == Encoding::little ? i : n - 1 - i] = static_cast<unsigned char>(bytes_[at_ + i]);
    at_ += n;
    switch (type) {
      case Type::int8:
        return as<std::int8_t>(b);
      case Type::uint8:
        return as<std::uint8_t>(b);
      case Type::int16:
        return as<std::int16_t>(b);
      case Type::uint16:
        return as<std::uint16_t>(b);
      case Type::int32:
        return as<std::int32_t>(b);
      case Type::uint32:
        return as<std::uint32_t>(b);
      case Type::float32:
        return static_cast<double>(as<float>(b));
      case Type::float64:
        return as<double>(b);
    }
    return 0;
  }

  /// The bytes are in little-endian order here, as on every machine that Debian's amd64 and arm64 know.
  template <class T>
  static T as(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
  }

  [[noreturn]] void fail_at_end() const {
    throw InvalidInput(path_ + ": the file ends early, in " + element_->name + " " + std::to_string(index_) +
                       " of " + std::to_string(element_->count) + "; is it complete?");
  }

  Scanner& scanner_;
  Encoding encoding_;
  const std::string& path_;
  std::string_view bytes_;
  size_t at_ = 0;
  const Element* element_ = nullptr;
  size_t index_ = 0;
};

/// How many values of a property follow.
size_t values_of(Body& body, const PlyProperty& property) {
  if (!property.is_list) return 1;
  const double count = body.read(property.count_type);
  if (!(count >= 0 && count <= std::numeric_limits<uint32_t>::max()))
    body.fail("a list of " + std::to_string(count) + " elements");
  return static_cast<size_t>(count);
}

void read_vertex(Body& body, const Element& element, Soup& soup) {
  Vec3d p(0, 0, 0);
  for (const auto& property : element.properties) {
    const size_t n = values_of(body, property);
    for (size_t i = 0; i < n; ++i) {
      const double value = body.read(property.type);
      if (property.is_list || property.name.size() != 1 || property.name[0] < 'x' || property.name[0] > 'z')
        continue;
      p[property.name[0] - 'x'] = value;
    }
  }
  soup.points.push_back(p);
}

bool is_corners(const PlyProperty& property) {
  return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
}

void read_face(Body& body, const Element& element, size_t n_points, Soup& soup) {
  for (const auto& property : element.properties) {
    const bool wanted = is_corners(property);
    const size_t count = values_of(body, property);
    for (size_t i = 0; i < count; ++i) {
      const double value = body.read(property.type);
      if (!wanted) continue;
      if (!(value >= 0 && value < static_cast<double>(n_points)) || value != std::floor(value))
        body.fail("it names a vertex that is not there; vertices count from 0 to " +
                  std::to_string(static_cast<long long>(n_points) - 1));
      soup.corners.push_back(static_cast<int>(value));
    }
  }
  if (soup.corners.size() - soup.begins.back() < 3)
    soup.corners.resize(soup.begins.back());  // points and segments are no part of a surface
  else
    soup.end_face();
}

/// Range scanners write places that they have not seen as nan, which does no harm where no face uses them.
void require_finite(const Soup& soup, const std::string& path) {
  const auto is_finite = [](const Vec3d& p) {
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
  };
  for (const int v : soup.corners)
    if (!is_finite(soup.points[static_cast<size_t>(v)]))
      throw InvalidInput(path + ": vertex " + std::to_string(v) + ": a coordinate is not finite");
}

void require_corners(const Element& face, const std::string& path) {
  if (face.count == 0 || std::any_of(face.properties.begin(), face.properties.end(), is_corners)) return;
  throw InvalidInput(path + ": the faces have no list 'vertex_indices' or 'vertex_index'");
}

size_t require_coordinates(const Header& header, const std::string& path) {
  for (const auto& element : header.elements)
    if (element.name == "vertex") {
      int found = 0;
      for (const auto& property : element.properties)
        found += !property.is_list && (property.name == "x" || property.name == "y" || property.name == "z");
      if (found != 3) throw InvalidInput(path + ": the vertices have no x, y and z");
      return element.count;
    }
  throw InvalidInput(path + ": there is no element 'vertex'");
}

}  // namespace

Soup read_ply(const std::string& text, const std::string& path) {
  Scanner scanner(text, path, '\0');
  if (!scanner.next_line()) throw InvalidInput(path + ": the file is empty");
  if (scanner.word() != "ply") scanner.fail("expected 'ply', so this is no PLY file");
  Header header;
  while (true) {
    if (!scanner.next_line()) scanner.fail_at_end("there is no 'end_header'");
    Scanner ahead = scanner;
    if (ahead.word() == "end_header") break;
    read_header_line(scanner, header);
  }
  scanner.word();
  const size_t n_points = require_coordinates(header, path);

  Soup soup;
  Body body(scanner, header.encoding, path);
  for (const auto& element : header.elements) {
    if (element.name == "tristrips") throw InvalidInput(path + ": triangle strips are not read; write faces");
    if (element.name == "face") require_corners(element, path);
    if (element.properties.empty()) continue;
    for (size_t i = 0; i < element.count; ++i) {
      body.begin(element, i);
      if (element.name == "vertex") {
        read_vertex(body, element, soup);
      } else if (element.name == "face") {
        read_face(body, element, n_points, soup);
      } else {
        for (const auto& property : element.properties) {
          const size_t count = values_of(body, property);
          for (size_t k = 0; k < count; ++k) body.read(property.type);
        }
      }
    }
  }
  require_finite(soup, path);
  return soup;
}

}  // namespace anisomesh::detail
