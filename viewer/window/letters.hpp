// ImGui's fonts, with the glyphs of those characters that are shown.
#pragma once

#include <bitset>
#include <cstddef>
#include <future>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "viewer/window/font_faces.hpp"

namespace curveskel::viewer {

/// The window's own font has Latin letters from the start. All others come once they are wanted,
/// from that font or any of the system that has them.
class Letters {
 public:
  /// Builds ImGui's fonts, with lines of so many pixels. Precondition: ImGui has a context, which
  /// lives as long.
  explicit Letters(float line_pixels);

  /// The text, in UTF-8, is shown from now on.
  void want(std::string_view text);
  /// Between frames: true if ImGui's fonts were built anew, and their texture is out of date.
  [[nodiscard]] bool update();
  /// Fonts of the system are being looked for.
  [[nodiscard]] bool looking() const { return found_.valid(); }
  /// A word for the person, once, if something that was wanted is in no font of the system; else
  /// empty.
  [[nodiscard]] std::string take_lacking();

 private:
  static constexpr std::size_t count = 0x10000;  // of ImGui's characters
  void look_for(std::vector<char32_t> characters);
  [[nodiscard]] bool take_found();
  [[nodiscard]] bool has(char32_t character) const;
  void build();

  float line_pixels_;
  std::shared_ptr<const FontFace> own_;
  std::vector<std::shared_ptr<const FontFace>> others_;
  std::bitset<count> wanted_;
  std::vector<char32_t> new_;  // wanted since the last update
  std::vector<char32_t> looked_for_;
  std::future<std::vector<std::shared_ptr<const FontFace>>> found_;
  std::vector<char32_t> lacking_;
  bool told_ = false;
  std::vector<unsigned short> ranges_;  // ImGui keeps their address
};

/// About characters that no font has, with Debian's packages that have fonts for their scripts.
[[nodiscard]] std::string words_on_lacking(const std::vector<char32_t>& characters);

}  // namespace curveskel::viewer
