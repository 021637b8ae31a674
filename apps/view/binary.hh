// Arrays of numbers as base64 sections of a page: a third larger than the bytes, and decoded at memory speed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace view {

std::string to_base64(const void* bytes, size_t count);
/// \throw std::invalid_argument where the text is no base64
std::string from_base64(std::string_view text);

/// One array of the page: little-endian numbers, `components` of them an element.
struct Section {
  std::string type;  ///< f32, u32, i16, u16 or u8, as page code reads it
  size_t components = 1;
  std::string base64;
};

template <class T>
Section section(const std::vector<T>& values, size_t components) {
  static_assert(std::is_arithmetic_v<T> && sizeof(T) <= 4);
  std::string type = std::is_floating_point_v<T> ? "f" : std::is_signed_v<T> ? "i" : "u";
  type += std::to_string(8 * sizeof(T));
  return {type, components, to_base64(values.data(), values.size() * sizeof(T))};
}

}  // namespace view
