#include "base/base64.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace curveskel {
namespace {

constexpr std::string_view base64_digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::uint8_t no_digit = 64;

constexpr std::array<std::uint8_t, 256> value_of_digit = [] {
  std::array<std::uint8_t, 256> values{};
  values.fill(no_digit);
  for (std::uint8_t value = 0; value < base64_digits.size(); ++value) {
    values.at(static_cast<unsigned char>(base64_digits[value])) = value;
  }
  return values;
}();

/// Four base64_digits, the last ones perhaps '='. False where the text has no whole group.
bool append_group(std::string& bytes, std::string_view& text) {
  std::uint32_t bits = 0;
  unsigned known = 0;
  for (int read = 0; read < 4;) {
    if (text.empty()) return false;
    const char c = text.front();
    text.remove_prefix(1);
    if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
    ++read;
    const std::uint8_t value = c == '=' ? 0 : value_of_digit.at(static_cast<unsigned char>(c));
    if (value == no_digit) return false;
    bits = bits << 6U | value;
    known += c == '=' ? 0 : 1;
  }
  for (unsigned byte = 0; byte + 1 < known; ++byte) {
    bytes += static_cast<char>(static_cast<unsigned char>(bits >> (16U - 8U * byte) & 0xFFU));
  }
  return true;
}

}  // namespace

std::string base64_of(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t triple = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      triple = triple << 8U | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text +=
          k <= count ? base64_digits[triple >> (18U - 6U * static_cast<unsigned>(k)) & 63U] : '=';
    }
  }
  return text;
}

void append_from_base64(std::string& bytes, std::string_view& text, std::size_t least) {
  while (bytes.size() < least && append_group(bytes, text)) {
  }
}

}  // namespace curveskel
