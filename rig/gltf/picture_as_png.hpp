// Pictures of kinds that glTF does not have.
#pragma once

#include <optional>
#include <string>

namespace curveskel {

/// TGA, BMP, GIF (the first picture) or PSD as PNG with eight bits a channel; nothing where the
/// bytes are none of these, are broken, or have more than 2^26 pixels.
[[nodiscard]] std::optional<std::string> picture_as_png(const std::string& bytes);

}  // namespace curveskel
