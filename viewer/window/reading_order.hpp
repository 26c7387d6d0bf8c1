// Hebrew and Arabic, which are read from the right, for a library that draws from the left.
#pragma once

#include <string>
#include <string_view>

namespace curveskel::viewer {

/// The text in the order in which its characters stand from left to right, Arabic letters in the
/// forms by which they join their neighbours; any other text as it is. The line as a whole begins
/// at the left, and numbers keep their order (Unicode's rules for such lines, but for embeddings
/// and marks that no name has). `text`: UTF-8, bytes that are none stay. O(its size).
[[nodiscard]] std::string in_reading_order(std::string_view text);

}  // namespace curveskel::viewer
