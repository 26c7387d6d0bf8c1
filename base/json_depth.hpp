// A look at JSON before a parser that recurses gets it.
#pragma once

#include <string_view>

namespace curveskel {

/// Deeper than any useful file, and far less than a stack holds.
inline constexpr int deepest_json = 200;

/// The depth of arrays and objects. Of a text that is no JSON it may be anything. O(bytes).
[[nodiscard]] int json_depth(std::string_view text);

}  // namespace curveskel
