#include "view/binary.hh"

#include <array>
#include <stdexcept>

namespace view {

namespace {

constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::array<int, 256> digit_values() {
  std::array<int, 256> values{};
  values.fill(-1);
  for (size_t i = 0; i < digits.size(); ++i)
    values[static_cast<unsigned char>(digits[i])] = static_cast<int>(i);
  return values;
}

}  // namespace

std::string to_base64(const void* bytes, size_t count) {
  const auto* in = static_cast<const unsigned char*>(bytes);
  std::string out;
  out.reserve((count + 2) / 3 * 4);
  for (size_t i = 0; i < count; i += 3) {
    const unsigned a = in[i], b = i + 1 < count ? in[i + 1] : 0, c = i + 2 < count ? in[i + 2] : 0;
    const unsigned all = a << 16 | b << 8 | c;
    out += digits[all >> 18];
    out += digits[all >> 12 & 63];
    out += i + 1 < count ? digits[all >> 6 & 63] : '=';
    out += i + 2 < count ? digits[all & 63] : '=';
  }
  return out;
}

std::string from_base64(std::string_view text) {
  static const auto values = digit_values();
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::string out;
  out.reserve(text.size() / 4 * 3 + 2);
  unsigned all = 0;
  int bits = 0;
  for (const char c : text) {
    const int value = values[static_cast<unsigned char>(c)];
    if (value < 0) throw std::invalid_argument("not base64");
    all = all << 6 | static_cast<unsigned>(value);
    if ((bits += 6) < 8) continue;
    bits -= 8;
    out += static_cast<char>(all >> bits & 255);
  }
  return out;
}

}  // namespace view
