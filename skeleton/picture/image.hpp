// Pixels.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

namespace curveskel {

/// Colours are (red, green, blue) in 0..1, gamma-encoded as in sRGB.
using Colour = Eigen::Vector3f;

/// Eight bits a channel, as in the file: memory is dearer than what is rounded away.
class Image {
 public:
  Image(int columns, int rows, const Colour& background);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] Colour at(int x, int y) const;
  void set(int x, int y, const Colour& colour);
  /// So much of the colour over what is there.
  void blend(int x, int y, const Colour& colour, float share);

  /// Row by row from the top, with a pixel of zeros before each row and a row of zeros above the
  /// first: what PNG's filters see beyond the edges. Row y begins at bytes() + (y + 1) * stride().
  [[nodiscard]] const unsigned char* bytes() const { return bytes_.data(); }
  [[nodiscard]] std::size_t stride() const { return stride_; }

 private:
  [[nodiscard]] std::size_t place(int x, int y) const {
    return (static_cast<std::size_t>(y) + 1) * stride_ + 3 * (static_cast<std::size_t>(x) + 1);
  }

  int width_;
  int height_;
  std::size_t stride_;
  std::vector<unsigned char> bytes_;
};

/// The bytes of an 8-bit RGB PNG file; they do not depend on `threads`.
[[nodiscard]] std::string png_from(const Image& image, int threads);

}  // namespace curveskel
