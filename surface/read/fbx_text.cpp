// FBX as text: "Name: value, value { records }"; from version 7 on, an array is "*8 { a: 1,2,.. }".
#include <fast_float/fast_float.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <system_error>

#include "surface/read/fbx_tree.hpp"

namespace curveskel {
namespace {

bool is_fbx_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool is_of_fbx_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '|' || c == '-' || c == '+' || c == '.' || c == '$';
}

class FbxTextReader {
 public:
  explicit FbxTextReader(const FileBytes& file) : file_(file), text_(file.content) {}

  FbxRecord read() {
    FbxRecord root;
    read_children(root, 0);
    if (at_ != text_.size()) fail("a record");
    return root;
  }

 private:
  [[noreturn]] void fail(std::string_view needed) const {
    const auto line = 1 + std::count(text_.begin(), text_.begin() + std::ptrdiff_t(at_), '\n');
    file_.fail((at_ == text_.size() ? "the end of the file" : in_quotes(text_.substr(at_, 30))) +
                   " in line " + std::to_string(line),
               needed, fbx_remedy);
  }
  [[nodiscard]] char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void skip_blanks() {
    while (is_fbx_blank(peek())) ++at_;
  }
  /// Line ends and comments, too.
  void skip_space() {
    for (;;) {
      while (is_fbx_blank(peek()) || peek() == '\n') ++at_;
      if (peek() != ';') return;
      at_ = std::min(text_.find('\n', at_), text_.size());
    }
  }
  std::string_view take_word() {
    const std::size_t begin = at_;
    while (is_of_fbx_word(peek())) ++at_;
    if (at_ == begin) fail("a word");
    return text_.substr(begin, at_ - begin);
  }

  /// Up to a closing brace, or the end of the file.
  void read_children(FbxRecord& parent, int depth) {
    if (depth > deepest_fbx_record) fail("records nested less deep");
    for (skip_space(); at_ < text_.size() && peek() != '}'; skip_space()) {
      FbxRecord record;
      record.position = at_;
      record.name = take_word();
      skip_blanks();
      if (peek() != ':') fail("\":\" behind a name");
      ++at_;
      read_values(record);
      skip_blanks();
      if (peek() == '{') {
        ++at_;
        read_children(record, depth + 1);
        if (peek() != '}') fail("\"}\"");
        ++at_;
      }
      parent.children.push_back(std::move(record));
    }
  }

  /// A comma at the end of a line, or at the start of the next, continues the list.
  void read_values(FbxRecord& record) {
    for (skip_blanks();; skip_space()) {
      const char c = peek();
      if (c == '*') {
        record.values.emplace_back(take_array());
        return;
      }
      if (c == '"') {
        record.values.emplace_back(take_quoted());
      } else if (is_of_fbx_word(c)) {
        record.values.push_back(value_of(take_word()));
      }
      skip_blanks();
      const std::size_t end = at_;
      if (peek() == '\n') skip_space();
      if (peek() != ',') {
        at_ = end;
        return;
      }
      ++at_;
    }
  }

  std::string_view take_quoted() {
    const std::size_t begin = ++at_;
    const std::size_t end = text_.find('"', begin);
    if (end == std::string_view::npos) fail("a closing quotation mark");
    at_ = end + 1;
    return text_.substr(begin, end - begin);
  }

  static FbxValue value_of(std::string_view word) {
    const char* const end = word.data() + word.size();
    std::int64_t integer = 0;
    const auto [next, error] = std::from_chars(word.data(), end, integer);
    if (error == std::errc() && next == end) return integer;
    double number = 0;
    const auto [after, wrong] = fast_float::from_chars(word.data(), end, number);
    if (wrong == std::errc() && after == end) return number;
    return word;
  }

  /// "*8 { a: 1,2,3,... }": the text of the numbers.
  FbxArray take_array() {
    ++at_;
    (void)take_word();  // the count, which the numbers tell
    skip_space();
    if (peek() != '{') fail("\"{\" behind the size of an array");
    const std::size_t colon = text_.find(':', at_);
    const std::size_t end = text_.find('}', at_);
    if (end == std::string_view::npos) fail("\"}\" behind an array");
    const std::size_t begin = colon < end ? colon + 1 : at_ + 1;
    at_ = end + 1;
    return {'t', 0, false, text_.substr(begin, end - begin)};
  }

  const FileBytes& file_;
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

FbxRecord parse_text_fbx(const FileBytes& file) {
  if (file.content.starts_with("Kaydara FBX Binary")) {
    file.fail("binary FBX with other bytes in its mark",
              "the zero bytes that it had when it was written",
              "a transfer as text has changed them: fetch the file again, as binary");
  }
  return FbxTextReader(file).read();
}

}  // namespace curveskel
