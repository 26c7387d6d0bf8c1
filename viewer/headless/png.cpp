#include "viewer/headless/png.hpp"

#include <algorithm>

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wcast-qual"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

#include <curveskel/error.hpp>

namespace curveskel::viewer {
namespace {

constexpr int channels = 4;

std::size_t place(int width, int x, int y) {
  return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
          static_cast<std::size_t>(x)) *
         channels;
}

}  // namespace

PixelRows shrunk(const PixelRows& rows, int factor) {
  if (factor == 1) return rows;
  PixelRows small{rows.width / factor, rows.height / factor, {}};
  small.bytes.resize(place(small.width, 0, small.height));
  const unsigned block = static_cast<unsigned>(factor) * static_cast<unsigned>(factor);
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      for (std::size_t channel = 0; channel < channels; ++channel) {
        unsigned sum = block / 2;
        for (int dy = 0; dy < factor; ++dy) {
          for (int dx = 0; dx < factor; ++dx) {
            sum += rows.bytes[place(rows.width, factor * x + dx, factor * y + dy) + channel];
          }
        }
        small.bytes[place(small.width, x, y) + channel] = static_cast<std::uint8_t>(sum / block);
      }
    }
  }
  return small;
}

std::string png_of(const PixelRows& rows) {
  std::vector<std::uint8_t> straight(rows.bytes.size());
  const std::size_t stride = place(rows.width, 0, 1);
  for (int y = 0; y < rows.height; ++y) {
    const std::uint8_t* from = rows.bytes.data() + place(rows.width, 0, rows.height - 1 - y);
    std::uint8_t* to = straight.data() + place(rows.width, 0, y);
    for (std::size_t i = 0; i < stride; i += channels) {
      const unsigned alpha = from[i + 3];
      for (std::size_t channel = 0; channel < 3; ++channel) {
        const unsigned value = from[i + channel];
        to[i + channel] = static_cast<std::uint8_t>(
            alpha == 0 ? 0U : std::min(255U, (value * 255U + alpha / 2) / alpha));
      }
      to[i + 3] = from[i + 3];
    }
  }
  std::string png;
  const auto append = [](void* context, void* data, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data),
                                               static_cast<std::size_t>(size));
  };
  if (stbi_write_png_to_func(append, &png, rows.width, rows.height, channels, straight.data(),
                             static_cast<int>(stride)) == 0) {
    throw Error(Fault::output, "no memory to pack a picture of " + std::to_string(rows.width) +
                                   " x " + std::to_string(rows.height) +
                                   " pixels; make it smaller");
  }
  return png;
}

}  // namespace curveskel::viewer
