#include "rig/gltf/picture_as_png.hpp"

#include <cstdint>
#include <limits>
#include <memory>

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_ONLY_TGA
#define STBI_ONLY_BMP
#define STBI_ONLY_GIF
#define STBI_ONLY_PSD
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wnull-dereference"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wcast-qual"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace curveskel {
namespace {

void append(void* to, void* bytes, int size) {
  static_cast<std::string*>(to)->append(static_cast<const char*>(bytes),
                                        static_cast<std::size_t>(size));
}

}  // namespace

std::optional<std::string> picture_as_png(const std::string& bytes) {
  constexpr std::int64_t most_pixels = std::int64_t{1} << 26;
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) return std::nullopt;
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const auto size = static_cast<int>(bytes.size());
  int width = 0;
  int height = 0;
  int channels = 0;
  const bool is_known = stbi_info_from_memory(data, size, &width, &height, &channels) != 0;
  if (!is_known || std::int64_t{width} * height > most_pixels) return std::nullopt;
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> rows(
      stbi_load_from_memory(data, size, &width, &height, &channels, 0), &stbi_image_free);
  if (!rows) return std::nullopt;
  std::string png;
  const int done =
      stbi_write_png_to_func(append, &png, width, height, channels, rows.get(), width * channels);
  return done != 0 ? std::optional(png) : std::nullopt;
}

}  // namespace curveskel
