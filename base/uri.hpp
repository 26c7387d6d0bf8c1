// References to files, as URIs have them.
#pragma once

#include <string>
#include <string_view>

namespace curveskel {

/// "a%20b" is "a b"; what is no such code stays.
[[nodiscard]] std::string without_escapes(std::string_view uri);

}  // namespace curveskel
