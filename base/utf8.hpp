// Names of files are bytes of any kind; texts of files are UTF-8.
#pragma once

#include <string>

namespace curveskel {

/// The text with U+FFFD for what is no UTF-8. O(bytes).
[[nodiscard]] std::string as_utf8(const std::string& text);

}  // namespace curveskel
