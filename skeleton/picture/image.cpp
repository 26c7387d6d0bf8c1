#include "skeleton/picture/image.hpp"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>

// zlib packs several times faster than the deflate that comes with stb, and smaller.
static unsigned char* pack(const unsigned char* bytes, int count, int* packed, int /*quality*/) {
  constexpr int level = 6;  // a third of the time of 8, a few percent more bytes
  uLongf size = compressBound(static_cast<uLong>(count));
  auto* result = static_cast<unsigned char*>(std::malloc(size));  // stb frees it
  if (result == nullptr) return nullptr;
  if (compress2(result, &size, bytes, static_cast<uLong>(count), level) != Z_OK) {
    std::free(result);
    return nullptr;
  }
  *packed = static_cast<int>(size);
  return result;
}

#define STBIW_ZLIB_COMPRESS pack
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wcast-qual"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

#include <curveskel/error.hpp>

namespace curveskel {

std::string png_from(const Image& image) {
  constexpr int channels = 3;
  std::vector<unsigned char> bytes;
  bytes.reserve(image.pixels.size() * channels);
  for (const Colour& pixel : image.pixels) {
    for (const float value : pixel) {
      bytes.push_back(
          static_cast<unsigned char>(std::lround(std::clamp(value, 0.0F, 1.0F) * 255.0F)));
    }
  }
  std::string png;
  const auto append = [](void* context, void* data, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data),
                                               static_cast<std::size_t>(size));
  };
  if (stbi_write_png_to_func(append, &png, image.width, image.height, channels, bytes.data(),
                             image.width * channels) == 0) {
    throw Error(Fault::output, "no memory to pack a picture of " + std::to_string(image.width) +
                                   " x " + std::to_string(image.height) +
                                   " pixels; make it smaller");
  }
  return png;
}

}  // namespace curveskel
