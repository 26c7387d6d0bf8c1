// Pixels.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace curveskel {

/// Colours are (red, green, blue) in 0..1, gamma-encoded as in sRGB.
using Colour = Eigen::Vector3f;

struct Image {
  int width = 0;
  int height = 0;
  std::vector<Colour> pixels;  ///< row by row from the top

  Image(int columns, int rows, const Colour& background)
      : width(columns),
        height(rows),
        pixels(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), background) {}
  [[nodiscard]] Colour& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

/// The bytes of an 8-bit RGB PNG file; they do not depend on `threads`.
[[nodiscard]] std::string png_from(const Image& image, int threads);

}  // namespace curveskel
