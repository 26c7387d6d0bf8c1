// Any text in ImGui's fields, which hold characters of 16 bits alone.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace curveskel::viewer {

/// Bytes that a field cannot hold, such as an emoji or a name in another encoding, have a character
/// of Unicode's private range in their place there, each its own, so that they survive all edits.
class FieldText {
 public:
  /// Of any bytes but NUL.
  [[nodiscard]] std::string in_field(std::string_view text);
  /// The text that stands so in a field, up to its first NUL.
  [[nodiscard]] std::string from_field(std::string_view shown) const;

 private:
  [[nodiscard]] std::string place_of(std::string_view bytes);

  std::vector<std::string> kept_;  // by their places
};

}  // namespace curveskel::viewer
