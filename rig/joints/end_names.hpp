// Joints that only show how long the last bone of a limb is.
#pragma once

#include <string_view>

namespace curveskel {

/// By the name that this program and Blender give them: "head_end", "thumb_end.L".
[[nodiscard]] inline bool is_end_name(std::string_view name) {
  return name.find("_end") != std::string_view::npos;
}

}  // namespace curveskel
