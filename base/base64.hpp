// Base64 (RFC 4648), as glTF, SVG and VTK have it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace curveskel {

/// Padded, on one line. O(bytes).
[[nodiscard]] std::string base64_of(std::string_view bytes);

/// Appends what the front of `text` says, group by group, until `least` bytes stand in `bytes`, or
/// the text ends or goes on with something else; `text` is left with the rest. Blanks are passed
/// over, and a padded group may be followed by others. O(characters taken).
void append_from_base64(std::string& bytes, std::string_view& text, std::size_t least);

}  // namespace curveskel
