#include "surface/read/utf16.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace curveskel {
namespace {

constexpr std::string_view big_endian_mark = "\xFE\xFF";
constexpr std::string_view little_endian_mark = "\xFF\xFE";

void append_utf8(std::string& text, char32_t c) {
  const auto append = [&](char32_t bits) { text += static_cast<char>(bits); };
  if (c < 0x80) {
    append(c);
  } else if (c < 0x800) {
    append(0xC0U | c >> 6U);
    append(0x80U | (c & 63U));
  } else if (c < 0x10000) {
    append(0xE0U | c >> 12U);
    append(0x80U | (c >> 6U & 63U));
    append(0x80U | (c & 63U));
  } else {
    append(0xF0U | c >> 18U);
    append(0x80U | (c >> 12U & 63U));
    append(0x80U | (c >> 6U & 63U));
    append(0x80U | (c & 63U));
  }
}

}  // namespace

bool is_utf16(const std::string& content) {
  if (content.size() < 4) return false;
  const bool big = content.starts_with(big_endian_mark);
  if (!big && !content.starts_with(little_endian_mark)) return false;
  const auto high = static_cast<unsigned char>(content[big ? 2 : 3]);
  const auto low = static_cast<unsigned char>(content[big ? 3 : 2]);
  return high == 0 && low >= '\t' && low < 0x7F;
}

void utf16_to_utf8(FileBytes& file) {
  constexpr char32_t replacement = 0xFFFD;
  const std::string& content = file.content;
  if (content.size() % 2 != 0) {
    file.fail("an odd number of bytes (" + std::to_string(content.size()) + ") of UTF-16",
              "two or four bytes per character", "the file is truncated: fetch or export it again");
  }
  const std::size_t high_byte = content.starts_with(big_endian_mark) ? 0 : 1;
  const auto unit = [&](std::size_t place) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(content[place + k]); };
    return static_cast<char32_t>(byte(high_byte) << 8U | byte(1 - high_byte));
  };
  const auto is_high = [](char32_t c) { return c >= 0xD800 && c < 0xDC00; };
  const auto is_low = [](char32_t c) { return c >= 0xDC00 && c < 0xE000; };
  std::string text;
  text.reserve(content.size() / 2);
  for (std::size_t place = 2; place < content.size(); place += 2) {
    const char32_t first = unit(place);
    if (is_high(first) && place + 2 < content.size() && is_low(unit(place + 2))) {
      place += 2;
      append_utf8(text, 0x10000 + ((first - 0xD800) << 10U) + (unit(place) - 0xDC00));
    } else {
      append_utf8(text, is_high(first) || is_low(first) ? replacement : first);
    }
  }
  file.content = std::move(text);
}

}  // namespace curveskel
