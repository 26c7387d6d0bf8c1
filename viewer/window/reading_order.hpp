// Hebrew and Arabic, which are read from the right, for a library that draws from the left.
#pragma once

#include <string>
#include <string_view>

namespace curveskel::viewer {

/// The text in the order in which its characters stand from left to right, Arabic letters in the
/// forms by which they join their neighbours (Unicode's bidirectional algorithm, by FriBidi); any
/// other text, and what is no UTF-8, as it is. The line as a whole begins at the left. O(its size).
[[nodiscard]] std::string in_reading_order(std::string_view text);

}  // namespace curveskel::viewer
