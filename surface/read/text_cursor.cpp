#include "surface/read/text_cursor.hpp"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <system_error>

namespace curveskel {

TextCursor::TextCursor(const FileBytes& file)
    : TextCursor(file, file.content.find('\n') != std::string::npos ? '\n' : '\r') {}

TextCursor::TextCursor(const FileBytes& file, char line_end)
    : file_(&file),
      begin_(file.content.data()),
      end_(begin_ + file.content.size()),
      at_(begin_),
      line_end_(line_end) {
  if (file.content.starts_with("\xEF\xBB\xBF")) at_ += 3;
}

double TextCursor::fraction() const {
  return static_cast<double>(at_ - begin_) / std::max(1.0, static_cast<double>(end_ - begin_));
}

const char* TextCursor::continuation(const char* c) const {
  if (*c != '\\') return nullptr;
  const char* next = c + 1;
  if (*next == '\r' && line_end_ != '\r') ++next;
  return *next == line_end_ && next != end_ ? next : nullptr;
}

bool TextCursor::skip_continuation() {
  const char* const next = continuation(at_);
  if (next != nullptr) at_ = next;
  return next != nullptr;
}

void TextCursor::skip_space(char comment) {
  for (;;) {
    while (is_blank(*at_) || *at_ == line_end_) ++at_;
    if (comment == 0 || *at_ != comment) return;
    skip_line();
  }
}

void TextCursor::skip_line() {
  const void* stop = std::memchr(at_, line_end_, bytes_left());
  at_ = stop == nullptr ? end_ : static_cast<const char*>(stop) + 1;
}

void TextCursor::skip_continued_line() {
  for (bool continued = true; continued && at_ != end_;) {
    const char* begin = at_;
    skip_line();
    const char* last = at_[-1] == line_end_ ? at_ - 1 : at_;
    while (last > begin && last[-1] == '\r') --last;
    continued = last > begin && last[-1] == '\\';
  }
}

bool TextCursor::accept(std::string_view word) {
  if (bytes_left() < word.size() || std::string_view(at_, word.size()) != word ||
      !ends_word(at_ + word.size())) {
    return false;
  }
  at_ += word.size();
  return true;
}

std::string_view TextCursor::word() {
  const char* begin = at_;
  while (!ends_word(at_) && continuation(at_) == nullptr) ++at_;
  return {begin, static_cast<std::size_t>(at_ - begin)};
}

double TextCursor::number(std::string_view needed) {
  const TextCursor start = *this;
  const double value = coordinate(needed);
  if (!std::isfinite(value)) {
    start.fail(std::string(needed) + " that is finite", "correct it or export the file again");
  }
  return value;
}

double TextCursor::coordinate(std::string_view needed) {
  double value = 0;
  const char* first = *at_ == '+' ? at_ + 1 : at_;
  const auto [next, error] = fast_float::from_chars(first, end_, value);
  // Older C libraries of Windows write 1.#INF, -1.#IND and 1.#QNAN.
  const bool of_windows = *next == '#' && next + 1 != end_ && (next[1] == 'I' || next[1] == 'Q');
  const bool ended = ends_word(next) || *next == '#' || *next == '\\';
  if (error != std::errc() || !ended) fail(needed, "correct it or export the file again");
  at_ = next;
  if (!of_windows) return value;
  word();
  return std::numeric_limits<double>::quiet_NaN();
}

void TextCursor::read_vertex(std::vector<double>& coordinates) {
  constexpr std::array<std::string_view, 3> needed{"the x coordinate of a vertex",
                                                   "the y coordinate of a vertex",
                                                   "the z coordinate of a vertex"};
  for (const auto& name : needed) {
    skip_blanks();
    coordinates.push_back(coordinate(name));
  }
}

std::int64_t TextCursor::integer(std::string_view needed) {
  std::int64_t value = 0;
  const char* first = *at_ == '+' ? at_ + 1 : at_;
  const auto [next, error] = std::from_chars(first, end_, value);
  if (error != std::errc()) fail(needed, "correct it or export the file again");
  at_ = next;
  return value;
}

void TextCursor::fail(std::string_view needed, std::string_view remedy,
                      std::string_view found) const {
  TextCursor rest = *this;
  std::string what(found);
  if (what.empty()) {
    const std::string_view word = rest.word();
    what = done() ? "the end of the file" : word.empty() ? "the end of the line" : in_quotes(word);
  }
  const auto line = 1 + std::count(begin_, at_, line_end_);
  throw Error(Fault::input, file_->path.string() + ", line " + std::to_string(line) + ": found " +
                                what + ", needed " + std::string(needed) + "; " +
                                std::string(remedy));
}

}  // namespace curveskel
