// The content of text files in UTF-16. Internal to surface/.
#pragma once

#include "surface/read/file_bytes.hpp"

namespace curveskel {

/// True if the content begins with a byte order mark of UTF-16, either order, and an ASCII
/// character, as every text format does.
[[nodiscard]] bool is_utf16(const std::string& content);

/// Makes UTF-8 of it, without the mark; what is no character becomes U+FFFD.
/// Precondition: is_utf16(file.content). Throws Error(Fault::input) for half a character at the
/// end.
void utf16_to_utf8(FileBytes& file);

}  // namespace curveskel
