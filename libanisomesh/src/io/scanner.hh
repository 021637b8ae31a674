// Numbers and words of a text file, line by line, exact and independent of the locale.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>

#include "anisomesh/errors.hh"

namespace anisomesh::detail {

/// Walks through a text held in memory. After next_line(), word() and the numbers read that line.
class Scanner {
 public:
  /// \param comment starts a comment that reaches to the end of the line
  Scanner(std::string_view text, const std::string& path, char comment = '#', size_t first_line = 1)
      : next_(text.data()),
        end_(text.data() + text.size()),
        path_(path),
        comment_(comment),
        line_(first_line - 1) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";  // of UTF-8, as some editors write it
    if (text.substr(0, 3) == byte_order_mark) next_ += 3;
  }

  /// Moves to the next line that holds anything; false at the end of the file. Lines end with LF, CR LF or
  /// CR.
  bool next_line() {
    while (next_ != end_) {
      at_ = next_;
      const char* stop = at_;
      const char* text_end = nullptr;
      while (stop != end_ && *stop != '\n' && !(*stop == '\r' && stop + 1 != end_ && stop[1] != '\n')) {
        if (*stop == comment_ && !text_end) text_end = stop;
        ++stop;
      }
      line_end_ = text_end ? text_end : stop;
      next_ = stop == end_ ? end_ : stop + 1;
      ++line_;
      skip_blanks();
      if (at_ != line_end_) return true;
    }
    at_ = line_end_ = end_;
    return false;
  }

  bool at_end_of_line() {
    skip_blanks();
    return at_ == line_end_;
  }

  /// The next word of the line, empty at its end.
  std::string_view word() {
    skip_blanks();
    const char* begin = at_;
    while (at_ != line_end_ && !is_blank(*at_)) ++at_;
    return {begin, static_cast<size_t>(at_ - begin)};
  }

  /// The next word as a finite number.
  double number(const char* what) {
    const char* begin = at_;
    const double value = any_number(what);
    if (std::isfinite(value)) return value;
    at_ = begin;
    skip_blanks();
    fail(std::string("expected ") + what + " that is finite" + rest());
  }

  /// The next word as a number, which may be nan or inf.
  double any_number(const char* what) {
    skip_blanks();
    if (at_ != line_end_ && *at_ == '+') ++at_;
    double value = 0;
    const auto [stop, error] = std::from_chars(at_, line_end_, value);
    if (error == std::errc::result_out_of_range) value = std::strtod(std::string(at_, stop).c_str(), nullptr);
    if (error == std::errc::invalid_argument || (stop != line_end_ && !is_blank(*stop)))
      fail(std::string("expected ") + what + rest());
    at_ = stop;
    return value;
  }

  /// The next word as an integer; stops also in front of '/', as in an OBJ's 1/2/3.
  long long integer(const char* what) {
    skip_blanks();
    long long value = 0;
    const auto [stop, error] = std::from_chars(at_, line_end_, value);
    if (error != std::errc() || (stop != line_end_ && !is_blank(*stop) && *stop != '/'))
      fail(std::string("expected ") + what + rest());
    at_ = stop;
    return value;
  }

  /// Skips what hangs on the number that was just read, as the /2/3 of an OBJ's 1/2/3.
  void skip_to_blank() {
    while (at_ != line_end_ && !is_blank(*at_)) ++at_;
  }

  size_t line() const { return line_; }
  /// What follows the current line.
  std::string_view remainder() const { return {next_, static_cast<size_t>(end_ - next_)}; }

  [[noreturn]] void fail(const std::string& message) const {
    throw InvalidInput(path_ + ": line " + std::to_string(line_) + ": " + message);
  }
  /// For a file that stops too early.
  [[noreturn]] void fail_at_end(const std::string& message) const {
    throw InvalidInput(path_ + ": the file ends early: " + message + "; is it complete?");
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }
  void skip_blanks() {
    while (at_ != line_end_ && is_blank(*at_)) ++at_;
  }
  std::string rest() const {
    if (at_ == line_end_) return ", but the line ends";
    const size_t length = static_cast<size_t>(line_end_ - at_);
    std::string found(at_, length < 24 ? length : 24);
    for (char& c : found)
      if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126) c = '?';
    return ", found '" + found + "'";
  }

  const char* next_;
  const char* end_;
  const char* at_ = nullptr;
  const char* line_end_ = nullptr;
  std::string path_;
  char comment_;
  size_t line_;
};

}  // namespace anisomesh::detail
