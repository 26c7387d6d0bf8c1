#include "base/uri.hpp"

#include <charconv>
#include <cstddef>

namespace curveskel {

std::string without_escapes(std::string_view uri) {
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned byte = 0;
    const char* digits = uri.data() + i + 1;
    const bool is_escape = uri[i] == '%' && i + 2 < uri.size() &&
                           std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2;
    path += is_escape ? static_cast<char>(static_cast<unsigned char>(byte)) : uri[i];
    if (is_escape) i += 2;
  }
  return path;
}

}  // namespace curveskel
