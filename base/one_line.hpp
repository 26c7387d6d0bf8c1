// Texts for comments of files.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "base/utf8.hpp"

namespace curveskel {

/// As UTF-8, with blanks for control characters: a line end in a file's name would end a comment.
[[nodiscard]] inline std::string in_one_line(std::string_view text) {
  std::string line = as_utf8(std::string(text));
  std::replace_if(
      line.begin(), line.end(),
      [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, ' ');
  return line;
}

}  // namespace curveskel
