#include "rig/usd/usd_names.hpp"

#include "base/free_name.hpp"
#include "base/utf8.hpp"

namespace curveskel {
namespace {

bool is_letter_or_digit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

/// A byte of a character of several that is not the first.
bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

}  // namespace

std::string usd_identifier(const std::string& name, const std::string& otherwise) {
  std::string made;
  for (const char c : as_utf8(name)) {
    if (continues_character(c)) continue;
    made += is_letter_or_digit(c) ? c : '_';
  }
  if (made.empty()) return otherwise;
  return made.front() >= '0' && made.front() <= '9' ? "_" + made : made;
}

std::string UsdNames::free(const std::string& name, const std::string& otherwise) {
  return free_name(taken_, usd_identifier(name, otherwise), "_");
}

std::string usd_true_name(const std::string& name, const std::string& of_prim) {
  return name == of_prim ? "" : name;
}

std::string plain_file_name(const std::string& name) {
  std::string made;
  for (const char c : as_utf8(name)) {
    if (continues_character(c)) continue;
    const bool is_plain =
        is_letter_or_digit(c) || c == '-' || c == '_' || (c == '.' && !made.empty());
    made += is_plain ? c : '_';
  }
  return made;
}

}  // namespace curveskel
