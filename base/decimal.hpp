// Numbers as text, for every writer of a text format.
#pragma once

#include <charconv>
#include <concepts>
#include <string>

namespace curveskel {

/// Appends the shortest decimal that reads back as the same number. Needs no locale.
template <typename Number>
requires std::floating_point<Number> || std::integral<Number>
void append_decimal(std::string& text, Number value) {
  constexpr std::size_t longest = 32;  // -2.2250738585072014e-308 has 24 characters
  const std::size_t used = text.size();
  text.resize(used + longest);
  char* begin = text.data() + used;
  const auto result = std::to_chars(begin, begin + longest, value);
  text.resize(static_cast<std::size_t>(result.ptr - text.data()));
}

/// "3 0.5 -1": the numbers of a row, separated.
template <typename Row>
void append_decimals(std::string& text, const Row& row, char separator) {
  bool first = true;
  for (const auto value : row) {
    if (!first) text += separator;
    append_decimal(text, value);
    first = false;
  }
}

}  // namespace curveskel
