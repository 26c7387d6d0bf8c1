// Pictures of files as pixels, by stb_image.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#include <stb/stb_image.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "viewer/model/drawn_materials.hpp"

namespace curveskel::viewer {
namespace {

constexpr int longest_side = 2048;

/// Mean of two by two pixels.
Picture halved(const Picture& picture) {
  Picture half{picture.width / 2, picture.height / 2, {}};
  half.bytes.reserve(static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height) *
                     4);
  const auto row = static_cast<std::size_t>(picture.width) * 4;
  for (std::size_t y = 0; y < static_cast<std::size_t>(half.height); ++y) {
    for (std::size_t x = 0; x < static_cast<std::size_t>(half.width); ++x) {
      for (std::size_t k = 0; k < 4; ++k) {
        const std::uint8_t* at = &picture.bytes[2 * y * row + 8 * x + k];
        half.bytes.push_back(
            static_cast<std::uint8_t>((at[0] + at[4] + at[row] + at[row + 4] + 2) / 4));
      }
    }
  }
  return half;
}

}  // namespace

Picture decoded(const EncodedPicture& encoded) {
  Picture picture;
  if (encoded.bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) return {};
  int channels_of_file = 0;
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> rows(
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(encoded.bytes.data()),
                            static_cast<int>(encoded.bytes.size()), &picture.width, &picture.height,
                            &channels_of_file, 4),
      &stbi_image_free);
  if (!rows) return {};
  const auto size =
      static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) * 4;
  picture.bytes.assign(rows.get(), rows.get() + size);
  while (std::max(picture.width, picture.height) > longest_side &&
         std::min(picture.width, picture.height) > 1) {
    picture = halved(picture);
  }
  return picture;
}

}  // namespace curveskel::viewer
