// A position in a text file: used by every reader of a text format.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "surface/read/file_bytes.hpp"

namespace curveskel {

/// Steps through a text without copying it. The line number is counted only when a message needs
/// it. Lines end with LF or CR LF, or with CR alone where the text has no LF.
class TextCursor {
 public:
  /// The file must outlive the cursor. Skips a UTF-8 byte order mark.
  explicit TextCursor(const FileBytes& file);
  /// For a text with something else behind it, whose line ends are known.
  TextCursor(const FileBytes& file, char line_end);

  [[nodiscard]] bool done() const { return at_ == end_; }
  [[nodiscard]] bool at_line_end() const { return *at_ == line_end_ || at_ == end_; }
  /// The next character, 0 at the end of the text.
  [[nodiscard]] char peek() const { return *at_; }
  [[nodiscard]] std::size_t position() const { return static_cast<std::size_t>(at_ - begin_); }
  [[nodiscard]] std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }
  /// The share of the text before the cursor, 0..1.
  [[nodiscard]] double fraction() const;

  /// Spaces and tabs, and line ends behind a backslash.
  void skip_blanks() {
    while (is_blank(*at_) || (*at_ == '\\' && skip_continuation())) ++at_;
  }
  /// Blanks, line ends and, from `comment` (0 = none) on, the rest of a line.
  void skip_space(char comment);
  /// To the character behind the next line end.
  void skip_line();
  /// The same, except that a backslash before the line end continues the line.
  void skip_continued_line();
  void skip(std::size_t characters) { at_ += characters; }

  /// True if the next word is exactly this one; if so it is stepped over.
  bool accept(std::string_view word);
  /// Characters up to the next blank, line end or backslash that continues the line; empty only at
  /// one. Stepped over.
  std::string_view word();
  /// A finite number that ends at a blank, a line end, a comment or the end of the text. `needed`
  /// says what stands here, for the message of the Error(Fault::input) thrown otherwise.
  double number(std::string_view needed);
  /// The same, except that NaN and infinity, in any program's spelling, are numbers too.
  double coordinate(std::string_view needed);
  /// The three coordinates of a vertex, NaN and infinity among them, appended.
  void read_vertex(std::vector<double>& coordinates);
  /// An integer; what may follow it is the caller's business.
  std::int64_t integer(std::string_view needed);
  /// Throws like `number` unless a blank, a line end or a comment follows.
  void expect_word_end(std::string_view needed) const {
    if (!ends_word(at_) && *at_ != '#' && *at_ != '\\') {
      fail(needed, "correct it or export the file again");
    }
  }

  /// Throws Error(Fault::input) "FILE, line N: found FOUND, needed NEEDED; REMEDY" for the current
  /// line; without `found` it is the word at the cursor.
  [[noreturn]] void fail(std::string_view needed, std::string_view remedy,
                         std::string_view found = {}) const;

 private:
  [[nodiscard]] bool is_blank(char c) const {
    return c == ' ' || c == '\t' || (c == '\r' && line_end_ != '\r') || c == '\v' || c == '\f';
  }
  [[nodiscard]] bool ends_word(const char* c) const {
    return is_blank(*c) || *c == line_end_ || c == end_;
  }
  /// The line end behind a backslash that continues the line; nullptr = `c` is no such backslash.
  [[nodiscard]] const char* continuation(const char* c) const;
  bool skip_continuation();

  const FileBytes* file_;
  const char* begin_;
  const char* end_;
  const char* at_;
  char line_end_;
};

}  // namespace curveskel
